"""An ideal coin whose normal turns about an axis that is fixed in space: its attitude in closed form.

An ideal coin is a symmetric top, J_C = diag(J_ξ, J_ξ, J_ζ) about its centre. In vacuum its normal turns about
the angular momentum L at the rate |L|/J_ξ, and the coin turns under it about ζ at (1 - J_ζ/J_ξ) ω_ζ. In air
with b = 0 a coin without spin about ζ keeps the axis of ω, while ω dies away as exp(-d_t t/J_ξ).
"""

import math
from typing import NamedTuple

from models.attitude import rotation_matrix
from models.body import in_vacuum, is_ideal
from models.compiled import compiled
from models.vectors import Vector, add, apply, cross, dot, norm, scale, subtract


class Turning(NamedTuple):
    """How the coin turns from the start of a flight on: n(φ) = mean + cosine cos φ + sine sin φ."""

    axis: Vector
    """Unit vector, space frame."""
    rate: float
    """Of φ, at the start [rad/s]."""
    slowing: float
    """The rate dies away as exp(-slowing t) [1/s]."""
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
    axis = scale(1 / rate, turn) if rate > 0 else (0.0, 0.0, 1.0)
    n = (R[0][2], R[1][2], R[2][2])
    mean = scale(dot(axis, n), axis)
    slowing = 0.0 if in_vacuum(body) else body.drag.moment_tangential / J[0][0]
    return Turning(axis, rate, slowing, (1 - ratio) * w[2], mean, subtract(n, mean), cross(axis, n))


@compiled
def angle_turned(turning, t):
    """Give the angle φ [rad] by which the normal has turned at the time t of the flight [s], and its rate."""
    if turning.slowing == 0:
        return turning.rate * t, turning.rate
    lost = math.expm1(-turning.slowing * t)
    return -turning.rate * lost / turning.slowing, turning.rate * (1 + lost)


@compiled
def normal_at(turning, t):
    """Give the coin's normal and its rate of change [1/s] at the time t of the flight [s], space frame."""
    angle, rate = angle_turned(turning, t)
    c, s = math.cos(angle), math.sin(angle)
    n = add(turning.mean, add(scale(c, turning.cosine), scale(s, turning.sine)))
    return n, add(scale(-rate * s, turning.cosine), scale(rate * c, turning.sine))


@compiled
def turn(turning, y, t, y_new):
    """Write the attitude and the angular velocity of the state at the time t of a flight into y_new.

    e = (turn by φ about the axis) ∘ e_0 ∘ (turn by spin t about ζ), brought back to norm 1.

    Args:
        turning: of the flight.
        y: state at its start, (13,).
        t: time [s].
        y_new: state, (13,).
    """
    angle, rate = angle_turned(turning, t)
    c, s = math.cos(angle / 2), math.sin(angle / 2)
    a, b, d = scale(s, turning.axis)
    e0, e1, e2, e3 = y[6], y[7], y[8], y[9]
    e0, e1, e2, e3 = (
        c * e0 - a * e1 - b * e2 - d * e3,
        c * e1 + a * e0 + b * e3 - d * e2,
        c * e2 + b * e0 + d * e1 - a * e3,
        c * e3 + d * e0 + a * e2 - b * e1,
    )
    left = rate / turning.rate if turning.rate > 0 else 1.0
    w_xi, w_eta = left * y[10], left * y[11]
    if turning.spin != 0:
        half = turning.spin * t / 2
        c, s = math.cos(half), math.sin(half)
        e0, e1, e2, e3 = c * e0 - s * e3, c * e1 + s * e2, c * e2 - s * e1, c * e3 + s * e0
        c, s = c * c - s * s, 2 * s * c
        w_xi, w_eta = c * w_xi + s * w_eta, c * w_eta - s * w_xi
    size = (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3) ** 0.5
    y_new[6], y_new[7], y_new[8], y_new[9] = e0 / size, e1 / size, e2 / size, e3 / size
    y_new[10], y_new[11], y_new[12] = w_xi, w_eta, y[12]
