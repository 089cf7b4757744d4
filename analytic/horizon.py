"""How far a toss can be trusted: the leading impacts that the engine's own errors cannot change.

The errors are carried forward as a covariance by the tangent map, from event to event: the state just after
an impact, compared at that impact, and its time. This is the saltation matrix in the coordinates of the
impacts; there a low hop loses no digits to the jump of the velocity.
"""

import numpy as np

from analytic.events import Run
from analytic.flight import STATE_SIZE
from analytic.flight_tangent import flight_tangent
from analytic.impact_tangent import Touch, touch_tangent
from analytic.rim import TOUCH, fly
from models.attitude import rotation_matrix
from models.body import Body, Rules
from models.geometry import FLAT_SINE
from models.laws import ContactLaw
from models.records import Array

STEP_ERROR = 3e-15
"""Error of one step in each component of the state, relative to the scales of the coin: truncation and
rounding. The largest measured against 113-bit arithmetic was 2.7e-15, of an Euler parameter."""
SAFETY = 3.0
"""The carried standard deviations are taken so many times."""
TIME_ERROR = 1e-7
"""Within the horizon the time of an impact is good to this [s]."""
IMPULSE_ERROR = 1e-5
"""Within the horizon an impulse is good to this part of it."""
LINEAR_RANGE = 1e-3
"""Place (in radii), closing speed and time of flight (relative) must be known to this part, so that the
tangent map holds."""


def trusted_impacts(body: Body, rules: Rules, toss: Run) -> int:
    """Count the leading impacts whose time, impulse, face, place and order the engine's errors cannot change.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
    """
    # Of the state after the last impact, and of its time.
    covariance = np.zeros((STATE_SIZE + 1, STATE_SIZE + 1))
    for i, row in enumerate(toss.rows):
        y = toss.start_states[i].copy()
        noise, flight, duration, graze = _flight(body, rules, y, toss.start_times[i])
        covariance = flight @ (covariance + noise[0]) @ flight.T + noise[1]
        if _reach(body, covariance) > graze / 2:
            return i
        touch = touch_tangent(body, rules, y)
        closing = touch.gap @ touch.rate
        delay = -np.append(touch.gap, 0) / closing
        late = SAFETY * np.hypot(_deviation(delay, covariance), TOUCH * body.radius / closing)
        if not late <= LINEAR_RANGE * duration:
            return i
        to_touch = np.eye(STATE_SIZE + 1) + np.outer(np.append(touch.rate, 1), delay)
        sunk = np.append(touch.rate, 1) * (TOUCH * body.radius / closing)
        covariance = to_touch @ covariance @ to_touch.T + np.outer(sunk, sunk)
        if not _holds(body, rules, row, touch, covariance):
            return i
        hit = np.eye(STATE_SIZE + 1)
        hit[:STATE_SIZE, :STATE_SIZE] = touch.after
        covariance = hit @ covariance @ hit.T
    return len(toss.rows)


def _flight(body: Body, rules: Rules, y: Array, start_time: float) -> tuple[list[Array], Array, float, float]:
    """Fly from y to the next touch.

    Returns:
        Covariances of the errors that the flight makes at its start and at its end, each as large as if all
        were made there; the flight's tangent map; its duration [s]; and the graze of `rim.fly`.
    """
    scales = [_scales(body, y)]
    start = y.copy()
    duration, _, graze = fly(body, y, rules.max_time - start_time)
    scales.append(_scales(body, y))
    tangents, moved = np.eye(STATE_SIZE), np.zeros(STATE_SIZE, dtype=np.bool_)
    steps = flight_tangent(body, start, duration, tangents, moved)
    # What stays exactly zero is kept so by symmetry: rounding too keeps a flat coin flat.
    noise = [np.diag((STEP_ERROR * steps * np.append(scale * moved, 0)) ** 2) for scale in scales]
    flight = np.eye(STATE_SIZE + 1)
    flight[:STATE_SIZE, :STATE_SIZE] = tangents.T
    return noise, flight, duration, graze


def _scales(body: Body, y: Array) -> Array:
    """Give the scales of a state's components, (13,), as in `flight.step_error`; x and y do not matter."""
    speed = (body.gravity * body.radius) ** 0.5 + np.linalg.norm(y[3:6])
    spin = (body.gravity / body.radius) ** 0.5 + np.linalg.norm(y[10:13])
    height = max(abs(y[2]), body.radius)
    return np.array([0, 0, height, *[speed] * 3, *[1.0] * 4, *[spin] * 3])


def _deviation(rows: Array, covariance: Array) -> float:
    """Give the standard deviation of the vector `rows` @ error."""
    variance = np.sum((rows @ covariance) * rows)
    return float(np.sqrt(max(variance, 0.0)))


def _reach(body: Body, covariance: Array) -> float:
    """Give by how much the errors may lower the gap of any rim point at the end of a flight [m]."""
    variances = np.maximum(np.diag(covariance), 0)
    size = np.linalg.norm(body.center) + body.radius + body.thickness / 2
    return SAFETY * float(np.sqrt(variances[2]) + 2 * size * np.sqrt(variances[6:10].sum()))


def _holds(body: Body, rules: Rules, row: np.void, touch: Touch, covariance: Array) -> bool:
    """Tell whether an impact keeps its time, face, place and impulse within the errors.

    Args:
        body: the coin.
        rules: floor and ending.
        row: the impact.
        touch: its derivatives.
        covariance: of the state and the time at the touch, (14, 14).
    """
    state = covariance[:STATE_SIZE, :STATE_SIZE]

    def error(rows: Array) -> float:
        return SAFETY * _deviation(rows, state)

    up = rotation_matrix(row["quaternion"])[2]
    tilt_sine = np.hypot(up[0], up[1])
    if tilt_sine <= FLAT_SINE and not error(touch.up[:2]) == error(touch.contact_velocity[:2]) == 0:
        return False
    v_A = row["contact_velocity_before"]
    rubs = rules.law == ContactLaw.SLIDING_FRICTION and rules.friction > 0
    if rubs and tilt_sine > FLAT_SINE and not v_A[:2].any():
        return False
    in_time = SAFETY * np.sqrt(max(covariance[-1, -1], 0)) <= TIME_ERROR
    return bool(
        in_time
        and error(touch.up[2]) < abs(up[2])
        and error(touch.point) <= LINEAR_RANGE * body.radius
        and error(touch.contact_velocity[2]) <= LINEAR_RANGE * abs(v_A[2])
        and error(touch.impulse) <= IMPULSE_ERROR * np.linalg.norm(row["impulse"])
    )
