"""An ideal coin whose normal turns about an axis that is fixed in space: its attitude in closed form.

An ideal coin is a symmetric top, J_C = diag(J_ξ, J_ξ, J_ζ) about its centre. In vacuum its normal turns about
the angular momentum L at the rate |L|/J_ξ, and the coin turns under it about ζ at (1 - J_ζ/J_ξ) ω_ζ. In air
with b = 0 a coin without spin about ζ keeps the axis of ω, while ω dies away as u = exp(-δ t), δ = d_t/J_ξ:
it turns at a constant rate against the clock s = (1 - u)/δ, which is t itself in vacuum.
"""

import math
from typing import NamedTuple

from models.attitude import rotation_matrix
from models.body import in_vacuum, is_ideal
from models.kernel.compiled import compiled
from models.kernel.vectors import Vector, apply, cross, dot, norm, scale, subtract

# Turning slower than that is none [rad/s]: the squares of its parts would be below the range of numbers.
_STILL = 1e-150


class Turning(NamedTuple):
    """How the coin turns: n = mean + cosine cos φ + sine sin φ, φ = rate s."""

    axis: Vector
    """Unit vector, space frame."""
    rate: float
    """Of φ [rad/s]."""
    spin: float
    """Of the coin about ζ beside the turning about the axis [rad/s]."""
    mean: Vector
    """Space frame, as the next two."""
    cosine: Vector
    sine: Vector


@compiled
def turns_in_closed_form(body, w):
    """Tell whether a coin with the angular velocity w turns in closed form.

    Args:
        body: the coin.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return is_ideal(body) and (in_vacuum(body) or (body.air.exponent is None and w[2] == 0))


@compiled
def turning_of(body, e, w):
    """Give the `Turning` of a coin that turns in closed form.

    Args:
        body: the coin.
        e: Euler parameters at the start, body to space, (4,).
        w: angular velocity at the start, body frame, (3,) [rad/s].
    """
    R, J = rotation_matrix(e), body.inertia
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
def turn(turning, y, s, left, y_new):
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
    c = math.cos(half)
    a, b, d = scale(math.sin(half), turning.axis)
    e0, e1, e2, e3 = y[6], y[7], y[8], y[9]
    e0, e1, e2, e3 = (
        c * e0 - a * e1 - b * e2 - d * e3,
        c * e1 + a * e0 + b * e3 - d * e2,
        c * e2 + b * e0 + d * e1 - a * e3,
        c * e3 + d * e0 + a * e2 - b * e1,
    )
    w_xi, w_eta = left * y[10], left * y[11]
    if turning.spin != 0:
        half = turning.spin * s / 2
        c, d = math.cos(half), math.sin(half)
        e0, e1, e2, e3 = c * e0 - d * e3, c * e1 + d * e2, c * e2 - d * e1, c * e3 + d * e0
        c, d = c * c - d * d, 2 * c * d
        w_xi, w_eta = c * w_xi + d * w_eta, c * w_eta - d * w_xi
    size = (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3) ** 0.5
    y_new[6], y_new[7], y_new[8], y_new[9] = e0 / size, e1 / size, e2 / size, e3 / size
    y_new[10], y_new[11], y_new[12] = w_xi, w_eta, y[12]
