"""The fall through linear air of an ideal coin that turns in closed form: Taylor series of its velocity.

With n the normal, v' = -c_t/m v - (c_n - c_t)/m (n . v) n - g ẑ. In the plane in which n turns, n = (cos φ,
sin φ) from the start of a piece on, n (n . v) is half of v and of its mirror image, by C = cos 2φ and
S = sin 2φ; along the axis of turning the velocity only dies away. φ'' = -(d_t/J_ξ) φ' and C' = -2 φ' S,
S' = 2 φ' C complete the system, whose coefficients follow one from the other.
"""

from typing import NamedTuple

from analytic.turning import angle_turned, normal_at
from models.compiled import compiled
from models.vectors import Vector, add, cross, dot, scale

ORDER = 28
# The motion's own rates times the length of a piece. A term of the series is at most PIECE^k/k! of the whole:
# the first one left out is below 1e-16 of it.
PIECE = 3.0
# The part of φ' in the series dies away so much more slowly that further terms are below rounding.
TERMS = 10

# Rows of a series: C and S; the velocity in the plane and along the axis; the height.
C, S, P, Q, A, Z = range(6)
ROWS = 6


class Frame(NamedTuple):
    """Where a piece starts, and the directions to which its series refers."""

    position: Vector
    """Of C, space frame [m]."""
    first: Vector
    """The normal at the start of the piece, space frame."""
    second: Vector
    """Towards which it turns."""
    axis: Vector


@compiled
def piece_length(body, turning, t):
    """Give how long a series that starts at the time t of the flight holds to rounding [s]."""
    rate = angle_turned(turning, t)[1]
    fastest = max(body.drag.force_tangential, body.drag.force_normal) / body.mass
    rates = 2 * rate + fastest + turning.slowing
    return PIECE / rates


@compiled
def expand(body, turning, t, x, v, series):
    """Expand the fall from the time t of the flight on.

    Args:
        body: the coin.
        turning: of the flight.
        t: time of the flight at which the piece starts [s].
        x: position of C there, space frame, (3,) [m].
        v: its velocity, (3,) [m/s].
        series: where the coefficients go, (ROWS, ORDER + 1).

    Returns:
        The `Frame` of the piece.
    """
    axis, first, rate = turning.axis, normal_at(turning, t)[0], angle_turned(turning, t)[1]
    second = cross(axis, first)
    mean = (body.drag.force_normal + body.drag.force_tangential) / (2 * body.mass)
    half = (body.drag.force_normal - body.drag.force_tangential) / (2 * body.mass)
    along = body.drag.force_tangential / body.mass
    g, slowing = body.gravity, turning.slowing
    series[C, 0], series[S, 0] = 1.0, 0.0
    series[P, 0], series[Q, 0], series[A, 0] = dot(first, v), dot(second, v), dot(axis, v)
    series[Z, 0] = x[2]
    for k in range(ORDER):
        c, s, p, q = 0.0, 0.0, 0.0, 0.0
        # The terms of 2 φ', one from the other.
        turned = 2 * rate
        for j in range(min(k + 1, TERMS)):
            c -= turned * series[S, k - j]
            s += turned * series[C, k - j]
            turned *= -slowing / (j + 1)
        for j in range(k + 1):
            p += series[C, j] * series[P, k - j] + series[S, j] * series[Q, k - j]
            q += series[S, j] * series[P, k - j] - series[C, j] * series[Q, k - j]
        p, q, a = -mean * series[P, k] - half * p, -mean * series[Q, k] - half * q, -along * series[A, k]
        if k == 0:
            p, q, a = p - g * first[2], q - g * second[2], a - g * axis[2]
        n = k + 1
        series[C, n], series[S, n] = c / n, s / n
        series[P, n], series[Q, n], series[A, n] = p / n, q / n, a / n
    for k in range(ORDER):
        v_z = first[2] * series[P, k] + second[2] * series[Q, k] + axis[2] * series[A, k]
        series[Z, k + 1] = v_z / (k + 1)
    return Frame(x, first, second, axis)


@compiled
def fallen(frame, series, t):
    """Give position [m] and velocity [m/s] of C at the time t of a piece, space frame, (3,) each."""
    p, P_ = _sum_and_integral(series[P], t)
    q, Q_ = _sum_and_integral(series[Q], t)
    a, A_ = _sum_and_integral(series[A], t)
    x = add(scale(P_, frame.first), add(scale(Q_, frame.second), scale(A_, frame.axis)))
    v = add(scale(p, frame.first), add(scale(q, frame.second), scale(a, frame.axis)))
    return add(frame.position, x), v


@compiled
def _sum_and_integral(coefficients, t):
    value, integral = 0.0, 0.0
    for k in range(len(coefficients) - 1, -1, -1):
        value = value * t + coefficients[k]
        integral = integral * t + coefficients[k] / (k + 1)
    return value, integral * t
