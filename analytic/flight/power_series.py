"""Flights in vacuum and in linear air as power series of time.

Seen from the coin, all rates of change are sums of products: the rows a of the rotation matrix obey
da/dt = a × ω, the velocity of C in the body frame dU/dt = U × ω + f/m - g u, u the upward unit vector, and
dL/dt = m_C + L × ω, L = J ω, where the air's f and m_C are linear in U and ω. In space m dv/dt = R f - m g ẑ,
where R f is -c_t times the velocity of B and -(c_n - c_t) times its part along the normal. So each
coefficient of their series follows from those before it; docs/FLIGHT.md derives them.

A balanced coin that is a symmetric top is seen from the frame in which its normal stands still: that turns at
Ω = L/J_ξ, of which the air leaves exp(-d_t t/J_ξ) across the normal and exp(-d_n t/J_ζ) along it. Ω takes the
place of ω, and few terms of its series matter. Under the normal the coin turns in closed form.
"""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.flight.fall import clock, slowing_of
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    motion_scales,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
)
from cointoss.analytic.flight.turning import turn_under
from cointoss.analytic.numerics.rotation import attitude_near
from cointoss.models.body import Body, is_ideal
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.lanes import Lanes, four, read_four, write_four
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, norm, scale, subtract
from cointoss.models.state import State

ORDER = 24
# The last two terms of a step are at most this part of the coin's scales. The next one, less than a tenth of
# them, is then below the rounding of the sum.
_SMALLEST = 2e-16
# A step for which 24 orders hold turns the frame of a top by less [rad].
_MOST_TURNED = 2.5
ROWS = ORDER + 1
"""Rows of a series: one for each order."""
# Where vectors of four numbers start in the columns of a series. The first of `_TURNED` has the ξ components
# of the rows of R, of which the last is u, and of U, which ω turns alike; the next have those along η and ζ.
_TURNED, UP = (0, 4, 8), (2, 6, 10)
# ω, or Ω of a top, and the speed of B along ζ; position and velocity of C in space, whose fourth number is of
# no use.
_SPIN, _POSITION, _VELOCITY = 12, 16, 20
HEIGHT = _POSITION + 2
# L and ω, their components in the orders η ζ ξ and ζ ξ η.
_MOMENTUM, _CROSSED, COLUMNS = (24, 28), (32, 36), 40
_INVERSE = 1 / np.arange(1, ORDER + 1)


class _Scales(NamedTuple):
    """One over the squares of the coin's scales."""

    speed: float
    length: float
    spin: float


class _Frame(NamedTuple):
    """How the frame of a series turns: with the coin, or at L/J_ξ of a balanced top."""

    is_of_top: bool
    order: int
    """Terms of its angular velocity of higher order are below rounding."""
    across: float
    """The rate at which the air takes its angular velocity across the normal, of a top [1/s]."""
    along: float
    """The rate at which it takes that along the normal [1/s]."""


class _Sums(NamedTuple):
    """Sums of products up to some term; what they lose is summed apart, lest one sum waits for the other."""

    x: Lanes
    """ξ components of what ω turns, × ω."""
    x_less: Lanes
    y: Lanes
    y_less: Lanes
    z: Lanes
    z_less: Lanes
    along: Lanes
    """The speed of B along the normal, times the normal in space."""


@compiled
def expand_flight(body: Body, y: Array, longest: float, series: Array) -> tuple[float, int]:
    """Expand a flight in vacuum or in linear air from the state y, (13,), on.

    Args:
        body: the coin.
        y: state, (13,).
        longest: the longest time wanted [s].
        series: where the coefficients go, (ROWS, COLUMNS).

    Returns:
        For how long the series holds [s], and its order. The time is at most that of a fall in vacuum to
        the floor, or by a radius if that is farther.
    """
    state = state_of(y)
    U, momentum, w = apply_transposed(state.R, state.velocity), apply(body.inertia, state.spin), state.spin
    length = min(longest, _fall_time(body, state))
    if is_ideal(body):
        w = scale(1 / body.inertia[0][0], momentum)
        length *= _MOST_TURNED / max(norm(w) * length, _MOST_TURNED)
    frame = _frame(body, length)
    x, v = state.position, state.velocity
    for i in range(3):
        write_four(series, 0, _TURNED[i], four(state.R[0][i], state.R[1][i], state.R[2][i], U[i]))
    _write_spin(body, series, 0, w, U[2])
    _write_momentum(series, 0, w, momentum)
    write_four(series, 0, _POSITION, four(x[0], x[1], x[2], 0.0))
    write_four(series, 0, _VELOCITY, four(v[0], v[1], v[2], 0.0))
    speed, spin = motion_scales(body, y)
    scales = _Scales(1 / (speed * speed), 1 / (body.radius * body.radius), 1 / (spin * spin))
    # All are squares.
    least, square, before, power = _SMALLEST * _SMALLEST, 0.0, 0.0, 1.0
    order, small = 0, 0
    while order < ORDER and small < 2:
        before, square = square, _next_terms(body, order, series, scales, frame)
        order += 1
        power *= length * length
        small = small + 1 if square * power < least else 0
    if small < 2:
        if square > 0:
            length = min(length, (least / square) ** (1 / (2 * ORDER)))
        if before > 0:
            length = min(length, (least / before) ** (1 / (2 * ORDER - 2)))
    return length, order


@compiled
def _frame(body: Body, length: float) -> _Frame:
    """Return the `_Frame` of a series that holds for at most this time [s]."""
    if not is_ideal(body):
        return _Frame(False, ORDER, 0.0, 0.0)
    across, along = slowing_of(body), body.drag.moment_normal / body.inertia[2][2]
    order, term = 0, 1.0
    while order < ORDER and term > _SMALLEST:
        order += 1
        term *= max(across, along) * length / order
    return _Frame(True, order, across, along)


@compiled
def _next_terms(body: Body, k: int, series: Array, scales: _Scales, frame: _Frame) -> float:
    """Write the coefficients of order k + 1.

    Args:
        body: the coin.
        k: order up to which the coefficients are known.
        series: the coefficients, (ROWS, COLUMNS).
        scales: of the coin.
        frame: of the series.

    Returns:
        The square of the largest of the new coefficients, against the coin's scales [1/s^(2 k + 2)].
    """
    part, w = _INVERSE[k], read_four(series, k, _SPIN)
    x, y, z = (
        read_four(series, k, _TURNED[0]),
        read_four(series, k, _TURNED[1]),
        read_four(series, k, _TURNED[2]),
    )
    f, m_C = force_and_moment(body, (x[3], y[3], z[3]), _three(w))
    a = subtract(scale(1 / body.mass, f), scale(body.gravity, (x[2], y[2], z[2])))
    if body.downhill > 0:
        a = add(a, scale(body.downhill, (x[0], y[0], z[0])))
    position = part * read_four(series, k, _VELOCITY)
    write_four(series, k + 1, _POSITION, position)
    first, none = max(1, k - frame.order), four(0.0, 0.0, 0.0, 0.0)
    along = none
    for j in range(1, first):
        along += read_four(series, j, _TURNED[2]) * series[k - j, _SPIN + 3]
    sums = _Sums(none, none, none, none, none, none, along)
    for j in range(first, k):
        sums = _with_term(sums, series, j, k - j)
    # The terms of the newest coefficients come last: the sums of the others need not wait for them.
    sums = _with_term(sums, series, 0, k)
    if k > 0:
        sums = _with_term(sums, series, k, 0)
    x = part * (sums.x - sums.x_less + four(0.0, 0.0, 0.0, a[0]))
    y = part * (sums.y - sums.y_less + four(0.0, 0.0, 0.0, a[1]))
    z = part * (sums.z - sums.z_less + four(0.0, 0.0, 0.0, a[2]))
    write_four(series, k + 1, _TURNED[0], x)
    write_four(series, k + 1, _TURNED[1], y)
    write_four(series, k + 1, _TURNED[2], z)
    if frame.is_of_top:
        spin = scale(-part, (frame.across * w[0], frame.across * w[1], frame.along * w[2]))
    else:
        momentum = scale(part, add(m_C, _three(_gyroscopic(series, k))))
        spin = apply(body.inertia_inverse, momentum)
        _write_momentum(series, k + 1, spin, momentum)
    _write_spin(body, series, k + 1, spin, z[3])
    _write_velocity(body, series, k + 1, sums.along)
    turned = x * x + y * y + z * z
    largest = max(max(turned[0], turned[1]), max(turned[2], turned[3] * scales.speed))
    moved = _square(_three(position)) * scales.length
    return max(largest, max(moved, _square(spin) * scales.spin))


@compiled
def _write_velocity(body: Body, series: Array, k: int, along_normal: Lanes) -> None:
    """Write the coefficient of order k, not 0, of the velocity in space.

    That of B in space is the rate of x_C - R c.
    """
    c, c_t, c_n = body.center, body.drag.force_tangential, body.drag.force_normal
    x, y, z = (
        read_four(series, k, _TURNED[0]),
        read_four(series, k, _TURNED[1]),
        read_four(series, k, _TURNED[2]),
    )
    arm = c[0] * x + y * c[1] + z * c[2]
    slowed = c_t / body.mass * (read_four(series, k, _POSITION) - arm)
    slowed += along_normal * (_INVERSE[k - 1] * (c_n - c_t) / body.mass)
    along, down = (body.downhill, body.gravity) if k == 1 else (0.0, 0.0)
    write_four(series, k, _VELOCITY, four(along, -0.0, -down, -0.0) - slowed)


@compiled
def _with_term(sums: _Sums, series: Array, j: int, i: int) -> _Sums:
    """Return the `_Sums` with the products of coefficients of order j with those of order i of ω added."""
    w_xi, w_eta, w_zeta = series[i, _SPIN], series[i, _SPIN + 1], series[i, _SPIN + 2]
    x, y, z = (
        read_four(series, j, _TURNED[0]),
        read_four(series, j, _TURNED[1]),
        read_four(series, j, _TURNED[2]),
    )
    return _Sums(
        sums.x + y * w_zeta,
        sums.x_less + z * w_eta,
        sums.y + z * w_xi,
        sums.y_less + x * w_zeta,
        sums.z + x * w_eta,
        sums.z_less + y * w_xi,
        sums.along + z * series[i, _SPIN + 3],
    )


@compiled
def _gyroscopic(series: Array, k: int) -> Lanes:
    """Return the coefficients of order k of L × ω."""
    more, less = four(0.0, 0.0, 0.0, 0.0), four(0.0, 0.0, 0.0, 0.0)
    for j in range(1, k):
        more, less = _with_gyroscopic(more, less, series, j, k - j)
    more, less = _with_gyroscopic(more, less, series, 0, k)
    if k > 0:
        more, less = _with_gyroscopic(more, less, series, k, 0)
    return more - less


@compiled
def _with_gyroscopic(more: Lanes, less: Lanes, series: Array, j: int, i: int) -> tuple[Lanes, Lanes]:
    """Return both sums of L × ω with the products of the orders j of L and i of ω added."""
    return (
        more + read_four(series, j, _MOMENTUM[0]) * read_four(series, i, _CROSSED[1]),
        less + read_four(series, j, _MOMENTUM[1]) * read_four(series, i, _CROSSED[0]),
    )


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
    none = four(0.0, 0.0, 0.0, 0.0)
    xi, eta, zeta, spin, position, velocity = none, none, none, none, none, none
    for k in range(order, -1, -1):
        xi = read_four(series, k, _TURNED[0]) + xi * t
        eta = read_four(series, k, _TURNED[1]) + eta * t
        zeta = read_four(series, k, _TURNED[2]) + zeta * t
        spin = read_four(series, k, _SPIN) + spin * t
        position = read_four(series, k, _POSITION) + position * t
        velocity = read_four(series, k, _VELOCITY) + velocity * t
    R = ((xi[0], eta[0], zeta[0]), (xi[1], eta[1], zeta[1]), (xi[2], eta[2], zeta[2]))
    set_position(y_new, _three(position))
    set_velocity(y_new, _three(velocity))
    set_attitude(y_new, attitude_near(R, attitude_of(y)))
    set_spin(y_new, _three(spin))
    if is_ideal(body):
        J_perp, J = body.inertia[0][0], body.inertia[2][2]
        set_spin(y_new, (spin[0], spin[1], spin[2] * (J_perp / J)))
        turn_under(y_new, (1 - J / J_perp) * spin_of(y)[2] * clock(body.drag.moment_normal / J, t))


@compiled
def _fall_time(body: Body, state: State) -> float:
    """Return the time in which C falls in vacuum to the floor, or by a radius if that is farther [s]."""
    depth, rise = max(state.position[2], body.radius), state.velocity[2]
    return (rise + (rise * rise + 2 * body.gravity * depth) ** 0.5) / body.gravity


@compiled
def _write_spin(body: Body, series: Array, k: int, w: Vector, U_zeta: float) -> None:
    """Write the coefficients of order k of ω and of the speed of B along ζ."""
    c = body.center
    write_four(series, k, _SPIN, four(w[0], w[1], w[2], U_zeta - (w[0] * c[1] - w[1] * c[0])))


@compiled
def _write_momentum(series: Array, k: int, w: Vector, h: Vector) -> None:
    """Write the coefficients of order k of ω and of L, by which they are multiplied."""
    write_four(series, k, _MOMENTUM[0], four(h[1], h[2], h[0], 0.0))
    write_four(series, k, _MOMENTUM[1], four(h[2], h[0], h[1], 0.0))
    write_four(series, k, _CROSSED[0], four(w[1], w[2], w[0], 0.0))
    write_four(series, k, _CROSSED[1], four(w[2], w[0], w[1], 0.0))


@compiled
def _three(a: Lanes) -> Vector:
    """Return the first three of four numbers."""
    return a[0], a[1], a[2]


@compiled
def _square(a: Vector) -> float:
    """Return a²."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]
