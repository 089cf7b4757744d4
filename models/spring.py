"""A damped spring that lets go when its force vanishes: its restitution, and the damping for one."""

import math

from cointoss.models.kernel.compiled import compiled

_BISECTIONS = 55


@compiled
def restitution_of(zeta: float) -> float:
    """Return the restitution of a damped spring that lets go when its force reaches zero.

    The force k x + d ẋ vanishes before the spring is back at its length. With ζ = d/(2 √k):
    χ = exp(-(2 ζ/s) atan2(s, ζ)), s = √(1 - ζ²), for ζ < 1; exp(-2) for ζ = 1; and
    exp(-(2 ζ/q) artanh(q/ζ)), q = √(ζ² - 1), for ζ > 1.

    Args:
        zeta: damping ratio ζ >= 0.
    """
    if zeta < 1:
        s = math.sqrt(1 - zeta * zeta)
        return math.exp(-2 * zeta / s * math.atan2(s, zeta))
    if zeta == 1:
        return math.exp(-2)
    q = math.sqrt(zeta * zeta - 1)
    return math.exp(-2 * zeta / q * math.atanh(q / zeta))


@compiled
def damping_ratio_of(restitution: float) -> float:
    """Return the damping ratio ζ of a spring that rebounds with `restitution`, by bisection.

    Args:
        restitution: χ, 0 < χ <= 1.
    """
    if restitution == 1:
        return 0.0
    # χ falls like 1/(4 ζ²) for large ζ, so the root lies below 1/√χ.
    low, high = 0.0, 1 + 1 / math.sqrt(restitution)
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        if restitution_of(middle) > restitution:
            low = middle
        else:
            high = middle
    return (low + high) / 2
