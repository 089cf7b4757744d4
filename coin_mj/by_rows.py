"""Tosses of MuJoCo's coin from rows of numbers, by one thread."""

import numpy as np

from cointoss.coin_mj.events import go_on, toss_coin
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.settings import Budgets
from cointoss.coin_mj.model.state import put_at, state_of
from cointoss.coin_mj.steps.knots import StepKind
from cointoss.models.answers import write_end
from cointoss.models.body import with_budgets
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.arrays import Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.making import AT_REST, MOST_LOSSLESS
from cointoss.models.records import IMPACT_ROW
from cointoss.models.resting import path_length, unrest, write_rest
from cointoss.models.resting_place import RestReason
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


@compiled
def rest_each(coin: MujocoCoin, plastic: MujocoCoin, budgets: Budgets, rows: Table, rests: Table) -> None:
    """Write where a coin comes to rest from the release of each row.

    Args:
        coin: of the rows, which differ in release and ending alone.
        plastic: the same, for touches up to the threshold of restitution.
        budgets: the most steps in flight and in sustained contact.
        rows: of the scenarios, (n, m).
        rests: where they go, (n, 7), see `cointoss.models.resting_place.REST`.
    """
    room, y = np.zeros(FIRST_ROOM, IMPACT_ROW), np.empty(13)
    for i in range(len(rows)):
        rules = rules_of(rows[i])
        rules = with_budgets(rules, min(rules.max_impacts, MOST_LOSSLESS), rules.max_time)
        write_release(rows[i], y)
        put_at(coin, y)
        _, _, knots, _, _, ending, end_time = toss_coin(
            coin, plastic, rules, budgets, room, True, np.empty(1)
        )
        reason = unrest(coin.body, rules, ending, end_time, state_of(coin).velocity)
        until = AT_REST if reason == RestReason.AT_REST else 0.0
        knots, _ = go_on(coin, plastic, rules, budgets, knots, ending, until)
        touched = knots[np.argmax(knots[:, 1] != StepKind.FLIGHT.value) :]
        write_rest(reason, knots[-1, 0], knots[-1, 2:], path_length(touched[:, 0], touched[:, 2:]), rests[i])
