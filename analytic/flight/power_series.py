"""Flights in vacuum and in linear air as power series of time.

Seen from the coin, all rates of change are sums of products: the rows a of the rotation matrix obey
da/dt = a × ω, the velocity of C in the body frame dU/dt = U × ω + f/m - g u, u the upward unit vector, and
J ω̇ = m_C + (J ω) × ω, where the air's f and m_C are linear in U and ω; C moves by R U. So each coefficient of
their series follows from those before it; docs/FLIGHT.md derives them.
"""

import numpy as np

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.flight.fall import fall_freely
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    state_of,
)
from cointoss.analytic.numerics.rotation import Four, attitude_near
from cointoss.models.body import Body, in_vacuum
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, cross, norm, scale, subtract
from cointoss.models.state import State

ORDER = 24
# The last two terms of a step are at most this part of the coin's scales.
_SMALLEST = 2e-17
# The columns of the series that hold each vector. The rows of R, of which the last is u, and U, which ω turns
# alike, lie side by side, component by component: `_FOURS` are where the components start.
_FOURS, _ROWS = (0, 4, 8), ((0, 4, 8), (1, 5, 9), (2, 6, 10))
UP, _VELOCITY, _MOMENTUM, _SPIN, _POSITION = _ROWS[2], (3, 7, 11), (12, 13, 14), (15, 16, 17), (18, 19, 20)
# The position of C is one of four columns too, of which the last is work space.
HEIGHT, COLUMNS = _POSITION[2], 22
_NONE: Four = (0.0, 0.0, 0.0, 0.0)


@compiled
def expand_flight(body: Body, y: Array, longest: float, series: Array) -> tuple[float, int]:
    """Expand a flight in vacuum or in linear air from the state y, (13,), on.

    Args:
        body: the coin.
        y: state, (13,).
        longest: the longest time wanted [s].
        series: where the coefficients go, (ORDER + 1, COLUMNS).

    Returns:
        For how long the series holds [s], and its order. The time is at most that of a fall in vacuum to
        the floor, or by a radius if that is farther.
    """
    state = state_of(y)
    U = apply_transposed(state.R, state.velocity)
    for i in range(3):
        four = (state.R[0][i], state.R[1][i], state.R[2][i], U[i])
        _write_four(series, 0, _FOURS[i], 1.0, four)
    _write(series, 0, _MOMENTUM, apply(body.inertia, state.spin))
    _write(series, 0, _SPIN, state.spin)
    _write(series, 0, _POSITION, state.position)
    length = min(longest, _fall_time(body, state))
    speed = (body.gravity * body.radius) ** 0.5 + norm(state.velocity)
    spin = (body.gravity / body.radius) ** 0.5 + norm(state.spin)
    size, before, power, small = 0.0, 0.0, 1.0, 0
    for k in range(ORDER):
        before, size = size, _next_terms(body, k, series, speed, spin)
        power *= length
        if size * power < _SMALLEST:
            small += 1
            if small == 2:
                return length, k + 1
        else:
            small = 0
    if size > 0:
        length = min(length, (_SMALLEST / size) ** (1 / ORDER))
    if before > 0:
        length = min(length, (_SMALLEST / before) ** (1 / (ORDER - 1)))
    return length, ORDER


@compiled
def _next_terms(body: Body, k: int, series: Array, speed: float, spin: float) -> float:
    """Write the coefficients of order k + 1.

    Args:
        body: the coin.
        k: order up to which the coefficients are known.
        series: the coefficients, (ORDER + 1, COLUMNS).
        speed: scale of velocities [m/s].
        spin: scale of angular velocities [rad/s].

    Returns:
        The largest of the new coefficients, against the coin's scales [1/s^(k + 1)].
    """
    x, y, z, moved, gyroscopic = _NONE, _NONE, _NONE, _NONE, (0.0, 0.0, 0.0)
    for j in range(k + 1):
        w, U = _read(series, k - j, _SPIN), _read(series, k - j, _VELOCITY)
        x_j, y_j, z_j = (
            _read_four(series, j, _FOURS[0]),
            _read_four(series, j, _FOURS[1]),
            _read_four(series, j, _FOURS[2]),
        )
        # Each of the four vectors × ω, and · U.
        x = _add_product(_add_product(x, y_j, w[2]), z_j, -w[1])
        y = _add_product(_add_product(y, z_j, w[0]), x_j, -w[2])
        z = _add_product(_add_product(z, x_j, w[1]), y_j, -w[0])
        moved = _add_product(_add_product(_add_product(moved, x_j, U[0]), y_j, U[1]), z_j, U[2])
        gyroscopic = add(gyroscopic, cross(_read(series, j, _MOMENTUM), w))
    f, m_C = force_and_moment(body, _read(series, k, _VELOCITY), _read(series, k, _SPIN))
    a = subtract(scale(1 / body.mass, f), scale(body.gravity, _read(series, k, UP)))
    part = 1 / (k + 1)
    _write_four(series, k + 1, _FOURS[0], part, _add_to_fourth(x, a[0]))
    _write_four(series, k + 1, _FOURS[1], part, _add_to_fourth(y, a[1]))
    _write_four(series, k + 1, _FOURS[2], part, _add_to_fourth(z, a[2]))
    _write_four(series, k + 1, _POSITION[0], part, moved)
    w = scale(part, apply(body.inertia_inverse, add(m_C, gyroscopic)))
    _write(series, k + 1, _MOMENTUM, apply(body.inertia, w))
    _write(series, k + 1, _SPIN, w)
    turning = norm(w) / spin
    for row in _ROWS:
        turning = max(turning, norm(_read(series, k + 1, row)))
    U, moved_by = _read(series, k + 1, _VELOCITY), _read(series, k + 1, _POSITION)
    return max(turning, norm(U) / speed, norm(moved_by) / body.radius)


@compiled
def state_in_flight(body: Body, series: Array, order: int, t: float, y: Array, y_new: Array) -> None:
    """Write the state at the time t [s] of an expanded flight that starts with the state y into y_new.

    Args:
        body: the coin.
        series: see `expand_flight`.
        order: of the series.
        t: time since its start [s].
        y: state at its start, (13,).
        y_new: state, (13,).
    """
    values = np.zeros(COLUMNS)
    for k in range(order, -1, -1):
        for i in range(COLUMNS):
            values[i] = values[i] * t + series[k, i]
    R = (_part(values, _ROWS[0]), _part(values, _ROWS[1]), _part(values, UP))
    if in_vacuum(body):
        fall_freely(body, y, t, y_new)
    else:
        set_position(y_new, _part(values, _POSITION))
        set_velocity(y_new, apply(R, _part(values, _VELOCITY)))
    set_attitude(y_new, attitude_near(R, attitude_of(y)))
    set_spin(y_new, _part(values, _SPIN))


@compiled
def _fall_time(body: Body, state: State) -> float:
    """Return the time in which C falls in vacuum to the floor, or by a radius if that is farther [s]."""
    depth, rise = max(state.position[2], body.radius), state.velocity[2]
    return (rise + (rise * rise + 2 * body.gravity * depth) ** 0.5) / body.gravity


@compiled
def _read(series: Array, k: int, columns: tuple[int, int, int]) -> Vector:
    """Return the coefficients of order k of the vector in these columns."""
    return series[k, columns[0]], series[k, columns[1]], series[k, columns[2]]


@compiled
def _write(series: Array, k: int, columns: tuple[int, int, int], a: Vector) -> None:
    """Set what `_read` returns."""
    series[k, columns[0]], series[k, columns[1]], series[k, columns[2]] = a


@compiled
def _read_four(series: Array, k: int, column: int) -> Four:
    """Return the coefficients of order k in four columns from this one on."""
    return series[k, column], series[k, column + 1], series[k, column + 2], series[k, column + 3]


@compiled
def _write_four(series: Array, k: int, column: int, factor: float, a: Four) -> None:
    """Set what `_read_four` returns, to a product."""
    series[k, column], series[k, column + 1] = factor * a[0], factor * a[1]
    series[k, column + 2], series[k, column + 3] = factor * a[2], factor * a[3]


@compiled
def _add_product(total: Four, a: Four, factor: float) -> Four:
    """Return a sum, (4,), with the product of four numbers and a factor added."""
    return (
        total[0] + a[0] * factor,
        total[1] + a[1] * factor,
        total[2] + a[2] * factor,
        total[3] + a[3] * factor,
    )


@compiled
def _add_to_fourth(a: Four, b: float) -> Four:
    """Return four numbers with b added to the last."""
    return a[0], a[1], a[2], a[3] + b


@compiled
def _part(values: Array, columns: tuple[int, int, int]) -> Vector:
    """Return the vector in these columns."""
    return values[columns[0]], values[columns[1]], values[columns[2]]
