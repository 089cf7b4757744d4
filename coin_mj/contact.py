"""A restitution as a contact setting of MuJoCo: solref = "-stiffness -damping"."""

import math
from typing import NamedTuple, cast

from scipy.optimize import brentq

STIFFNESS = 1e14
"""Default stiffness k of the contact, per unit of effective mass [1/s²]."""


class Spring(NamedTuple):
    """The contact as a damped spring per unit of effective mass: a = -k x - d ẋ while it pushes."""

    stiffness: float
    """k [1/s²]."""
    damping: float
    """d [1/s]."""

    @property
    def duration(self) -> float:
        """How long half a period of the undamped spring takes, π/√k [s]."""
        return math.pi / math.sqrt(self.stiffness)


def restitution_of(zeta: float) -> float:
    """Give the restitution of a damped spring that lets go when its force reaches zero.

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


def damping_ratio_of(restitution: float) -> float:
    """Give the damping ratio ζ of a contact that rebounds with `restitution`.

    Args:
        restitution: χ, 0 < χ <= 1.

    Raises:
        ValueError: for χ = 0, out of reach of any damped spring.
    """
    if not 0 < restitution <= 1:
        raise ValueError(f"restitution = {restitution}: accepted: 0 < restitution <= 1")
    if restitution == 1:
        return 0.0
    # χ falls like 1/(4 ζ²) for large ζ, so the root lies below 1/√χ.
    widest = 1 + 1 / math.sqrt(restitution)
    return cast("float", brentq(lambda zeta: restitution_of(zeta) - restitution, 0.0, widest, xtol=1e-15))


def spring_of(restitution: float, stiffness: float = STIFFNESS) -> Spring:
    """Give the spring that rebounds with `restitution` at every point of the rim.

    Args:
        restitution: χ, 0 < χ <= 1.
        stiffness: k [1/s²].
    """
    return Spring(stiffness, 2 * damping_ratio_of(restitution) * math.sqrt(stiffness))
