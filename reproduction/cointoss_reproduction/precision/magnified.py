"""One boundary between heads and tails, magnified tenfold time and again."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.precision.double_double import exact, pair_of
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_state import spread
from cointoss_reproduction.precision.planar_toss import toss_many

MAGNIFICATION = 10


@dataclass(frozen=True, kw_only=True)
class Magnified:
    """What windows about a boundary show, each a tenth as long as the one before."""

    counts: NDArray[np.int64]
    """Boundaries in each, (n,)."""
    from_upright: Array
    """How near to standing the tosses at its two sides came in their last contact, (n, 2) [m g r]."""
    impacts: NDArray[np.int64]
    """Of these, (n, 2)."""

    @property
    def isolated_from(self) -> int | None:
        """The first window from which on the boundary is alone in it; None where in the last it is not."""
        several = np.flatnonzero(self.counts > 1)
        first = int(several[-1]) + 1 if len(several) else 0
        return first if first < len(self.counts) else None


def magnify(
    coin: PlanarCoin, start: Array, *, row: int, length: Fraction, windows: int, points: int
) -> Magnified:
    """Follow the middle one of the boundaries in a window.

    Args:
        coin: the coin.
        start: release at the lower end of the first window, (5, 2).
        row: of the state: what varies.
        length: of the first window [its unit in the state].
        windows: how many.
        points: releases in each.
    """
    counts, nearest, impacts = [], [], []
    for _ in range(windows):
        step = length / (points - 1)
        states = spread(start[None], row, pair_of(step), points)
        outcomes = toss_many(coin, states)
        changes = np.flatnonzero(outcomes.outcome[1:] != outcomes.outcome[:-1])
        if len(changes) == 0:
            raise ValueError("no boundary: accepted: a window whose tosses differ")
        counts.append(len(changes))
        at = changes[len(changes) // 2]
        nearest.append(toss_many(coin, states[at : at + 2], to_contact=True).from_upright)
        impacts.append(outcomes.impacts[at : at + 2])
        length /= MAGNIFICATION
        start = states[at].copy()
        start[row] = pair_of(exact(tuple(start[row])) + step / 2 - length / 2)
    return Magnified(counts=np.array(counts), from_upright=np.array(nearest), impacts=np.array(impacts))
