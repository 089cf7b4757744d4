"""An ideal coin whose normal turns about an axis that is fixed in space: its attitude in closed form.

An ideal coin is a symmetric top, J_C = diag(J_ξ, J_ξ, J_ζ) about its centre. In vacuum its normal turns about
the angular momentum L at the rate |L|/J_ξ, and the coin turns under it about ζ at (1 - J_ζ/J_ξ) ω_ζ. In air
with b = 0 a coin without spin about ζ keeps the axis of ω, while ω dies away as u = exp(-δ t), δ = d_t/J_ξ:
it turns at a constant rate against the clock s = (1 - u)/δ, which is t itself in vacuum.
"""

import math
from typing import NamedTuple

from cointoss.analytic.flight.state_vector import attitude_of, normalise, set_attitude, set_spin, spin_of
from cointoss.models.attitude import quaternion_product
from cointoss.models.body import Body, in_vacuum, is_ideal
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, apply, cross, dot, norm, scale, subtract
from cointoss.models.state import State

# Slower turning counts as none [rad/s]: the squares of its components would underflow.
_STILL = 1e-150


class Turning(NamedTuple):
    """How the coin turns: n = mean + cosine cos φ + sine sin φ, φ = rate s."""

    axis: Vector
    """Unit vector, space frame."""
    rate: float
    """The rate of φ [rad/s]."""
    spin: float
    """The spin of the coin about ζ beside the turning about the axis [rad/s]."""
    mean: Vector
    """Space frame, as the next two."""
    cosine: Vector
    sine: Vector


@compiled
def turns_in_closed_form(body: Body, w: Vector) -> bool:
    """Return whether a coin with the angular velocity w turns in closed form.

    Args:
        body: the coin.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return is_ideal(body) and (in_vacuum(body) or (body.air.exponent is None and w[2] == 0))


@compiled
def turning_of(body: Body, state: State) -> Turning:
    """Return the `Turning` of a coin that turns in closed form.

    Args:
        body: the coin.
        state: at the start.
    """
    R, w, J = state.R, state.spin, body.inertia
    ratio = J[2][2] / J[0][0]
    turn = apply(R, (w[0], w[1], ratio * w[2]))
    rate = norm(turn)
    # In air it is across the normal; so let it be where there is none.
    axis = (R[0][0], R[1][0], R[2][0])
    if rate > _STILL:
        axis = scale(1 / rate, turn)
    else:
        rate = 0.0
    n = (R[0][2], R[1][2], R[2][2])
    mean = scale(dot(axis, n), axis)
    return Turning(axis, rate, (1 - ratio) * w[2], mean, subtract(n, mean), cross(axis, n))


@compiled
def turn(turning: Turning, y: Array, s: float, left: float, y_new: Array) -> None:
    """Write attitude and angular velocity of a later state into y_new.

    e = (turn by φ about the axis) ∘ e_0 ∘ (turn by spin s about ζ), brought back to norm 1.

    Args:
        turning: from y on.
        y: state, (13,).
        s: clock [s].
        left: u, what the air has left of the angular velocity.
        y_new: state, (13,).
    """
    half = turning.rate * s / 2
    turned = (math.cos(half), *scale(math.sin(half), turning.axis))
    w_xi, w_eta, w_zeta = spin_of(y)
    set_attitude(y_new, quaternion_product(turned, attitude_of(y)))
    set_spin(y_new, (left * w_xi, left * w_eta, w_zeta))
    if turning.spin != 0:
        turn_under(y_new, turning.spin * s)
    normalise(y_new)


@compiled
def turn_under(y: Array, angle: float) -> None:
    """Turn the coin in the state y, (13,), about ζ by an angle [rad]; in space ω stays what it is."""
    c, d = math.cos(angle / 2), math.sin(angle / 2)
    set_attitude(y, quaternion_product(attitude_of(y), (c, 0.0, 0.0, d)))
    c, d = c * c - d * d, 2 * c * d
    w_xi, w_eta, w_zeta = spin_of(y)
    set_spin(y, (c * w_xi + d * w_eta, c * w_eta - d * w_xi, w_zeta))
