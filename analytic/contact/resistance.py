"""Resistance to rolling, pivoting and the run round the rim: moments about a rim point by the force there.

With a unit normal force at A comes the moment -δ ω_h/|ω_h| - p ω_z/|ω_z| ẑ, ω_h the part of ω along the
floor, so that the force F at A gives dv_A/dt = b + (K + q ẑᵀ) F, q the acceleration of A by that moment. What
holds for K without resistance holds with K + q ẑᵀ: N and the moments are found together. They oppose ω, and
take energy at the rate N (δ |ω_h| + p |ω_z|). Below `slow_spin` either grows in proportion to ω. The losses
of `cointoss.models.contour` come on top: a moment along ĝ, where the normal leans, and one of the air under
the coin, which no force comes with.
"""

from typing import NamedTuple

from cointoss.models.body import Body
from cointoss.models.contour import (
    Contour,
    air_moment_per_spin,
    contour_per_force,
    has_contour,
    leaning,
    longest_arm,
)
from cointoss.models.geometry import tilt_sine_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, dot, norm, scale, subtract
from cointoss.models.rest import slow_spin


class FloorFriction(NamedTuple):
    """What the floor has against the motion of a coin in sustained contact."""

    sliding: float
    """μ; 0 on a smooth floor."""
    rolling: float = 0.0
    """δ [m]."""
    pivoting: float = 0.0
    """p [m]."""
    contour: Contour = Contour()
    """The losses of the contact point that runs round the rim."""


FRICTIONLESS = FloorFriction(0.0)
"""The friction of a floor that acts on a coin in contact by its normal force alone."""


@compiled
def has_resistance(friction: FloorFriction) -> bool:
    """Return whether floor or air resist rolling, pivoting or the run of the contact point round the rim."""
    return friction.rolling > 0 or friction.pivoting > 0 or has_contour(friction.contour)


@compiled
def is_smooth(friction: FloorFriction) -> bool:
    """Return whether the floor acts on a coin by its normal force alone."""
    return friction.sliding == 0 and not has_resistance(friction)


@compiled
def moment_per_force(body: Body, friction: FloorFriction, up: Vector, w: Vector) -> Vector:
    """Return the floor's moment on a coin for a unit normal force, in the frame of its arguments, (3,) [m].

    Args:
        body: the coin.
        friction: `FloorFriction`.
        up: the upward unit vector, (3,).
        w: angular velocity, (3,) [rad/s].
    """
    slow, w_z = slow_spin(body), dot(up, w)
    w_h = subtract(w, scale(w_z, up))
    rolling = -friction.rolling / max(norm(w_h), slow)
    pivoting = -friction.pivoting / max(abs(w_z), slow)
    return add(scale(rolling, w_h), scale(pivoting * w_z, up))


@compiled
def contour_moment_per_force(body: Body, friction: FloorFriction, up: Vector, w: Vector) -> Vector:
    """Return the moment of the contour for a unit normal force, body frame, (3,) [m].

    Args:
        body: the coin.
        friction: `FloorFriction`.
        up: the upward unit vector, body frame, (3,), the coin not being flat.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    g = leaning(up)
    turn, longest = dot(g, w), longest_arm(body, friction.rolling, friction.pivoting)
    return scale(-turn * contour_per_force(body, friction.contour, longest, tilt_sine_of(up), turn), g)


@compiled
def air_moment(body: Body, friction: FloorFriction, up: Vector, w: Vector) -> Vector:
    """Return the moment of the air under the coin, body frame, (3,) [N m]; args as above."""
    g = leaning(up)
    turn = dot(g, w)
    return scale(-turn * air_moment_per_spin(body, friction.contour, tilt_sine_of(up), turn), g)
