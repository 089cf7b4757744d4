"""Gauss's rules on an interval, plain or graded towards one end."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Rule = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Nodes and weights on [0, 1]."""


def gauss_rule(n: int) -> Rule:
    """Return the n nodes and weights of Gauss and Legendre for [0, 1]."""
    x, weights = np.polynomial.legendre.leggauss(n)
    return (x + 1) / 2, weights / 2


def graded_rule(n: int, grading: int) -> Rule:
    """Return n nodes and weights for functions on [0, 1] that are not smooth at 0, or near it.

    Gauss's rule in t with x = t^p, p the grading. A power x^s, s > -1, becomes t^(p s + p - 1), for which
    the rule converges as n^(-2p(s + 1)). A branch point at a distance ε from x = 0, off the interval, has
    after the change of variables an angle of at least π/(2p) to the interval for every ε: the same n serves
    for all.
    """
    t, weights = gauss_rule(n)
    return t**grading, grading * t ** (grading - 1) * weights


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
