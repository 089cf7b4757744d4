"""How far two maps agree, near the boundaries and away from them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cointoss.compare.basins.boundary import distance_to_doubt
from cointoss.compare.basins.maps import measured, outcome_map
from cointoss.models.records import Outcome


@dataclass(frozen=True, kw_only=True)
class Share:
    """How many of the compared pixels agree."""

    agreeing: int
    compared: int

    @property
    def fraction(self) -> float | None:
        """The share that agrees, or None where nothing was compared."""
        return self.agreeing / self.compared if self.compared else None


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """How far a map agrees with a reference."""

    near: Share
    away: Share
    undecided: int
    """Pixels that either map leaves undecided; they are not compared."""


def agreement(reference: ArrayLike, other: ArrayLike, *, distance: float) -> Agreement:
    """Compare two maps of the same grid, pixel by pixel.

    A pixel is away from the boundaries when every pixel of the reference within `distance` is in the map,
    decided, and of the same outcome; else it is near. The reference alone decides this: a pixel that the
    other map has wrong must not excuse itself as a boundary.

    Args:
        reference: the map whose boundaries count, (y, x).
        other: the map that is judged, (y, x).
        distance: between pixels' centres [pixels].

    Raises:
        ValueError: for maps of two shapes.
    """
    a, b = measured(outcome_map(reference)), measured(outcome_map(other))
    if a.shape != b.shape:
        raise ValueError(f"other: shape {b.shape}, accepted: that of the reference, {a.shape}")
    decided = (a != Outcome.UNDECIDED) & (b != Outcome.UNDECIDED)
    away = distance_to_doubt(a) > distance
    near_share, away_share = (
        Share(agreeing=int(np.sum(where & (a == b))), compared=int(np.sum(where)))
        for where in (decided & ~away, decided & away)
    )
    return Agreement(near=near_share, away=away_share, undecided=int(np.sum(~decided)))
