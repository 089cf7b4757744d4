"""Shares on edge by laws of one formula, and the coin that ends on its edge in a third of its tosses."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from cointoss.study import LEVEL, Array, Estimate

DRAWS = 2000
"""Samples by which the interval of the fair coin is found."""


def corner(aspect: float | Array) -> Any:
    """Return the angle between coin and vertical below which a resting coin falls onto its edge [rad]."""
    return np.arctan(aspect)


def edge_by_angle(aspect: float | Array) -> Any:
    """Return the part of all turns about a diameter in which C is on the edge's side: (2/π) atan(h/D)."""
    return 2 / np.pi * corner(aspect)


def edge_by_solid_angle(aspect: float | Array) -> Any:
    """Return the part of all attitudes in which C is on the edge's side: (h/D)/√(1 + (h/D)²)."""
    return np.sin(corner(aspect))


def edge_of_die(aspect: float | Array) -> Any:
    """Return the share on edge of a planar die with sides h and D (Pender and Uhrin 2014, arXiv 1407.6307).

    It lands on h over on D as (c - D)/(c - h) atan(h/D)/atan(D/h), c its diagonal.
    """
    c = np.hypot(1, aspect)
    edge_over_face = (c - 1) / (c - aspect) * np.arctan(aspect) / np.arctan(1 / aspect)
    return edge_over_face / (1 + edge_over_face)


_ROOT: Any = brentq(lambda aspect: edge_of_die(aspect) - 1 / 3, 0.1, 2)
ANGLE, SOLID_ANGLE, DIE = 3**-0.5, 8**-0.5, float(_ROOT)
"""h/D at which C is on the edge's side in a third of all turns about a diameter, and of all attitudes; and at
which Pender and Uhrin's die is on edge in a third of its throws."""


def fair(aspects: Array, edges: NDArray[Any], counts: NDArray[Any], rng: np.random.Generator) -> Estimate:
    """Return the h/D at which a third of the tosses end on edge; NaN where the share does not reach a third.

    The share is taken to be linear in ln(h/D) between two neighbours. The interval is of samples drawn from
    the shares found; where one has no such coin, it is open.

    Args:
        aspects: h/D of the coins, increasing, (n,).
        edges: numbers of tosses on edge, (n,).
        counts: numbers of tosses, (n,).
        rng: the source of chance.
    """
    drawn = rng.binomial(counts, edges / counts, (DRAWS, len(counts)))
    value, *others = (_crossing(np.log(aspects), one / counts) for one in (edges, *drawn))
    with np.errstate(invalid="ignore"):  # between two that are infinite
        ends = np.quantile(np.nan_to_num(others, nan=np.inf), [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    low, high = np.where(np.isnan(ends), np.inf, ends)
    return Estimate(value, float(low), float(high), int(counts.sum()))


def _crossing(x: Array, shares: Array) -> float:
    """Return exp(x) where the shares last rise through a third, NaN where they do not."""
    rising = np.flatnonzero((shares[:-1] < 1 / 3) & (shares[1:] >= 1 / 3))
    if not len(rising):
        return float("nan")
    i = rising[-1]
    return float(np.exp(x[i] + (1 / 3 - shares[i]) / (shares[i + 1] - shares[i]) * (x[i + 1] - x[i])))
