"""The widths of the stripes that a line through a map crosses.

A line is the last axis of an array, so that a row `outcomes[i]`, a whole map (y, x), and a stack of lines or
maps after n = 0, 1, 2, ... impacts are all accepted; a column is a row of the map's transpose.
"""

import numpy as np
from numpy.typing import ArrayLike

from cointoss.compare.basins.maps import measured, outcome_codes
from cointoss.models.records import Array, Outcome


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
