"""The tangent map of a flight: how a small change of its start grows.

Seen from the coin, a change of the place of C, of its velocity U, of the attitude, a small turn θ, and of the
spin ω obeys

    dx/dt = x × ω + dU + θ × U
    dU/dt = dU × ω + U × dω + df/m + g θ × u
    dθ/dt = θ × ω + dω
    J dω/dt = dm_C + (J dω) × ω + (J ω) × dω

with u the unit vector against gravity, upward on a level floor. Motion and changes are carried by one
Runge-Kutta method of order 4: a growth needs far fewer digits than the flight.
"""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.air.force import force_and_moment, write_jacobian
from cointoss.analytic.numerics.rotation import quaternion_rate, turn_of
from cointoss.models.body import Body, whole_gravity
from cointoss.models.kernel.arrays import Array, copy_into, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import (
    Matrix,
    Vector,
    add,
    apply,
    apply_transposed,
    cross,
    multiply,
    norm,
    scale,
    subtract,
)
from cointoss.models.state import State

COARSE, FINE = 0.2, 1e-8
"""Accuracy of a growth against its own size: for the horizon of trust, and where it is measured."""
LONGEST_STEP = 0.8
"""The longest step, as the angle that the coin turns and the part of its motion that the air takes [rad]."""
# Slower is no change at all [1/s].
_STILL = 1e-150


class Motion(NamedTuple):
    """A coin in flight, seen from itself."""

    up: Vector
    """The unit vector u against gravity."""
    velocity: Vector
    """U, of C [m/s]."""
    spin: Vector
    """ω [rad/s]."""


class Change(NamedTuple):
    """A small change of the coin's state, seen from the coin."""

    place: Vector
    """The change of the place of C [m]."""
    velocity: Vector
    """The change of U [m/s]."""
    turn: Vector
    """The change of the attitude, θ [rad]."""
    spin: Vector
    """The change of ω [rad/s]."""


class RateDerivatives(NamedTuple):
    """The derivatives of the rates of U and ω, body frame: of what the air does to them, or of all."""

    velocity_by_velocity: Matrix
    velocity_by_spin: Matrix
    spin_by_velocity: Matrix
    spin_by_spin: Matrix


class Linear(NamedTuple):
    """What the rate of change of a `Change` depends on at a motion."""

    motion: Motion
    by: RateDerivatives
    weight: Vector
    """g u [m/s²]."""


@compiled
def flight_tangent(
    body: Body, start: State, end: State, duration: float, accuracy: float, changes: Array
) -> None:
    """Carry small changes of the state through a flight.

    Args:
        body: the coin.
        start: state at the start.
        end: state at the end.
        duration: of the flight [s].
        accuracy: of the growth, relative: `COARSE`, or `FINE`.
        changes: one change of the state in each row, (n, 13); become those at the end of the flight. The
            Euler parameters are kept at norm 1.
    """
    seen = np.empty((len(changes), 12))
    for i in range(len(changes)):
        _write_seen(start, changes[i], seen[i])
    motion = _motion_at(body, start)
    air, left = _air_at(body, motion), duration
    longest = longest_step(duration * fastest(body, motion, air), accuracy)
    while left > 0:
        dt = min(left, longest / max(fastest(body, motion, air), _STILL))
        motion = _step(body, motion, air, dt, seen)
        left -= dt
        if body.air.exponent is not None:
            air = _air_at(body, motion)
    for i in range(len(changes)):
        _write_change(end, seen[i], changes[i])


@compiled
def steps_of_tangent(body: Body, start: State, duration: float, accuracy: float) -> float:
    """Return about how many steps `flight_tangent` takes; the arguments are its own."""
    motion = _motion_at(body, start)
    turned = duration * fastest(body, motion, _air_at(body, motion))
    return turned / longest_step(turned, accuracy)


@compiled
def _motion_at(body: Body, state: State) -> Motion:
    """Return the `Motion` in a state."""
    return Motion(_against_gravity(body, state), apply_transposed(state.R, state.velocity), state.spin)


@compiled
def _against_gravity(body: Body, state: State) -> Vector:
    """Return the unit vector against gravity in a state, body frame, (3,)."""
    up = state.R[2]
    if body.downhill == 0:
        return up
    against = subtract(scale(body.gravity, up), scale(body.downhill, state.R[0]))
    return scale(1 / whole_gravity(body), against)


@compiled
def _step(body: Body, motion: Motion, air: RateDerivatives, dt: float, seen: Array) -> Motion:
    """Carry a motion and its changes, one in each row, (n, 12), through a step of Runge-Kutta's method.

    Args:
        body: the coin.
        motion: at the start.
        air: there.
        dt: length of the step [s].
        seen: the changes; become those at the end.

    Returns:
        The motion at the end.
    """
    rate = motion_rate(body, motion)
    second = _moved(motion, dt / 2, rate)
    rate_2 = motion_rate(body, second)
    third = _moved(motion, dt / 2, rate_2)
    rate_3 = motion_rate(body, third)
    last = _moved(motion, dt, rate_3)
    rate_4 = motion_rate(body, last)
    at_1 = _linear(body, motion, air)
    at_2, at_3 = _linear_at(body, second, air), _linear_at(body, third, air)
    at_4 = _linear_at(body, last, air)
    for i in range(len(seen)):
        change = _read(seen[i])
        k_1 = change_rate(at_1, change)
        k_2 = change_rate(at_2, _changed(change, dt / 2, k_1))
        k_3 = change_rate(at_3, _changed(change, dt / 2, k_2))
        k_4 = change_rate(at_4, _changed(change, dt, k_3))
        change = _changed(_changed(change, dt / 6, k_1), dt / 3, k_2)
        _write(_changed(_changed(change, dt / 3, k_3), dt / 6, k_4), seen[i])
    motion = _moved(_moved(motion, dt / 6, rate), dt / 3, rate_2)
    return _moved(_moved(motion, dt / 3, rate_3), dt / 6, rate_4)


@compiled
def motion_rate(body: Body, motion: Motion) -> Motion:
    """Return the rate of change of a motion, each part by its own."""
    u, U, w = motion
    f, m_C = force_and_moment(body, U, w)
    speeding = subtract(scale(1 / body.mass, f), scale(whole_gravity(body), u))
    spinning = subtract(m_C, cross(w, apply(body.inertia, w)))
    return Motion(cross(u, w), add(cross(U, w), speeding), apply(body.inertia_inverse, spinning))


@compiled
def change_rate(at: Linear, change: Change) -> Change:
    """Return the rate of change of a `Change`, each part by its own."""
    (x, dU, turn, dw), by = change, at.by
    _, U, w = at.motion
    speeding = add(apply(by.velocity_by_velocity, dU), apply(by.velocity_by_spin, dw))
    return Change(
        add(cross(x, w), add(dU, cross(turn, U))),
        add(speeding, cross(turn, at.weight)),
        add(cross(turn, w), dw),
        add(apply(by.spin_by_velocity, dU), apply(by.spin_by_spin, dw)),
    )


@compiled
def _linear_at(body: Body, motion: Motion, air: RateDerivatives) -> Linear:
    """Return the equations at a motion; in linear air the derivatives `air` are the same at every one."""
    return _linear(body, motion, air if body.air.exponent is None else _air_at(body, motion))


@compiled
def _linear(body: Body, motion: Motion, air: RateDerivatives) -> Linear:
    """Return the equations at a motion, with the air there."""
    u, U, w = motion
    J = body.inertia
    gyroscopic = _minus(multiply(_crossing(w), J), _crossing(apply(J, w)))
    by = RateDerivatives(
        _minus(air.velocity_by_velocity, _crossing(w)),
        _minus(air.velocity_by_spin, _crossing(scale(-1.0, U))),
        air.spin_by_velocity,
        _minus(air.spin_by_spin, multiply(body.inertia_inverse, gyroscopic)),
    )
    return Linear(motion, by, scale(whole_gravity(body), u))


@compiled
def _crossing(a: Vector) -> Matrix:
    """Return the matrix of a × ."""
    return (0.0, -a[2], a[1]), (a[2], 0.0, -a[0]), (-a[1], a[0], 0.0)


@compiled
def _minus(A: Matrix, B: Matrix) -> Matrix:
    return subtract(A[0], B[0]), subtract(A[1], B[1]), subtract(A[2], B[2])


@compiled
def _air_at(body: Body, motion: Motion) -> RateDerivatives:
    """Return the derivatives of what the air does at a motion."""
    jacobian = np.empty((6, 6))
    write_jacobian(body, motion.velocity, motion.spin, jacobian)
    part, J_inverse = 1 / body.mass, body.inertia_inverse
    by_v, by_w = _block(jacobian, 0, 0), _block(jacobian, 0, 3)
    return RateDerivatives(
        (scale(part, by_v[0]), scale(part, by_v[1]), scale(part, by_v[2])),
        (scale(part, by_w[0]), scale(part, by_w[1]), scale(part, by_w[2])),
        multiply(J_inverse, _block(jacobian, 3, 0)),
        multiply(J_inverse, _block(jacobian, 3, 3)),
    )


@compiled
def _block(table: Array, row: int, column: int) -> Matrix:
    """Return three by three numbers of a table, from this row and column on."""
    return three(table[row], column), three(table[row + 1], column), three(table[row + 2], column)


@compiled
def longest_step(turned: float, accuracy: float) -> float:
    """Return the longest step of a flight [rad].

    A step h errs by some h⁵/120 of a turn, which goes on turning the coin for the rest of the flight: in all
    about Θ² h⁴/100, and on coins of all kinds no more than three times as much.

    Args:
        turned: Θ [rad].
        accuracy: of the growth, relative.
    """
    return min((100 * accuracy) ** 0.25 / max(turned, 1.0) ** 0.5, LONGEST_STEP)


@compiled
def fastest(body: Body, motion: Motion, air: RateDerivatives) -> float:
    """Return the fastest rate of a motion: turning |ω| or wobbling |J ω|/J_ξ, and the air's [1/s]."""
    J_inverse, w = body.inertia_inverse, motion.spin
    easiest = max(J_inverse[0][0], J_inverse[1][1], J_inverse[2][2])
    by_v, by_w = air.velocity_by_velocity, air.spin_by_spin
    slowing = norm((norm(by_v[0]), norm(by_v[1]), norm(by_v[2])))
    braking = norm((norm(by_w[0]), norm(by_w[1]), norm(by_w[2])))
    return max(norm(w), easiest * norm(apply(body.inertia, w))) + slowing + braking


@compiled
def _moved(motion: Motion, dt: float, rate: Motion) -> Motion:
    """Return a motion after a time at a rate."""
    return Motion(
        add(motion.up, scale(dt, rate.up)),
        add(motion.velocity, scale(dt, rate.velocity)),
        add(motion.spin, scale(dt, rate.spin)),
    )


@compiled
def _changed(change: Change, dt: float, rate: Change) -> Change:
    """Return a change after a time at a rate."""
    return Change(
        add(change.place, scale(dt, rate.place)),
        add(change.velocity, scale(dt, rate.velocity)),
        add(change.turn, scale(dt, rate.turn)),
        add(change.spin, scale(dt, rate.spin)),
    )


@compiled
def _write_seen(state: State, row: Array, seen: Array) -> None:
    """Write a change of a state, (13,), as the coin sees it, (12,)."""
    R = state.R
    U, turn = apply_transposed(R, state.velocity), turn_of(state.attitude, (row[6], row[7], row[8], row[9]))
    dU = add(apply_transposed(R, (row[3], row[4], row[5])), cross(U, turn))
    place = apply_transposed(R, (row[0], row[1], row[2]))
    _write(Change(place, dU, turn, (row[10], row[11], row[12])), seen)


@compiled
def _write_change(state: State, seen: Array, row: Array) -> None:
    """Write a change as the coin sees it, (12,), as one of its state, (13,)."""
    R, change = state.R, _read(seen)
    U = apply_transposed(R, state.velocity)
    x, v = apply(R, change.place), apply(R, add(change.velocity, cross(change.turn, U)))
    copy_into(row, (*x, *v, *quaternion_rate(state.attitude, change.turn), *change.spin))


@compiled
def _read(seen: Array) -> Change:
    return Change(three(seen, 0), three(seen, 3), three(seen, 6), three(seen, 9))


@compiled
def _write(change: Change, seen: Array) -> None:
    copy_into(seen, change.place + change.velocity + change.turn + change.spin)
