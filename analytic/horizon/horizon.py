"""How far a toss can be trusted: the leading impacts that the engine's own errors cannot change.

The errors of every flight and touch are carried forward by the tangent map, from event to event: of the state
just after an impact, compared at that impact, and of its time. They are kept as vectors whose outer products
add up to the covariance, which in a chatter could not hold its own digits. Where the coin is changes nothing:
the vectors have its height, velocity, Euler parameters and spin, and the time of the event.
"""

from typing import Any, NamedTuple

import numpy as np

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.events import Started
from cointoss.analytic.flight.state_vector import (
    STATE_SIZE,
    motion_scales,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
)
from cointoss.analytic.flight.turning import turns_in_closed_form
from cointoss.analytic.horizon.flight_tangent import COARSE, flight_tangent, steps_of_tangent
from cointoss.analytic.horizon.touch_derivatives import TouchDerivatives, touch_derivatives
from cointoss.analytic.numerics.householder import reflect_to_triangle
from cointoss.analytic.numerics.tolerances import TIME_STEP, TOUCH
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules
from cointoss.models.contact_laws.table import jumps_without_slip
from cointoss.models.geometry import FLAT_SINE
from cointoss.models.impact_row import ImpactRows
from cointoss.models.kernel.arrays import Table, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm
from cointoss.models.records import Array
from cointoss.models.restitution import elastic_speed

STEP_ERROR = 1e-15
"""Error that one step adds to height, velocity and spin, relative to the scales of the coin: truncation and
rounding. Against 113-bit arithmetic 99 of 100 flights stayed below 1.5e-15, one half below 1e-16."""
TURN_ERROR = 3e-15
"""Error that a step adds to the Euler parameters; the largest measured is 2.7e-15, one half below 1.2e-15."""
CLOSED_FORM = 0.2
"""Part of these errors that a step in closed form makes: in 99 of 100 flights at most 5e-16 of the motion; of
the attitude at most 3e-15, which grows with the angle turned and is carried by the error of the spin."""
CLOSED_TOUCH = 2e-16
"""A touch in closed form is found up to this part of the radius, and up to the rounding of its time. Against
extended precision the root mean square of what the gap was then is 0.74 of that, in 580 flights."""
SAFETY = 2.0
"""The factor by which the carried standard deviations are multiplied."""
TIME_ERROR = 2.8e-6
"""The time of an impact within the horizon is good to this part of √(r/g): a small coin's to 1e-7 s."""
IMPULSE_ERROR = 1e-5
"""An impulse within the horizon is good to this part of it."""
MOST_CARRIED, TOUCH_COST, DRAG_COST = 3e6, 20.0, 400.0
"""The most steps through which errors are carried, which takes seconds. An impact costs as much as the second
number of steps; a step in air with b > 0 as much as the third."""
LINEAR_RANGE = 1e-3
"""Tilt, closing speed and time of flight must be known to this part of theirs, so that the tangent map holds;
the tilt's direction is the place on the rim."""
NEAR_EDGE = 10 * FLAT_SINE
"""A coin whose normal is within this of level touches as if upright, or might: which rim lands is open."""

# An error vector has the state from its height on, and the time. A table has those carried from the impact
# before, those made in a flight, as if at its start and as if at its end, and that of the touch.
_FIRST, _TIME = 2, STATE_SIZE - 2
_AT_START = _TIME + 1
_AT_END = _AT_START + _TIME
_AT_TOUCH = _AT_END + _TIME


class Horizon(NamedTuple):
    """How far a toss can be trusted."""

    impacts: int
    """The number of leading impacts that can be trusted."""
    errors: Table
    """The errors of the state after the last of them, from its height on, and of its time: row vectors, of
    which the outer products add up to the covariance, (12, 12)."""


class ErrorsMade(NamedTuple):
    """The errors that a toss makes, and how far they are carried."""

    step: float = STEP_ERROR
    turn: float = TURN_ERROR
    most_carried: float = MOST_CARRIED


@compiled
def find_horizon(body: Body, rules: Rules, rows: ImpactRows, started: Started, made: ErrorsMade) -> Horizon:
    """Return how far a toss can be trusted.

    Trusted are the leading impacts whose time, impulse, face, place and order the engine's errors cannot
    change. None is counted after the first sustained contact, nor after the errors were carried through
    `MOST_CARRIED`.

    Args:
        body: the coin.
        rules: floor and ending.
        rows: the impacts, (n,) of `IMPACT_ROW`.
        started: the modes of the toss.
        made: the errors.
    """
    errors, changes = np.zeros((_AT_TOUCH + 1, _TIME + 1)), np.empty((_TIME, STATE_SIZE))
    y, carried, kept = np.empty(STATE_SIZE), 0.0, np.zeros((_TIME + 1, _TIME + 1))
    for i in range(len(rows)):
        row, start = rows[i], started.states[i]
        # A touch that chatters starts another mode before the next impact.
        if started.modes[i] != Mode.FLIGHT or started.times[i + 1] != row.time:
            return Horizon(i, kept)
        duration = row.time - started.times[i]
        cost = 1.0 if body.air.exponent is None else DRAG_COST
        carried += TOUCH_COST + cost * steps_of_tangent(body, state_of(start), duration, COARSE)
        if carried > made.most_carried:
            return Horizon(i, kept)
        _write_touch(row, y)
        closed = turns_in_closed_form(body, spin_of(start))
        steps = started.steps[i] * (CLOSED_FORM if closed else 1.0)
        touch = touch_derivatives(body, rules, y)
        if not touch.closing < 0:
            return Horizon(i, kept)
        _fly_errors(body, start, y, duration, changes, errors)
        _write_made(body, start, y, (steps * made.step, steps * made.turn), changes, errors)
        found_to = CLOSED_TOUCH if closed else TOUCH
        early = found_to * body.radius / touch.closing
        if closed:
            early -= TIME_STEP * duration
        sinking, delay = _sinking(body, errors), _delay_errors(touch, early, errors)
        # The first touch has no touch before it with which it could change places.
        in_order = sinking < started.grazes[i] / 2 and (i == 0 or delay <= LINEAR_RANGE * duration)
        if not (in_order and _holds(body, rules, row, touch, errors)):
            return Horizon(i, kept)
        _strike_errors(touch, errors)
        reflect_to_triangle(errors)
        for j in range(_AT_START):
            copy_into(kept[j], errors[j])
    return Horizon(len(rows), kept)


@compiled
def _write_touch(row: Any, y: Array) -> None:
    """Write the state in which the coin touched at an impact into y, (13,)."""
    x, v, e, w = row.position, row.velocity_before, row.quaternion, row.angular_velocity_before
    set_position(y, (x[0], x[1], x[2]))
    set_velocity(y, (v[0], v[1], v[2]))
    set_attitude(y, (e[0], e[1], e[2], e[3]))
    set_spin(y, (w[0], w[1], w[2]))


@compiled
def _fly_errors(body: Body, start: Array, end: Array, duration: float, changes: Array, errors: Array) -> None:
    """Carry the errors of a state and its time through a flight.

    Args:
        body: the coin.
        start: state, (13,).
        end: state, (13,).
        duration: of the flight [s].
        changes: becomes how the state at the end changes with each component at the start from the height on,
            one in each row, (11, 13).
        errors: table of error vectors; the first, carried from the impact before, are changed.
    """
    changes[:] = 0.0
    for j in range(_TIME):
        changes[j, _FIRST + j] = 1.0
    flight_tangent(body, state_of(start), state_of(end), duration, COARSE, changes[1:])
    before = np.empty(_TIME)
    for row in errors[:_AT_START]:
        for j in range(_TIME):
            before[j] = row[j]
            row[j] = 0.0
        for j in range(_TIME):
            for k in range(_TIME):
                row[k] += before[j] * changes[j, _FIRST + k]


@compiled
def _write_made(
    body: Body, start: Array, end: Array, made: tuple[float, float], changes: Array, errors: Array
) -> None:
    """Write the errors that a flight makes: as vectors at its start, carried on, and as if made at its end.

    What is exactly zero is kept so by symmetry: rounding too keeps a flat coin flat. The scales of the
    components are those of `flight.step_error`, but for the height's.

    Args:
        body: the coin.
        start: state, (13,).
        end: state, (13,).
        made: of the motion and of the Euler parameters, relative, by all steps.
        changes: see `_fly_errors`.
        errors: table of error vectors.
    """
    for y, first in ((start, _AT_START), (end, _AT_END)):
        height, (speed, spin) = max(abs(y[2]), body.radius), motion_scales(body, y)
        for j in range(_TIME):
            component = _FIRST + j
            scale = height if j == 0 else speed if component < 6 else spin
            error = made[1] if 6 <= component < 10 else made[0] * scale
            if start[component] == 0 and end[component] == 0:
                error = 0.0
            row = errors[first + j]
            row[_TIME] = 0.0
            for k in range(_TIME):
                at_end = 1.0 if k == j else 0.0
                row[k] = error * (changes[j, _FIRST + k] if first == _AT_START else at_end)


@compiled
def _delay_errors(touch: TouchDerivatives, early: float, errors: Array) -> float:
    """Carry the errors from the touch's undisturbed time to its own.

    Args:
        touch: its derivatives.
        early: by how much the touch may be found early or late [s].
        errors: table of error vectors, of which the last is made by the touch.

    Returns:
        The `_size` of the delays of the touch [s].
    """
    delays = early * early
    for i in range(_AT_TOUCH + 1):
        row, delay = errors[i], early
        if i == _AT_TOUCH:
            row[:] = 0.0
        else:
            delay = 0.0
            for k in range(_TIME):
                delay -= touch.gap[_FIRST + k] * row[k]
            delay /= touch.closing
            delays += delay * delay
        for k in range(_TIME):
            row[k] += delay * touch.rate[_FIRST + k]
        row[_TIME] += delay
    return SAFETY * delays**0.5


@compiled
def _strike_errors(touch: TouchDerivatives, errors: Array) -> None:
    """Carry all errors through the impact."""
    before = np.empty(_TIME)
    for row in errors:
        copy_into(before, row)
        for k in range(_TIME):
            after = 0.0
            for j in range(_TIME):
                after += touch.after[_FIRST + k, _FIRST + j] * before[j]
            row[k] = after


@compiled
def _size(errors: Array, first: int, last: int) -> float:
    """Return `SAFETY` standard deviations of these components of the errors together."""
    squares = 0.0
    for row in errors:
        for k in range(first, last):
            squares += row[k] * row[k]
    return SAFETY * squares**0.5


@compiled
def _size_of(slopes: Array, errors: Array) -> float:
    """Return `SAFETY` standard deviations of quantities with these derivatives by the state, (n, 13)."""
    squares = 0.0
    for row in errors:
        for slope in slopes:
            changed = 0.0
            for k in range(_TIME):
                changed += slope[_FIRST + k] * row[k]
            squares += changed * changed
    return SAFETY * squares**0.5


@compiled
def _sinking(body: Body, errors: Array) -> float:
    """Return by how much the errors lower the gap of any rim point at the end of a flight, at most [m]."""
    reach = norm(body.center) + body.radius + body.thickness / 2
    flown = errors[:_AT_TOUCH]
    return _size(flown, 0, 1) + 2 * reach * _size(flown, 6 - _FIRST, 10 - _FIRST)


@compiled
def _holds(body: Body, rules: Rules, row: Any, touch: TouchDerivatives, errors: Array) -> bool:
    """Return whether an impact keeps its time, face, place and impulse within the errors.

    Args:
        body: the coin.
        rules: floor and ending.
        row: the impact.
        touch: its derivatives.
        errors: of the state and the time at the touch, table of error vectors.
    """
    e, v_A, S = row.quaternion, row.contact_velocity_before, row.impulse
    up = rotation_matrix((e[0], e[1], e[2], e[3]))[2]
    tilt_sine = (up[0] ** 2 + up[1] ** 2) ** 0.5
    tilted = _size_of(touch.up[:2], errors)
    if tilt_sine <= FLAT_SINE:
        # Flat, the coin has no one lowest point, unless it is kept so exactly and does not turn.
        in_place = tilted == 0 and _size_of(touch.contact_velocity[:2], errors) == 0
    else:
        slips = jumps_without_slip(rules.law) and rules.friction > 0
        in_place = tilted <= LINEAR_RANGE * tilt_sine and not (slips and v_A[0] == 0 and v_A[1] == 0)
    speed, threshold, elastic = abs(v_A[2]), rules.restitution_threshold, elastic_speed(rules)
    closing = _size_of(touch.contact_velocity[2:], errors)
    return (
        in_place
        and (threshold == 0 or closing < abs(speed - threshold))
        and (elastic == 0 or closing < abs(speed - elastic))
        and _size(errors, _TIME, _TIME + 1) <= TIME_ERROR * (body.radius / body.gravity) ** 0.5
        and _size_of(touch.up[2:], errors) < abs(up[2]) - NEAR_EDGE
        and closing <= LINEAR_RANGE * speed
        and _size_of(touch.impulse, errors) <= IMPULSE_ERROR * norm((S[0], S[1], S[2]))
    )
