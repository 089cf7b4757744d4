"""Flights step by step, by power series or where b > 0 by Runge-Kutta, and the states between."""

import numpy as np

from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.power_series import COLUMNS, ROWS, expand_flight, state_in_flight
from cointoss.analytic.flight.runge_kutta import end_point, stage_point, step_error, step_factor
from cointoss.analytic.flight.state_vector import STATE_SIZE, normalise, spin_of
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.analytic.numerics.tolerances import STEP_ERROR
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm


@compiled
def step(body: Body, y: Array, dt: float, stages: Array, y_new: Array) -> None:
    """Advance the state by one step of order 8, its quaternion brought back to norm 1.

    Args:
        body: the coin.
        y: state at the start, (13,); the first row of `stages` must hold its derivative.
        dt: length of the step [s].
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).
    """
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        derivative(body, y_new, stages[stage])
    end_point(y, dt, stages, y_new)
    normalise(y_new)


@compiled
def first_step(body: Body, y: Array) -> float:
    """Return a step with which to start a flight [s]: a twentieth of a radian, or of the time to fall r."""
    return 0.05 / (norm(spin_of(y)) + (body.gravity / body.radius) ** 0.5)


@compiled
def accepted_step(
    body: Body, y: Array, dt: float, tolerance: float, stages: Array, y_new: Array
) -> tuple[float, float]:
    """Advance the state by a step at most dt long.

    Args:
        body: the coin.
        y: state at the start, (13,).
        dt: length to try first [s].
        tolerance: error allowed, see `step_error`.
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, and a length for the next [s].

    Raises:
        FloatingPointError: if no step is short enough to stay finite.
    """
    derivative(body, y, stages[0])
    while True:
        step(body, y, dt, stages, y_new)
        error = step_error(body, y, dt, stages) / tolerance
        if error <= 1:
            return dt, dt * step_factor(error)
        dt *= step_factor(error)
        if not dt > 0:
            raise FloatingPointError("the motion leaves the range of floating-point numbers")


@compiled
def flight_work(body: Body) -> Array:
    """Return the work space of a flight: for its series, or where b > 0 a Runge-Kutta step and its end."""
    if body.air.exponent is None:
        return np.empty((ROWS, COLUMNS))
    return np.empty((STAGES + 1, STATE_SIZE))


@compiled
def flight_step(body: Body, y: Array, dt: float, longest: float, work: Array) -> tuple[float, float, int]:
    """Prepare a step of a flight: expand it, or where b > 0 find how long a Runge-Kutta step may be.

    Args:
        body: the coin.
        y: state at the start, (13,).
        dt: length to try first where b > 0 [s].
        longest: the longest step wanted [s].
        work: see `flight_work`.

    Returns:
        The length of the step, a length to try first for the next [s], and the order of the series.
    """
    if body.air.exponent is None:
        length, order = expand_flight(body, y, longest, work)
        return length, np.inf, order
    made, dt = accepted_step(body, y, min(dt, longest), STEP_ERROR, work, work[STAGES])
    return made, dt, 0


@compiled
def within_step(body: Body, y: Array, t: float, order: int, work: Array, y_new: Array) -> None:
    """Write the state at the time t within a step into y_new.

    Args:
        body: the coin.
        y: state at the start of the step, (13,).
        t: time since then [s].
        order: see `flight_step`.
        work: see `flight_work`.
        y_new: state, (13,).
    """
    if body.air.exponent is None:
        state_in_flight(body, work, order, t, y, y_new)
    else:
        step(body, y, t, work, y_new)


@compiled
def finish_step(body: Body, made: float, order: int, work: Array, y: Array, scratch: Array) -> None:
    """Advance the state y to the end of a step.

    Args:
        body: the coin.
        made: length of the step [s].
        order: see `flight_step`.
        work: see `flight_work`.
        y: state at the start of the step, (13,).
        scratch: work space, (13,).
    """
    if body.air.exponent is None:
        state_in_flight(body, work, order, made, y, scratch)
        copy_into(y, scratch)
    else:
        copy_into(y, work[STAGES])


@compiled
def sample_flight(body: Body, start: Array, start_time: float, times: Array, states: Array) -> int:
    """Write the states of one flight at `times` into `states`.

    Args:
        body: the coin.
        start: state at the start of the flight, (13,).
        start_time: its time [s].
        times: increasing, none before start_time, (n,) [s].
        states: where they go, (n, 13).

    Returns:
        The number of steps up to the last time.
    """
    work, y, y_new = flight_work(body), start.copy(), np.empty(STATE_SIZE)
    elapsed, steps = 0.0, 1
    made, dt, order = flight_step(body, y, first_step(body, y), np.inf, work)
    for i in range(len(times)):
        while times[i] - start_time > elapsed + made:
            finish_step(body, made, order, work, y, y_new)
            elapsed += made
            made, dt, order = flight_step(body, y, dt, np.inf, work)
            steps += 1
        within_step(body, y, times[i] - start_time - elapsed, order, work, states[i])
    return steps
