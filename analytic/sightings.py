"""What many tosses show: their first touches, and their states at times."""

import numpy as np

from cointoss.analytic.entries import see_each
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.seeing import Sightings
from cointoss.analytic.settings import FINE, AnalyticSettings, contact_limits
from cointoss.models.records import Array
from cointoss.models.tiles import in_tiles

TILE = 512
"""Most tosses that a thread makes at a time."""


def sightings(
    rows: Array, times: Array, *, most: int, settings: AnalyticSettings = FINE, workers: int | None = None
) -> Sightings:
    """Return what tosses show, each as `toss` makes it.

    Args:
        rows: of the scenarios, in the order of `models.rows.FIELDS`, (n, m).
        times: when their states are asked for, rising, (n, m) [s]; before and after a toss its ends count.
        most: the number of touches to return; if no times are given, no scenario may have more impacts.
        settings: of the engine.
        workers: number of threads, by default one for each core.
    """
    (n, m), limits = times.shape, contact_limits(settings)
    found = Sightings(
        np.zeros((n, most)), np.zeros((n, most)), np.zeros((n, m, STATE_SIZE)), np.zeros(n, dtype=np.int64)
    )

    def work(part: slice) -> None:
        of_part = found.touch_times[part], found.up[part], found.states[part], found.impacts[part]
        see_each(rows[part], limits, times[part], Sightings(*of_part))

    in_tiles(n, TILE, work, workers)
    return found
