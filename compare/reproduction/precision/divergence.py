"""Tosses of neighbouring releases, and the energy that the coin has left where they diverge."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.reproduction.precision.planar_coin import PlanarCoin
from cointoss.compare.reproduction.precision.planar_flight import room_for_series
from cointoss.compare.reproduction.precision.planar_state import SIZE, copy_state
from cointoss.compare.reproduction.precision.planar_toss import MOST_IMPACTS, toss
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

COMPARED = 400
"""Touches that are compared, at most."""
APART = 0.1
"""Two tosses have diverged when height, velocity and spin differ by so much in all, or the faces do."""


class TossedLines(NamedTuple):
    """How tosses along lines of releases end, by line and point."""

    outcome: NDArray[np.int8]
    """As of `PlanarOutcomes`, (n, points)."""
    itinerary: NDArray[np.int64]
    """As of `PlanarOutcomes`, (n, points)."""
    energy: Array
    """The larger of two neighbours' after the first impact at which they have diverged, or after their last
    where they have not, (n, points - 1) [m g r]."""


def toss_lines(coin: PlanarCoin, starts: Array, points: int) -> TossedLines:
    """Toss coins along lines of releases.

    Args:
        coin: the coin.
        starts: as of `planar_state.release`, line after line, (n points, 5, 2).
        points: of each line.
    """
    lines = len(starts) // points
    tossed = TossedLines(
        outcome=np.empty((lines, points), dtype=np.int8),
        itinerary=np.empty((lines, points), dtype=np.int64),
        energy=np.empty((lines, points - 1)),
    )
    _toss_lines(coin, np.ascontiguousarray(starts), tossed)
    return tossed


@compiled
def _toss_lines(coin: PlanarCoin, starts: Array, tossed: TossedLines) -> None:
    outcome, itinerary, energies = tossed
    series, state, touches = room_for_series(), np.empty((SIZE, 2)), np.empty((2, COMPARED, 5))
    lines, points = outcome.shape
    for i in range(lines):
        before = 0
        for j in range(points):
            copy_state(state, starts[i * points + j])
            outcome[i, j], impacts, itinerary[i, j], _, _, _ = toss(
                coin, state, MOST_IMPACTS, False, series, touches[j % 2]
            )
            if j > 0:
                energies[i, j - 1] = _energy_left(touches, min(before, impacts, COMPARED))
            before = impacts


@compiled
def _energy_left(touches: Array, compared: int) -> float:
    for n in range(compared):
        a, b = touches[0, n], touches[1, n]
        apart = abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2]) > APART
        if apart or a[3] != b[3] or n == compared - 1:
            return max(a[4], b[4])
    return 0.0
