"""The fall of a coin: a parabola; or through linear air, where it turns in closed form, a power series.

With n the normal, v' = -c_t/m v - (c_n - c_t)/m n (n . v) - g ẑ. There n (n . v) is (v + w)/2, where
w = 2 n (n . v) - v is v mirrored at the line of n. As n turns about a fixed axis a, at a constant rate by the
clock s of `turning`, dt = ds/(1 - δ s), both obey linear equations,

    (1 - δ s) dv/ds = -α v - β w - g ẑ
    (1 - δ s) dw/ds = -α w - β v - g ẑ_w + 2 rate (1 - δ s) a × w

with α, β = (c_n ± c_t)/2m and ẑ_w the mirror image of ẑ, for which dẑ_w/ds = 2 rate a × ẑ_w. So the
terms of their series follow one from the other; docs/FLIGHT.md derives them. On a slope g ẑ is to be read as
g times the unit vector against gravity.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.analytic.flight.state_vector import position_of, set_position, set_velocity, velocity_of
from cointoss.analytic.flight.turning import Turning
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, cross, dot, norm, scale, subtract

ORDER = 40
# What the motion turns, and what the air takes, in a piece. The first term left out is at most
# TURNED^41/41! = 2e-17 of the whole.
TURNED, TAKEN = 6.0, 1.0
# A piece lasts no longer than a free fall to the floor, but for this part of the longest.
_SHORTEST = 1 / 8
# Terms below this part of the radius are left out.
SMALLEST = 1e-17

_NONE = (0.0, 0.0, 0.0)
_INVERSE = 1 / np.arange(1, ORDER + 1)


@compiled
def fall_freely(body: Body, y: Array, t: float, y_new: Array) -> None:
    """Write position and velocity of the state at the time t of a flight on a parabola into y_new.

    Args:
        body: the coin.
        y: state at the start of the flight, (13,).
        t: time [s].
        y_new: state, (13,).
    """
    x, v, along, down = position_of(y), velocity_of(y), body.downhill, body.gravity
    moved = x[0] + t * (v[0] + t * along / 2)
    set_position(y_new, (moved, x[1] + t * v[1], x[2] + t * (v[2] - t * down / 2)))
    set_velocity(y_new, (v[0] + t * along, v[1], v[2] - t * down))


class Piece(NamedTuple):
    """A piece of a fall; its series are those of the clock s [s]."""

    first: Vector
    """The normal at its start, space frame."""
    second: Vector
    """The unit vector towards which the normal turns."""
    axis: Vector
    slowing: float
    """δ [1/s]."""
    length: float
    """The length of the piece by the clock [s]."""
    order: int
    """The order of the series: the rest is nothing."""


@compiled
def slowing_of(body: Body) -> float:
    """Return δ = d_t/J_ξ, at which linear air slows the turning [1/s]."""
    return body.drag.moment_tangential / body.inertia[0][0]


@compiled
def clock(slowing: float, t: float) -> float:
    """Return the clock s [s] at the time t [s]."""
    return -math.expm1(-slowing * t) / slowing if slowing > 0 else t


@compiled
def time_of(slowing: float, s: float) -> float:
    """Return the time t [s] at the clock s [s]."""
    return -math.log1p(-slowing * s) / slowing if slowing > 0 else s


@compiled
def longest_piece(body: Body, rate: float, y: Array) -> float:
    """Return by the clock how long a piece from the state y, (13,), is: the series holds to rounding [s].

    Where the coin will touch before, fewer terms do for a shorter piece.
    """
    taken = 2 * max(body.drag.force_normal, body.drag.force_tangential) / body.mass + slowing_of(body)
    longest = min(TURNED / (2 * rate + taken), TAKEN / taken)
    z, rise = position_of(y)[2], velocity_of(y)[2]
    fall = (rise + (rise * rise + 2 * body.gravity * max(z, 0.0)) ** 0.5) / body.gravity
    return min(longest, max(fall, _SHORTEST * longest))


@compiled
def expand(body: Body, turning: Turning, y: Array, longest: float, series: Array) -> Piece:
    """Expand the fall of a coin from the state y on.

    Args:
        body: the coin.
        turning: from y on.
        y: state, (13,).
        longest: the longest piece wanted, by the clock [s].
        series: where the coefficients of the position go, (4, ORDER + 1): what is added to it along `first`,
            `second` and the axis, and the height of C.

    Returns:
        The `Piece`.
    """
    axis, v, slowing = turning.axis, velocity_of(y), slowing_of(body)
    first = add(turning.mean, turning.cosine)
    second = cross(axis, first)
    length = min(longest_piece(body, turning.rate, y), longest)
    n, t = body.drag.force_normal / body.mass, body.drag.force_tangential / body.mass
    alpha, beta, whirl = (n + t) / 2, (n - t) / 2, 2 * turning.rate
    # Vectors have their parts along `first`, `second` and the axis from here on.
    up, V, x = (first[2], second[2], axis[2]), (dot(first, v), dot(second, v), dot(axis, v)), _NONE
    weight = scale(body.gravity, up)
    if body.downhill > 0:
        weight = subtract(weight, scale(body.downhill, (first[0], second[0], axis[0])))
    W, W_before = (V[0], -V[1], -V[2]), _NONE
    weight_mirrored = (weight[0], -weight[1], -weight[2])
    series[0, 0], series[1, 0], series[2, 0], series[3, 0] = 0.0, 0.0, 0.0, position_of(y)[2]
    # However short the piece, its velocity is that of the first term.
    order, size = 1, 1.0
    for k in range(ORDER):
        part, slowed = _INVERSE[k], slowing * k
        x = scale(part, add(scale(slowed, x), V))
        series[0, k + 1], series[1, k + 1], series[2, k + 1] = x
        series[3, k + 1] = dot(up, x)
        size *= length
        # Times k + 1, for the velocity too.
        if norm(x) * size * (k + 1) > SMALLEST * body.radius:
            order = k + 1
        elif k > max(order, TURNED):
            break
        turned = _across(subtract(W, scale(slowing, W_before)))
        forces = add(scale(beta, V), weight_mirrored)
        W_next = scale(part, subtract(add(scale(slowed - alpha, W), scale(whirl, turned)), forces))
        V = scale(part, subtract(scale(slowed - alpha, V), add(scale(beta, W), weight)))
        W_before, W, weight, weight_mirrored = W, W_next, _NONE, scale(part * whirl, _across(weight_mirrored))
    return Piece(first, second, axis, slowing, length, order)


@compiled
def _across(a: Vector) -> Vector:
    """Return axis × a."""
    return -a[1], a[0], 0.0


@compiled
def fallen(piece: Piece, series: Array, s: float, y: Array, y_new: Array) -> None:
    """Write position and velocity of the state at the clock s of a piece into y_new.

    Args:
        piece: of the fall.
        series: its coefficients.
        s: clock [s].
        y: state at the start of the piece, (13,).
        y_new: state, (13,).
    """
    x, v = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for k in range(piece.order, -1, -1):
        v = add(scale(s, v), x)
        x = add(scale(s, x), (series[0, k], series[1, k], series[2, k]))
    v = scale(1 - piece.slowing * s, v)
    along_first, along_second = add(position_of(y), scale(x[0], piece.first)), scale(x[1], piece.second)
    set_position(y_new, add(add(along_first, along_second), scale(x[2], piece.axis)))
    along_first, along_second = scale(v[0], piece.first), scale(v[1], piece.second)
    set_velocity(y_new, add(add(along_first, along_second), scale(v[2], piece.axis)))
