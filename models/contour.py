"""What resists a contact point that runs round the rim of a tilted coin: the contour, and the air under it.

The lowest point of a rim runs round it at the rate φ', φ of the classical angles, seen from the coin. It is
conjugate to the horizontal moment along ĝ, the direction in which the normal leans: ω · ĝ = φ' sin θ, so that
a power P(φ') is that of a moment P/(φ' sin θ) against ω · ĝ. The powers are N (c |φ'| + c_v φ'²) on the
contour (R. I. Leine, Arch. Appl. Mech. 79, 1063, 2009) and (π/4) η r³ φ'²/sin θ in the air that is sheared
between floor and coin (H. K. Moffatt, Nature 404, 833, 2000: π η g r²/α² at his Ω² = 4 g/(r α)).
"""

import math
from typing import NamedTuple

from cointoss.models.body import Body
from cointoss.models.geometry import tilt_sine_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector
from cointoss.models.rest import slow_spin

_LONGEST = 0.9
"""The floor's moments have arms up to this part of the one beyond which its force may have no solution."""
_FLAT = 1e-300


class Contour(NamedTuple):
    """What is lost as the contact point runs round the rim."""

    friction: float = 0.0
    """c [m]."""
    viscosity: float = 0.0
    """c_v [m s]."""
    air: float = 0.0
    """η of the air between floor and coin [Pa s]."""


@compiled
def has_contour(contour: Contour) -> bool:
    """Return whether anything is lost as the contact point runs round the rim."""
    return contour.friction > 0 or contour.viscosity > 0 or contour.air > 0


@compiled
def leaning(up: Vector) -> Vector:
    """Return ĝ, the horizontal unit vector along which the coin's normal leans, body frame, (3,).

    It is 0 where the coin is flat; up: the upward unit vector, body frame, (3,).
    """
    sine = max(tilt_sine_of(up), _FLAT)
    return -up[2] * up[0] / sine, -up[2] * up[1] / sine, sine


@compiled
def longest_arm(body: Body, rolling: float, pivoting: float) -> float:
    """Return the longest arm that the contour's moment has over the normal force [m].

    With all moments of the floor shorter than 2 √(J/m), J the least moment of inertia, its force has a
    solution; see `cointoss.analytic.contact.resistance`. Of the thin ideal coin that is the radius: the
    floor's pressure would act beyond the coin.

    Args:
        body: the coin.
        rolling: δ [m].
        pivoting: p [m].
    """
    squared = 4 * body.inertia_smallest / body.mass - pivoting * pivoting
    return _LONGEST * (squared**0.5 - rolling)


@compiled
def contour_per_force(body: Body, contour: Contour, longest: float, sine: float, turn: float) -> float:
    """Return the moment of the contour against ω · ĝ over the normal force and ω · ĝ [m s].

    Below `slow_spin` contour friction grows in proportion to ω · ĝ.

    Args:
        body: the coin.
        contour: its losses.
        longest: the `longest_arm` [m].
        sine: of the tilt θ.
        turn: ω · ĝ [rad/s].
    """
    least = max(abs(turn), slow_spin(body))
    return min(contour.friction / (sine * least) + contour.viscosity / (sine * sine), longest / least)


@compiled
def air_moment_per_spin(body: Body, contour: Contour, sine: float, turn: float) -> float:
    """Return the moment of the air between floor and coin against ω · ĝ over ω · ĝ [N m s].

    It is no larger than the weight's about the rim can be, which is where Moffatt's steady motion ends.

    Args: as `contour_per_force`'s.
    """
    r = body.radius
    least = max(abs(turn), slow_spin(body))
    sheared = math.pi / 4 * contour.air * r * r * r / (sine * sine * sine)
    return min(sheared, body.mass * body.gravity * r / least)
