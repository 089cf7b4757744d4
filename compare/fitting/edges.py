"""How often coins of some thicknesses ended on their edge."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.fitting.errors import ObservationError
from cointoss.models.records import Array

MOST_ROWS = 100


@dataclass(frozen=True, init=False, eq=False)
class Edges:
    """How many of some tosses ended on the edge, by thickness; arrays are read-only."""

    thickness: Array
    """Thicknesses of the coins, (n,) [m]."""
    edge: NDArray[np.int64]
    """Tosses that ended on the edge, (n,)."""
    tosses: NDArray[np.int64]
    """All tosses, (n,)."""

    def __init__(self, *, thickness: ArrayLike, edge: ArrayLike, tosses: ArrayLike) -> None:
        """Check the counts.

        Raises:
            ObservationError: naming what is wrong and what is accepted.
        """
        h, met, count = (np.array(given, dtype=float) for given in (thickness, edge, tosses))
        if not (h.ndim == 1 and h.shape == met.shape == count.shape and 1 <= len(h) <= MOST_ROWS):
            raise ObservationError(
                f"Edges: {h.size} thicknesses, accepted: from 1 to {MOST_ROWS}, with counts"
            )
        good = (h > 0) & np.isfinite(h) & (met >= 0) & (met <= count) & (count > 0) & (count < 1e9)
        good &= (met % 1 == 0) & (count % 1 == 0)
        if not good.all():
            n = int(np.argmin(good))
            given = f"{met[n]:g} edges of {count[n]:g} tosses at thickness {h[n]:g} m"
            accepted = "whole numbers, no more edges than tosses, one toss or more, a thickness above 0"
            raise ObservationError(f"row {n + 1}: {given}; accepted: {accepted}")
        for name, kept in (
            ("thickness", h),
            ("edge", met.astype(np.int64)),
            ("tosses", count.astype(np.int64)),
        ):
            kept.setflags(write=False)
            object.__setattr__(self, name, kept)
