"""Crossings from one basin to another along lines of a map."""

import numpy as np
from numpy.typing import NDArray

from cointoss import Outcome
from cointoss.study import OutcomeCodes


def crossings(outcomes: OutcomeCodes) -> NDArray[np.int64]:
    """Count the crossings N from one basin to another along each line (section 5.3), (...).

    Undecided pixels are passed over: between two decided ones there is a crossing when these differ. A line
    of points misses pairs of crossings that fall between two of them, so N is a lower bound; where every
    second point, `crossings(outcomes[..., ::2])`, gives much less, the line is too coarse.

    Args:
        outcomes: along the lines, (..., points).
    """
    is_decided = (outcomes != Outcome.UNDECIDED) & (outcomes != Outcome.TRANSIENT)
    last_decided = np.maximum.accumulate(np.where(is_decided, np.arange(outcomes.shape[-1]), 0), axis=-1)
    held, is_held = (np.take_along_axis(each, last_decided, axis=-1) for each in (outcomes, is_decided))
    return np.sum((held[..., 1:] != held[..., :-1]) & is_held[..., :-1], axis=-1)
