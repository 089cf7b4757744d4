"""Many impacts of one coin, each by itself."""

import numpy as np

from cointoss.analytic.contact.resets import hit
from cointoss.models.body import Body, Rules, with_floor
from cointoss.models.impact_row import ImpactRows
from cointoss.models.kernel.arrays import Flags, Row, Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Ending


@compiled
def strike_each(body: Body, rules: Rules, chi: Row, mu: Row, states: Table, rows: ImpactRows) -> Flags:
    """Let the floor act on the coin in each state, (n, 13), and write the impacts; see `strike`.

    Args:
        body: the coin.
        rules: of the floor, but for the next two.
        chi: restitution at any speed, (n,).
        mu: friction, (n,).
        states: of the coin as it touches, (n, 13); become those after.
        rows: where the impacts go, (n,).

    Returns:
        Whether the contact law has a solution there, (n,).
    """
    solved = np.empty(len(rows), dtype=np.bool_)
    for i in range(len(rows)):
        floor = with_floor(rules, chi[i], mu[i])
        solved[i] = hit(body, floor, chi[i], states[i], rows[i]) == Ending.NONE
    return solved
