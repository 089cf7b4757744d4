"""Tosses of MuJoCo's coin from rows of numbers, by one thread."""

import numpy as np

from cointoss.coin_mj.events import toss_coin
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.settings import Budgets
from cointoss.coin_mj.model.state import put_at
from cointoss.models.answers import write_end
from cointoss.models.kernel.arrays import Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW
from cointoss.models.rows import rules_of, write_release


@compiled
def toss_rows(coin: MujocoCoin, plastic: MujocoCoin, budgets: Budgets, rows: Table, answers: Table) -> None:
    """Toss a coin from the release of each row.

    Args:
        coin: of the rows, which differ in release and ending alone.
        plastic: the same, for touches up to the threshold of restitution.
        budgets: the most steps in flight and in sustained contact.
        rows: of the scenarios, (n, m).
        answers: where they go, (n, 7), see `cointoss.models.answers.ANSWER`; the last two are not written.
    """
    impacts, y = np.zeros(1, IMPACT_ROW), np.empty(13)
    for i in range(len(rows)):
        write_release(rows[i], y)
        put_at(coin, y)
        n, _, _, _, outcome, ending, end_time = toss_coin(
            coin, plastic, rules_of(rows[i]), budgets, impacts, False, np.empty(1)
        )
        write_end(outcome, ending, n, impacts[0]["face"] if n > 0 else 0, end_time, answers[i])
