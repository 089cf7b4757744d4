"""The study of predictability: its record, and what follows from the shares f of uncertain tosses."""

from dataclasses import dataclass
from math import log, log10, sqrt

import numpy as np

from cointoss.study import Estimate
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES

SMOOTH, AIR, ROUGH = "smooth, vacuum", "smooth, air", "rough, vacuum"
WINDOWS = ((1e-3, 1e-6), (1e-6, 1e-9), (1e-9, 1e-12), (1e-12, 1e-18), (1e-18, 1e-24))
"""α is the slope between two accuracies [m]."""
HAND, FINE, QUANTUM = 1e-3, 1e-9, 1e-16
"""Of accuracies [m]: a hand's, an atom's size, and about `quantum_width`."""
SHOWN = (HAND, 1e-6, FINE, 1e-12, QUANTUM, 1e-20, 1e-24)
"""Accuracies at which f has its interval [m]."""
PREDICTABLE = 0.01
"""At most this share uncertain: 99 % of all tosses are predictable."""
NEARLY_SMOOTH = 0.9
"""α above it is all but a smooth boundary's."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """What was tossed, and what was found of it."""

    floor: str
    chi: float
    quantity: str
    """What varies: height, spin or tilt."""
    shares: list[float]
    """f at each of `ACCURACIES`."""
    parted: list[float]
    """Share of the tosses that part from one ε away, at each."""
    energy: float
    """That is left where they part, at the finest, in the mean [m g r]."""
    known: dict[float, Estimate]
    """f at each of `SHOWN`."""
    slopes: list[Estimate]
    """α over each of `WINDOWS`."""
    flat: dict[float, Estimate]
    """Share of the boundaries at each of `SHOWN` at which a coin lands flat, where enough are resolved."""
    tosses: int
    undecided: int

    @property
    def name(self) -> str:
        """Floor, medium, restitution, and what varies."""
        return f"{self.floor}, χ = {self.chi:g}, {self.quantity}"


@dataclass(frozen=True)
class Predictability:
    """All cases."""

    cases: list[Case]
    quantum_width: float
    """sqrt(ħ t/m) of the coin, t the time of its first fall from the middle height [m]."""

    def of(self, floor: str, quantity: str = "height") -> list[Case]:
        """Return the cases of a floor and medium, by restitution."""
        return [one for one in self.cases if (one.floor, one.quantity) == (floor, quantity)]


def within(last: float) -> tuple[tuple[float, float], ...]:
    """Return those of `WINDOWS` that end at an accuracy or before it."""
    return tuple(window for window in WINDOWS if window[1] >= last * 0.9)


@dataclass(frozen=True)
class Parting:
    """How -log10 of the accuracy at which a toss parts from its neighbour is distributed over tosses."""

    mean: float
    spread: float
    """Its standard deviation."""

    @property
    def smooth_from(self) -> float:
        """The accuracy from which on α would be nearly 1, were the distribution normal [m].

        The logarithm of a normal distribution's tail falls by (x - mean)/spread² over each unit of x.
        """
        return float(10 ** -(self.mean + NEARLY_SMOOTH * self.spread**2 * log(10)))


def parting(one: Case) -> Parting:
    """Return it from the shares that part; tosses that part above the first accuracy count as if at it."""
    x, survival = -np.log10(ACCURACIES[: len(one.parted)]), np.array(one.parted)
    mean = np.trapezoid(survival, x)
    # The trapezoidal rule, corrected at its end for steps of a decade (Euler and Maclaurin).
    square = 2 * np.trapezoid((x - x[0]) * survival, x) + survival[0] / 6
    return Parting(
        mean=float(x[0] + mean),
        spread=sqrt(max(float(square - mean**2), 0.0)),
    )


def accuracy_for(one: Case, share: float) -> float:
    """Return the accuracy at which f falls to a share, interpolated; infinite or NaN beyond all [m]."""
    f = np.array(one.shares)
    below = np.flatnonzero(f <= share)
    if len(below) == 0 or below[0] == 0:
        return float("nan" if len(below) == 0 else "inf")
    sides = [below[0], below[0] - 1]
    return float(10 ** np.interp(log10(share), np.log10(f[sides]), np.log10(ACCURACIES[sides])))


def smooth_from(one: Case) -> float:
    """Return the first accuracy of `WINDOWS` from which on α is nearly 1 in all; NaN if none is [m]."""
    slopes = [slope.value for slope in one.slopes]
    rough = [i for i, slope in enumerate(slopes) if slope < NEARLY_SMOOTH]
    first = rough[-1] + 1 if rough else 0
    return WINDOWS[first][0] if first < len(slopes) else float("nan")
