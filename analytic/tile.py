"""Many tosses of one coin by one thread."""

import numpy as np

from cointoss.analytic.events import Verdict, started_of, toss_coin
from cointoss.analytic.horizon.certainty import certainty_of
from cointoss.analytic.horizon.horizon import ErrorsMade, find_horizon
from cointoss.analytic.settings import ContactLimits
from cointoss.models.body import Body, Rules
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW
from cointoss.models.tiles import Tile


@compiled
def toss_tile(body: Body, rules: Rules, limits: ContactLimits, tile: Tile) -> None:
    """Toss the coin from each state of a tile, and write how the tosses end.

    Args:
        body: the coin.
        rules: floor and ending.
        limits: of sustained contact.
        tile: the tosses; its states are written to.
    """
    # Two rows: the last impact's, and the work space after it.
    rows = np.zeros(2, IMPACT_ROW)
    for i in range(len(tile.states)):
        n, _, _, outcome, ending, end_time = toss_coin(body, rules, limits, tile.states[i], rows, False)
        tile.outcome[i], tile.ending[i], tile.impacts[i] = outcome.value, ending.value, n
        tile.end_time[i] = end_time
        tile.last_face[i] = rows[(n - 1) % 2]["face"] if n > 0 else 0


@compiled
def trust_tile(
    body: Body, rules: Rules, limits: ContactLimits, made: ErrorsMade, certain: bool, tile: Tile
) -> None:
    """Do the same, and find how far each toss can be trusted.

    Args:
        body: the coin.
        rules: floor and ending.
        limits: of sustained contact.
        made: the errors of the engine.
        certain: whether to find which outcomes are certain, too.
        tile: the tosses; its states are written to.
    """
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    for i in range(len(tile.states)):
        n, rows, pieces, outcome, ending, end_time = toss_coin(
            body, rules, limits, tile.states[i], room, True
        )
        tile.outcome[i], tile.ending[i], tile.impacts[i] = outcome.value, ending.value, n
        tile.end_time[i] = end_time
        tile.last_face[i] = rows[n - 1]["face"] if n > 0 else 0
        started, rows = started_of(pieces), rows[:n]
        found = find_horizon(body, rules, rows, started, made)
        tile.trusted_impacts[i] = found.impacts
        if certain:
            verdict = Verdict(outcome, ending)
            tile.outcome_certain[i] = certainty_of(body, rules, rows, started, verdict, found).certain
