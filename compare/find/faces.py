"""The faces that many tosses show at their first touches."""

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic import MANY
from cointoss.analytic.sightings import asked_of, sightings
from cointoss.compare.metrics.margin import with_quaternions
from cointoss.models.batch import PLACE, states_of
from cointoss.models.records import Array, Face
from cointoss.models.rows import AIR_EXPONENT, body_of, has_linear_air, rules_of
from cointoss.models.tiles import in_tiles

TILE = 512
"""Most tosses that a thread makes at a time."""
_EACH = [PLACE[field] for field in ("floor.restitution", "floor.friction", "ending.max_time")]
_SHARED = [i for field, i in PLACE.items() if not field.startswith("release.") and i not in _EACH]
"""What tosses that are made together have in common."""


def faces_shown(rows: Array, touches: int) -> NDArray[np.int8]:
    """Return the `Face` up at each of the first touches, 0 where there is none, (n, touches).

    Args:
        rows: of the scenarios, (n, 46).
        touches: how many.
    """
    states = states_of(with_quaternions(rows))
    shared = np.nan_to_num(rows[:, _SHARED], nan=np.inf)
    others = np.flatnonzero((shared[1:] != shared[:-1]).any(axis=1)) + 1
    found = np.zeros((len(rows), touches), dtype=np.int8)

    def work(part: slice) -> None:
        inside = others[(others > part.start) & (others < part.stop)]
        for some in np.split(np.arange(part.start, part.stop), inside - part.start):
            row = rows[some[0]]
            body = body_of(row, None if has_linear_air(row) else row[AIR_EXPONENT])
            chi, mu, longest = rows[some][:, _EACH].T
            nothing = np.zeros((len(some), 0))
            asked = asked_of(len(some), restitution=chi, friction=mu, max_time=longest, times=nothing)
            seen = sightings(body, rules_of(row), states[some], asked, most=touches, settings=MANY)
            made = np.arange(touches) < seen.impacts[:, None]
            found[some] = np.where(made, np.where(seen.up > 0, Face.HEADS, Face.TAILS), 0)

    in_tiles(len(rows), TILE, work)
    return found
