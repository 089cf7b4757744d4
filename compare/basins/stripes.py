"""The stripes that a line through a map crosses.

A line is the last axis of an array, so that a row `outcomes[i]`, a whole map (y, x), and a stack of lines or
maps after n = 0, 1, 2, ... impacts are all accepted; a column is a row of the map's transpose.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.basins.maps import measured, outcome_codes
from cointoss.models.records import Array, Outcome


def crossings(outcomes: ArrayLike) -> NDArray[np.int64]:
    """Count the crossings N from one basin to another along each line (section 5.3), (...).

    Undecided pixels are passed over: between two decided ones there is a crossing when these differ. A line
    of points misses pairs of crossings that fall between two of them, so N is a lower bound; where every
    second point, `crossings(outcomes[..., ::2])`, gives much less, the line is too coarse.

    Args:
        outcomes: along the lines, (..., points).
    """
    codes = measured(outcome_codes(outcomes))
    points = np.arange(codes.shape[-1])
    last_decided = np.maximum.accumulate(np.where(codes != Outcome.UNDECIDED, points, 0), axis=-1)
    held = np.take_along_axis(codes, last_decided, axis=-1)
    return np.sum((held[..., 1:] != held[..., :-1]) & (held[..., :-1] != Outcome.UNDECIDED), axis=-1)


def stripe_widths(outcomes: ArrayLike, *, spacing: float) -> Array:
    """Return the widths W of the stripes along all lines (section 5.3), (n,) [unit of `spacing`].

    A width is good to one spacing. A stripe that the line's end or an undecided pixel cuts off has an unknown
    width and is left out; where stripes are nearly as wide as the line is long, that leaves out the wide
    ones.

    Args:
        outcomes: along the lines, (..., points).
        spacing: between neighbouring points.
    """
    codes = measured(outcome_codes(outcomes))
    lines = codes.reshape(-1, codes.shape[-1])
    line, before = np.nonzero(lines[:, 1:] != lines[:, :-1])
    same_line = line[1:] == line[:-1]
    line, left, right = line[:-1][same_line], before[:-1][same_line], before[1:][same_line]
    whole = np.all([lines[line, i] != Outcome.UNDECIDED for i in (left, right, right + 1)], axis=0)
    return spacing * (right - left)[whole].astype(np.float64)
