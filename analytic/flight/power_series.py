"""Flights in vacuum and in linear air as power series of time.

Seen from the coin, all rates of change are sums of products: the rows a of the rotation matrix obey
da/dt = a × ω, the velocity of C in the body frame dU/dt = U × ω + f/m - g u, u the upward unit vector, and
J ω̇ = m_C + (J ω) × ω, where the air's f and m_C are linear in U and ω; C moves by R U. So each coefficient of
their series follows from those before it; docs/FLIGHT.md derives them.
"""

import numpy as np

from analytic.air.force import force_and_moment
from analytic.flight.fall import fall_freely
from analytic.flight.state_vector import (
    attitude_of,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    state_of,
)
from analytic.numerics.rotation import attitude_near
from models.body import in_vacuum
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, apply_transposed, cross, dot, norm, scale, subtract

ORDER = 24
# The last two terms of a step are at most this part of the coin's scales.
_SMALLEST = 2e-17
# Columns of the series: the rows of R, of which the last is u, then U, J ω, ω and the position of C.
_ROWS, UP, _VELOCITY, _MOMENTUM, _SPIN, _POSITION, HEIGHT, COLUMNS = 0, 6, 9, 12, 15, 18, 20, 21


@compiled
def expand_flight(body, y, longest, series):
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
        _write(series, 0, _ROWS + 3 * i, state.R[i])
    _write(series, 0, _VELOCITY, U)
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
def _next_terms(body, k, series, speed, spin):
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
    a, b, u = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    turned, gyroscopic, moved = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for j in range(k + 1):
        w, U = _read(series, k - j, _SPIN), _read(series, k - j, _VELOCITY)
        a_j, b_j, u_j = (
            _read(series, j, _ROWS),
            _read(series, j, _ROWS + 3),
            _read(series, j, UP),
        )
        a, b, u = add(a, cross(a_j, w)), add(b, cross(b_j, w)), add(u, cross(u_j, w))
        turned = add(turned, cross(_read(series, j, _VELOCITY), w))
        gyroscopic = add(gyroscopic, cross(_read(series, j, _MOMENTUM), w))
        moved = add(moved, (dot(a_j, U), dot(b_j, U), dot(u_j, U)))
    f, m_C = force_and_moment(body, _read(series, k, _VELOCITY), _read(series, k, _SPIN))
    weight = scale(body.gravity, _read(series, k, UP))
    part = 1 / (k + 1)
    U = scale(part, add(turned, subtract(scale(1 / body.mass, f), weight)))
    w = scale(part, apply(body.inertia_inverse, add(m_C, gyroscopic)))
    a, b, u, moved = scale(part, a), scale(part, b), scale(part, u), scale(part, moved)
    _write(series, k + 1, _ROWS, a)
    _write(series, k + 1, _ROWS + 3, b)
    _write(series, k + 1, UP, u)
    _write(series, k + 1, _VELOCITY, U)
    _write(series, k + 1, _MOMENTUM, apply(body.inertia, w))
    _write(series, k + 1, _SPIN, w)
    _write(series, k + 1, _POSITION, moved)
    turning = max(norm(a), norm(b), norm(u), norm(w) / spin)
    return max(turning, norm(U) / speed, norm(moved) / body.radius)


@compiled
def state_in_flight(body, series, order, t, y, y_new):
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
    R = (_part(values, _ROWS), _part(values, _ROWS + 3), _part(values, UP))
    if in_vacuum(body):
        fall_freely(body, y, t, y_new)
    else:
        set_position(y_new, _part(values, _POSITION))
        set_velocity(y_new, apply(R, _part(values, _VELOCITY)))
    set_attitude(y_new, attitude_near(R, attitude_of(y)))
    set_spin(y_new, _part(values, _SPIN))


@compiled
def _fall_time(body, state):
    """Return the time in which C falls in vacuum to the floor, or by a radius if that is farther [s]."""
    depth, rise = max(state.position[2], body.radius), state.velocity[2]
    return (rise + (rise * rise + 2 * body.gravity * depth) ** 0.5) / body.gravity


@compiled
def _read(series, k, column):
    """Return the coefficients of order k of the vector that starts in this column."""
    return series[k, column], series[k, column + 1], series[k, column + 2]


@compiled
def _write(series, k, column, a):
    """Set what `_read` returns."""
    series[k, column], series[k, column + 1], series[k, column + 2] = a


@compiled
def _part(values, column):
    """Return the vector that starts in this column."""
    return values[column], values[column + 1], values[column + 2]
