"""Gauss's rules on an interval, plain or graded towards one end."""

import math
from decimal import Decimal, localcontext
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.circle import EXACT

Rule = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Nodes and weights on [0, 1]."""


def gauss_rule(n: int) -> Rule:
    """Return the n nodes and weights of Gauss and Legendre for [0, 1]."""
    return graded_rule(n, 1)


def graded_rule(n: int, grading: int) -> Rule:
    """Return n nodes and weights for functions on [0, 1] that are not smooth at 0, or near it.

    Gauss's rule in t with x = t^p, p the grading. A power x^s, s > -1, becomes t^(p s + p - 1), for which
    the rule converges as n^(-2p(s + 1)). A branch point at a distance ε from x = 0, off the interval, has
    after the change of variables an angle of at least π/(2p) to the interval for every ε: the same n serves
    for all.
    """
    with localcontext(EXACT):
        found = [((1 + x) / 2, weight / 2) for x, weight in _legendre(n)]
        rows = [(float(t**grading), float(grading * t ** (grading - 1) * weight)) for t, weight in found]
    nodes, weights = np.array(rows).T
    return nodes.copy(), weights.copy()


@cache
def _legendre(n: int) -> list[tuple[Decimal, Decimal]]:
    """Return the roots x of P_n, increasing, and the weights 2/((1 - x²) P_n'(x)²), to many digits.

    numpy's are eigenvalues, whose last bits depend on the machine. Each of Newton's steps doubles the digits.
    """
    half = []
    for i in range((n + 1) // 2):
        x = -math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(3):
            x -= _newton(n, x)[0]
        x = Decimal(x) - _newton(n, Decimal(x))[0]
        step, slope = _newton(n, x)
        half.append((x - step, 2 / ((1 - x * x) * slope * slope)))
    return half + [(-x, weight) for x, weight in reversed(half[: n // 2])]


def _newton(n: int, x: Any) -> tuple[Any, Any]:
    """Return P_n(x)/P_n'(x), and P_n'(x), in the arithmetic of x."""
    before, P = 1, x
    for k in range(2, n + 1):
        before, P = P, ((2 * k - 1) * x * P - (k - 1) * before) / k
    slope = n * (before - x * P) / (1 - x * x)
    return P / slope, slope


class Nodes(NamedTuple):
    """The graded rules of one evaluation."""

    x: NDArray[np.float64]
    """Nodes for the integrals over faces and rims, and for pressure along the wall."""
    weights: NDArray[np.float64]
    around_x: NDArray[np.float64]
    """Nodes around the wall for what is integrated along it already, which is smoother by a power."""
    around_weights: NDArray[np.float64]
    digits: float
    """-ln of the error for which plain rules are chosen by their distance from the branch points."""


def nodes_of(n: int, n_around: int, digits: float) -> Nodes:
    """Return graded rules of n and n_around nodes, and plain ones good to exp(-digits)."""
    return Nodes(*graded_rule(n, 5), *graded_rule(n_around, 4), digits)


# The integrand of the change is rougher by a power than that of the force. The tests compare both with finer
# rules over all kinds of motion.
FORCE_NODES, CHANGE_NODES = nodes_of(32, 28, 28.0), nodes_of(48, 48, 28.0)
CONTACT_NODES = nodes_of(24, 14, 20.0)
"""Of a step of sustained contact, which may err by more."""
