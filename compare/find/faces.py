"""The faces that many tosses show at their first touches."""

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic import MANY
from cointoss.analytic.sightings import sightings
from cointoss.models.batch import PLACE
from cointoss.models.records import Array, Face

_MOST = PLACE["ending.max_impacts"]


def faces_shown(rows: Array, touches: int) -> NDArray[np.int8]:
    """Return the `Face` up at each of the first touches, 0 where there is none, (n, touches).

    Args:
        rows: of the scenarios, (n, m).
        touches: how many.
    """
    rows = rows.copy()
    rows[:, _MOST] = np.fmin(rows[:, _MOST], touches)
    seen = sightings(rows, np.zeros((len(rows), 0)), most=touches, settings=MANY)
    made = np.arange(touches) < seen.impacts[:, None]
    return np.where(made, np.where(seen.up > 0, Face.HEADS, Face.TAILS), 0).astype(np.int8)
