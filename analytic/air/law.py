"""The air's law for one element of surface, |v|^b v, for 0 < b <= 1."""

from typing import NamedTuple

from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector


class AirMotion(NamedTuple):
    """How the coin moves through air with 0 < b <= 1, and how that motion changes; body frame."""

    exponent: float
    """b."""
    v: Vector
    """Velocity of B [m/s]."""
    w: Vector
    """Angular velocity [rad/s]."""
    dv: Vector
    """Change of v [m/s]."""
    dw: Vector
    """Change of w [rad/s]."""


@compiled
def power(square: float, b: float) -> float:
    """Return |v|^b from |v|², for 0 < b <= 1."""
    return square**0.5 if b == 1 else square ** (b / 2)


@compiled
def changed_law(a_0: float, a_1: float, da_0: float, da_1: float, b: float) -> tuple[float, float]:
    """Return the change of |a|^b a with the plane vector a: |a|^b da + b |a|^(b-2) (a . da) a.

    Bounded, but without a limit at a = 0, where 0 is given.
    """
    square = a_0 * a_0 + a_1 * a_1
    if square == 0:
        return 0.0, 0.0
    size = power(square, b)
    along = b * (a_0 * da_0 + a_1 * da_1) / square
    return size * (da_0 + along * a_0), size * (da_1 + along * a_1)
