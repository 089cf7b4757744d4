"""The two kinds of impacts that change a coin's face (Fig. 28): impacts after a row, and single impacts."""

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Estimate
from cointoss_reproduction.setups.estimates import PARTS, jackknife


def changes(faces: NDArray[np.int8]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the last impacts before the face changes, by the kind of change.

    Args:
        faces: up at the touches, (n,).

    Returns:
        Numbers of the impacts from 0: those that end a row on one face, and single ones.
    """
    last = np.flatnonzero(np.diff(faces))
    lengths = np.diff(np.concatenate([[-1], last]))
    return last[lengths > 1], last[lengths == 1]


def share_after_row(counts: NDArray[np.int64]) -> Estimate:
    """Return the share of the changes that follow a row, with its interval.

    Args:
        counts: of each toss, after a row and after a single impact, (tosses, 2).
    """

    def share_of(kept: NDArray[np.bool_]) -> float:
        row, one = counts[kept].sum(axis=0)
        return float(row / (row + one))

    return jackknife(share_of, len(counts), parts=min(PARTS, len(counts)))
