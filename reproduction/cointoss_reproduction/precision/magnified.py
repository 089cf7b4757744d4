"""One boundary between heads and tails, magnified tenfold time and again."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_numbers import spread, toss_many

MAGNIFICATION = 10


@dataclass(frozen=True, kw_only=True)
class Magnified:
    """What windows about a boundary show, each a tenth as long as the one before."""

    counts: NDArray[np.int64]
    """The number of boundaries in each window, (n,)."""
    from_upright: Array
    """How near to standing the tosses at its two sides came in their last contact, (n, 2) [m g r]."""
    impacts: NDArray[np.int64]
    """The number of impacts of these two tosses, (n, 2)."""

    @property
    def isolated_from(self) -> int | None:
        """The first window from which on the boundary is alone in it; None where in the last it is not."""
        several = np.flatnonzero(self.counts > 1)
        first = int(several[-1]) + 1 if len(several) else 0
        return first if first < len(self.counts) else None


def magnify(
    coin: PlanarCoin, units: Units, start: PlanarRelease, *, length: Fraction, windows: int, points: int
) -> Magnified:
    """Follow the middle one of the boundaries in a window of heights.

    Args:
        coin: the coin.
        units: of it.
        start: release at the lower end of the first window.
        length: of the first window [m].
        windows: how many.
        points: releases in each.
    """
    counts, nearest, impacts = [], [], []
    for _ in range(windows):
        step = length / (points - 1)
        line = spread(start, "height", step, points)
        tosses = toss_many(coin, units, line)
        changes = [n for n, (one, other) in enumerate(pairwise(tosses)) if one.outcome != other.outcome]
        if not changes:
            raise ValueError("no boundary: accepted: a window whose tosses differ")
        counts.append(len(changes))
        at = changes[len(changes) // 2]
        sides = toss_many(coin, units, line[at : at + 2], to_contact=True)
        nearest.append([side.from_upright for side in sides])
        impacts.append([len(toss.impacts) for toss in tosses[at : at + 2]])
        length /= MAGNIFICATION
        start = line[at]._replace(height=line[at].height + step / 2 - length / 2)
    return Magnified(counts=np.array(counts), from_upright=np.array(nearest), impacts=np.array(impacts))
