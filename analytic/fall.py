"""The fall through linear air of an ideal coin that turns in closed form: a power series of its position.

With n the normal, v' = -c_t/m v - (c_n - c_t)/m (n . v) n - g ẑ. In the plane in which n turns, as complex
numbers, n = exp(iφ) and φ = rate s, s the clock of `turning`, dt = ds/(1 - δ s). There n (n . v) is
(V + W)/2, with W = exp(2iφ) V* the mirror image of V. Both obey linear equations,

    (1 - δ s) dV/ds = -α V - β W - G
    (1 - δ s) dW/ds = -α W - β V - G* exp(2iφ) + 2i rate (1 - δ s) W

with α, β = (c_n ± c_t)/2m and G = g (z_n + i z_⊥); along the axis the velocity only dies away. So the terms
of their series follow one from the other.
"""

import math
from typing import NamedTuple

import numpy as np

from models.compiled import compiled
from models.vectors import Vector, add, cross, dot, scale

ORDER = 40
# What the motion turns, and what the air takes, in a piece. The first term left out is at most
# TURNED^41/41! = 2e-17 of the whole.
TURNED, TAKEN = 6.0, 1.0
# Terms of the height below this part of the radius are left out.
SMALLEST = 1e-17

_INVERSE = 1 / np.arange(1, ORDER + 1)


class Piece(NamedTuple):
    """A piece of a fall; its series are those of the clock s [s]."""

    first: Vector
    """The normal at its start, space frame."""
    second: Vector
    """Towards which it turns."""
    axis: Vector
    slowing: float
    """δ [1/s]."""
    length: float
    """By the clock [s]."""
    order: int
    """Of the series of the height."""


@compiled
def slowing_of(body):
    """Give δ = d_t/J_ξ, at which linear air slows the turning [1/s]."""
    return body.drag.moment_tangential / body.inertia[0][0]


@compiled
def clock(slowing, t):
    """Give the clock s [s] at the time t [s]."""
    return -math.expm1(-slowing * t) / slowing if slowing > 0 else t


@compiled
def time_of(slowing, s):
    """Give the time t [s] at the clock s [s]."""
    return -math.log1p(-slowing * s) / slowing if slowing > 0 else s


@compiled
def longest_piece(body, rate):
    """Give by the clock how long a series holds to rounding [s]."""
    taken = 2 * max(body.drag.force_normal, body.drag.force_tangential) / body.mass + slowing_of(body)
    return min(TURNED / (2 * rate + taken), TAKEN / taken)


@compiled
def expand(body, turning, y, longest, series):
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
    axis, v, slowing = turning.axis, (y[3], y[4], y[5]), slowing_of(body)
    first = add(turning.mean, turning.cosine)
    second = cross(axis, first)
    length = min(longest_piece(body, turning.rate), longest)
    n, t = body.drag.force_normal / body.mass, body.drag.force_tangential / body.mass
    alpha, beta = (n + t) / 2, (n - t) / 2
    whirl = 2j * turning.rate
    V = complex(dot(first, v), dot(second, v))
    W, W_before, G = V.conjugate(), 0j, body.gravity * complex(first[2], second[2])
    E, A, g_axis = G.conjugate(), dot(axis, v), body.gravity * axis[2]
    x, x_axis = 0j, 0.0
    series[0, 0], series[1, 0], series[2, 0], series[3, 0] = 0.0, 0.0, 0.0, y[2]
    order, size = 0, 1.0
    for k in range(ORDER):
        part, slowed = _INVERSE[k], slowing * k
        x, x_axis = part * (slowed * x + V), part * (slowed * x_axis + A)
        z = first[2] * x.real + second[2] * x.imag + axis[2] * x_axis
        series[0, k + 1], series[1, k + 1], series[2, k + 1] = x.real, x.imag, x_axis
        series[3, k + 1] = z
        size *= length
        if abs(z) * size > SMALLEST * body.radius:
            order = k + 1
        W_next = part * ((slowed - alpha) * W + whirl * (W - slowing * W_before) - beta * V - E)
        V, A = part * ((slowed - alpha) * V - beta * W - G), part * ((slowed - t) * A - g_axis)
        W_before, W, E = W, W_next, part * whirl * E
        G, g_axis = 0j, 0.0
    return Piece(first, second, axis, slowing, length, order)


@compiled
def fallen(piece, series, s, y, y_new):
    """Write position and velocity of the state at the clock s of a piece into y_new.

    Args:
        piece: of the fall.
        series: its coefficients.
        s: clock [s].
        y: state at the start of the piece, (13,).
        y_new: state, (13,).
    """
    x, v = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for k in range(ORDER, -1, -1):
        v = add(scale(s, v), x)
        x = add(scale(s, x), (series[0, k], series[1, k], series[2, k]))
    v = scale(1 - piece.slowing * s, v)
    for i in range(3):
        y_new[i] = y[i] + piece.first[i] * x[0] + piece.second[i] * x[1] + piece.axis[i] * x[2]
        y_new[3 + i] = piece.first[i] * v[0] + piece.second[i] * v[1] + piece.axis[i] * v[2]
