"""A damped spring that lets go when its force vanishes: its restitution, its duration, and its damping."""

import math

BISECTIONS = 55


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
    low, high = 0.0, 1 + 1 / math.sqrt(restitution)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if restitution_of(middle) > restitution else (low, middle)
    return (low + high) / 2


def contact_duration(zeta: float) -> float:
    """Return how long the spring pushes, in units of 1/√k: e = exp(-ζ √k t).

    Args:
        zeta: damping ratio ζ >= 0.
    """
    return -math.log(restitution_of(zeta)) / zeta if zeta else math.pi
