"""How far a toss can be trusted: the leading impacts that the engine's own errors cannot change.

The errors of every flight and touch are carried forward by the tangent map, from event to event: of the state
just after an impact, compared at that impact, and of its time. They are kept as vectors whose outer products
add up to the covariance, which in a chatter could not hold its own digits.
"""

import numpy as np

from cointoss.analytic.events import EventLog
from cointoss.analytic.flight.flying import fly_with_graze, steps_of
from cointoss.analytic.flight.state_vector import STATE_SIZE, spin_of
from cointoss.analytic.flight.turning import turns_in_closed_form
from cointoss.analytic.horizon.flight_tangent import flight_tangent
from cointoss.analytic.horizon.sensitivity import delay_of, flight_map, impact_map, touch_map
from cointoss.analytic.horizon.touch_derivatives import Touch, touch_derivatives
from cointoss.analytic.numerics.tolerances import TIME_STEP, TOUCH
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules
from cointoss.models.geometry import FLAT_SINE
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Array

STEP_ERROR = 1e-15
"""Error that one step adds to height, velocity and spin, relative to the scales of the coin: truncation and
rounding. Against 113-bit arithmetic 99 of 100 flights stayed below 1.5e-15, one half below 1e-16."""
TURN_ERROR = 3e-15
"""Likewise for the Euler parameters; the largest measured was 2.7e-15, one half stayed below 1.2e-15."""
CLOSED_FORM = 0.2
"""Part of these errors that a step in closed form makes: in 99 of 100 flights at most 5e-16 of the motion; of
the attitude at most 3e-15, which grows with the angle turned and is carried by the error of the spin."""
CLOSED_TOUCH = 2e-16
"""A touch in closed form is found up to this part of the radius, and up to the rounding of its time. Against
extended precision the root mean square of what the gap was then is 0.74 of that, in 580 flights."""
SAFETY = 2.0
"""The carried standard deviations are taken so many times."""
TIME_ERROR = 1e-7
"""Within the horizon the time of an impact is good to this [s]."""
IMPULSE_ERROR = 1e-5
"""Within the horizon an impulse is good to this part of it."""
MOST_CARRIED, TOUCH_COST, DRAG_COST = 1e5, 20.0, 400.0
"""Errors are carried through this much turning [rad], which takes seconds: an impact costs as much as the
second, a turn in air with b > 0 the third times as much as another."""
LINEAR_RANGE = 1e-3
"""Tilt, closing speed and time of flight must be known to this part of theirs, so that the tangent map holds;
the tilt's direction is the place on the rim."""


def trusted_impacts(body: Body, rules: Rules, toss: EventLog) -> int:
    """Count the leading impacts whose time, impulse, face, place and order the engine's errors cannot change.

    None is counted after which the errors were carried through `MOST_CARRIED`.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
    """
    # Of the state after the last impact, and of its time.
    errors, carried = np.zeros((STATE_SIZE + 1, 0)), 0.0
    for i, row in enumerate(toss.rows):
        y = toss.start_states[i].copy()
        carried += TOUCH_COST + _turning(body, y, row["time"] - toss.start_times[i])
        if carried > MOST_CARRIED:
            return i
        closed = turns_in_closed_form(body, spin_of(y))
        at_start, flight, at_end, duration, graze = _flight(
            body, rules, y, toss.start_times[i], CLOSED_FORM if closed else 1.0
        )
        errors = np.hstack([flight @ np.hstack([errors, at_start]), at_end])
        touch = touch_derivatives(body, rules, y)
        if not touch.closing < 0:
            return i
        found_to = CLOSED_TOUCH if closed else TOUCH
        early = found_to * body.radius / touch.closing - closed * TIME_STEP * duration
        delay = np.append(delay_of(touch) @ errors, early)
        sinking = _sinking(body, errors)
        errors = np.column_stack([touch_map(touch) @ errors, early * np.append(touch.rate, 1)])
        # The first touch has none before it with which to change places.
        in_order = sinking < graze / 2 and (i == 0 or _size(delay) <= LINEAR_RANGE * duration)
        if not (in_order and _holds(rules, row, touch, errors)):
            return i
        # A triangle of as many error vectors as dimensions has the same covariance.
        errors = np.transpose(np.linalg.qr((impact_map(touch) @ errors).T, mode="r"))
    return len(toss.rows)


def _turning(body: Body, y: Array, duration: float) -> float:
    """Return about how far a coin turns in a flight, which says how many steps it takes [rad].

    Args:
        body: the coin.
        y: state at the start, (13,).
        duration: of the flight [s].
    """
    turned = duration * ((body.gravity / body.radius) ** 0.5 + float(np.linalg.norm(y[10:13])))
    return turned if body.air.exponent is None else DRAG_COST * turned


def _flight(
    body: Body, rules: Rules, y: Array, start_time: float, part: float
) -> tuple[Array, Array, Array, float, float]:
    """Fly from y to the next touch.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at the start, (13,); becomes that at the touch.
        start_time: its time [s].
        part: of the errors of a step that the flight makes.

    Returns:
        Errors that the flight makes, as vectors at its start, (14, 13); its tangent map, (14, 14); the same
        errors as if all were made at its end; its duration [s]; and its graze, see `fly_with_graze`.
    """
    start, at_first = y.copy(), _step_errors(body, y)
    duration, graze = fly_with_graze(body, y, rules.max_time - start_time)
    tangents, moved = np.eye(STATE_SIZE), np.zeros(STATE_SIZE, dtype=np.bool_)
    made = part * steps_of(body, start, duration)
    flight_tangent(body, start, duration, tangents, moved)
    # What stays exactly zero is kept so by symmetry: rounding too keeps a flat coin flat.
    at_start, at_end = (
        np.eye(STATE_SIZE + 1, STATE_SIZE) * made * moved * errors
        for errors in (at_first, _step_errors(body, y))
    )
    return at_start, flight_map(tangents), at_end, duration, graze


def _step_errors(body: Body, y: Array) -> Array:
    """Return the errors of a step in the components of the state, (13,); x and y change no impact.

    The scales are those of `flight.step_error`, but for the height's.
    """
    speed = (body.gravity * body.radius) ** 0.5 + float(np.linalg.norm(y[3:6]))
    spin = (body.gravity / body.radius) ** 0.5 + float(np.linalg.norm(y[10:13]))
    height = max(abs(y[2]), body.radius)
    motion = STEP_ERROR * np.array([0, 0, height, *[speed] * 3, *[0] * 4, *[spin] * 3])
    return motion + TURN_ERROR * np.array([*[0] * 6, *[1] * 4, *[0] * 3])


def _size(errors: Array) -> float:
    """Return `SAFETY` standard deviations of what the error vectors change, one in each column."""
    return SAFETY * float(np.linalg.norm(errors))


def _sinking(body: Body, errors: Array) -> float:
    """Return by how much the errors lower the gap of any rim point at the end of a flight, at most [m]."""
    reach = np.linalg.norm(body.center) + body.radius + body.thickness / 2
    return _size(errors[2]) + 2 * float(reach) * _size(errors[6:10])


def _holds(rules: Rules, row: np.void, touch: Touch, errors: Array) -> bool:
    """Return whether an impact keeps its time, face, place and impulse within the errors.

    Args:
        rules: floor and ending.
        row: the impact.
        touch: its derivatives.
        errors: of the state and the time at the touch, one vector in each column, (14, n).
    """

    def error(rows: Array) -> float:
        return _size(rows @ errors[:STATE_SIZE])

    up, v_A = rotation_matrix(row["quaternion"])[2], row["contact_velocity_before"]
    tilt_sine = np.hypot(up[0], up[1])
    if tilt_sine <= FLAT_SINE:
        # Flat, the coin has no one lowest point, unless it is kept so exactly and does not turn.
        in_place = error(touch.up[:2]) == error(touch.contact_velocity[:2]) == 0
    else:
        slips = rules.law == ContactLaw.SLIDING_FRICTION and rules.friction > 0
        in_place = error(touch.up[:2]) <= LINEAR_RANGE * tilt_sine and not (slips and not v_A[:2].any())
    speed, threshold = abs(v_A[2]), rules.restitution_threshold
    same_restitution = threshold == 0 or error(touch.contact_velocity[2]) < abs(speed - threshold)
    return bool(
        in_place
        and same_restitution
        and _size(errors[-1]) <= TIME_ERROR
        and error(touch.up[2]) < abs(up[2])
        and error(touch.contact_velocity[2]) <= LINEAR_RANGE * speed
        and error(touch.impulse) <= IMPULSE_ERROR * np.linalg.norm(row["impulse"])
    )
