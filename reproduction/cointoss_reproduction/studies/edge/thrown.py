"""Three-sided coins that were thrown: the shares quoted of them, and the floor on which tosses give them."""

from math import erfc
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from cointoss.study import Estimate
from cointoss_reproduction.frame.selection import measured
from cointoss_reproduction.setups.edge_classes import DIAMETRAL, WOBBLING

QUOTED = {"0.353553": 132, "0.57735": 410}
"""Throws on edge, by h/D: M. Parker, "How thick is a three-sided coin?" (a film of 2018), at second hand.

The shares, 13.2 % and 41.0 %, stand in README.md of github.com/iaroslav-ai/coin-experiment, the number of
throws at frankforce.com/?p=5559.
"""
SHAPES = {f"h/D = {float(aspect):.3f}": aspect for aspect in QUOTED}
THROWS, AS_QUOTED = 1000, "quoted of 1,000 throws each"
"""How often each of the two coins was thrown, and what the table calls the throws."""
CHIS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.5)
FLOORS: dict[str, tuple[str, dict[str, Any]]] = {
    **{f"χ = {chi:g}": (WOBBLING, {"restitution": chi}) for chi in CHIS},
    **{f"χ = 0.1, μ = {mu:g}": (WOBBLING, {"restitution": 0.1, "friction": mu}) for mu in (0.15, 0.6)},
    "χ = 0.1, about a diameter": (DIAMETRAL, {"restitution": 0.1}),
}
"""The hand, and what differs from `BASE`, by the name in the table."""
_NORMAL, _INSIDE = 2.5758, 6.635
"""Half the width of an interval of 99 %, in standard deviations; the square of it."""
_FINE = np.linspace(0, max(CHIS), 501)
"""The restitutions at which the model's shares are compared."""


class FittedFloor(NamedTuple):
    """The restitution with which the model comes nearest to the quoted shares."""

    chi: Estimate
    chance: float
    """The probability that shares differ by chance as much from the model's, at the best χ."""


def fitted_floor(cells: pd.DataFrame) -> FittedFloor:
    """Return the one χ that fits both coins, all else as in `BASE`; a parabola smooths the shares over χ.

    Args:
        cells: rows of "thrown", by floor and h/D, with the share on edge as `part`.
    """
    misfit = np.zeros_like(_FINE)
    for shape in SHAPES:
        rows = f"of == 'thrown' and shape == '{shape}'"
        parts = measured(cells, {"where": rows, "value": "part", "key": ["floor"]})
        mine = [parts[f"χ = {chi:g}"] for chi in CHIS]
        weights = [1 / _deviation(one) for one in mine]
        curve, covariance = np.polyfit(CHIS, [one.value for one in mine], 2, w=weights, cov="unscaled")
        powers = np.vander(_FINE, 3)
        variance = ((powers @ covariance) * powers).sum(axis=1) + _deviation(parts[AS_QUOTED]) ** 2
        misfit += (powers @ curve - parts[AS_QUOTED].value) ** 2 / variance
    inside, best = _FINE[misfit <= misfit.min() + _INSIDE], float(_FINE[misfit.argmin()])
    chi = Estimate(best, float(inside[0]), float(inside[-1]), len(QUOTED) * THROWS, "throws")
    return FittedFloor(chi, erfc((misfit.min() / 2) ** 0.5))


def _deviation(one: Estimate) -> float:
    return (one.high - one.low) / 2 / _NORMAL
