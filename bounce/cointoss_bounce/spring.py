"""Contacts whose force vanishes as they part, damped by speed or by depth: restitution, duration, damping."""

import math
from collections.abc import Callable

BISECTIONS = 60


def restitution_of(zeta: float) -> float:
    """Return the restitution of a damped spring that lets go when its force reaches zero.

    The force k x + d ẋ vanishes before the spring is back at its length. With ζ = d/(2 √k):
    e = exp(-(2 ζ/s) atan2(s, ζ)), s = √(1 - ζ²), for ζ < 1; exp(-2) for ζ = 1; and
    exp(-(2 ζ/q) artanh(q/ζ)), q = √(ζ² - 1), for ζ > 1.

    Args:
        zeta: damping ratio ζ >= 0.
    """
    if zeta == 1:
        return math.exp(-2)
    s = math.sqrt(abs(1 - zeta * zeta))
    turned = math.atan2(s, zeta) if zeta < 1 else math.atanh(s / zeta)
    return math.exp(-2 * zeta / s * turned)


def damping_ratio_of(restitution: float) -> float:
    """Return the damping ratio ζ of a spring that rebounds with a restitution, by bisection.

    Args:
        restitution: e, 0 < e <= 1.
    """
    if restitution == 1:
        return 0.0
    # e falls like 1/(4 ζ²) for large ζ, so the root lies below 1/√e.
    return end_of(lambda zeta: restitution_of(zeta) > restitution, 0.0, 1 + 1 / math.sqrt(restitution))


def rebound_of(loss: float) -> float:
    """Return the restitution of Hunt and Crossley's contact, f = k x (1 + d v), for a = d v before it.

    With b = d v' after it, a - ln(1 + a) = -b - ln(1 - b), and e = b/a: with 1 - b = exp(-u) the right side
    is u - b.

    Args:
        loss: a >= 0.
    """
    left = loss - math.log1p(loss)
    return -math.expm1(-end_of(lambda u: u + math.expm1(-u) < left, 0.0, left + 1)) / loss if loss else 1.0


def dissipation_of(restitution: float) -> float:
    """Return Hunt and Crossley's d v with which a contact at the speed v has a restitution, by bisection.

    Args:
        restitution: e, 0 < e <= 1.
    """
    # b < 1, so the root lies below 1/e.
    return 0.0 if restitution == 1 else end_of(lambda a: rebound_of(a) > restitution, 0.0, 1 / restitution)


def end_of(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return where between two numbers a condition ceases to hold, by bisection."""
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return (low + high) / 2


def contact_duration(zeta: float) -> float:
    """Return how long the spring pushes, in units of 1/√k: e = exp(-ζ √k t).

    Args:
        zeta: damping ratio ζ >= 0.
    """
    return -math.log(restitution_of(zeta)) / zeta if zeta else math.pi
