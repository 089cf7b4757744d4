"""Free flight: the equations of motion, and their integration at tight tolerance.

A state is an array of 13: position of C (space), velocity of C (space), Euler parameters (body to space),
angular velocity (body).
"""

import numpy as np

from analytic.air.force import force_and_moment
from analytic.numerics.rotation import quaternion_rate
from analytic.numerics.runge_kutta import (
    STAGES,
    combined_error,
    end_point,
    error_parts,
    stage_point,
    step_factor,
)
from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, apply_transposed, cross, subtract

STATE_SIZE = 13
TOLERANCE = 1e-13
"""Relative error allowed in one step, on the scales of the coin."""


@compiled
def position_of(y):
    """Give the position of C in the state y, space frame [m]."""
    return y[0], y[1], y[2]


@compiled
def velocity_of(y):
    """Give the velocity of C in the state y, space frame [m/s]."""
    return y[3], y[4], y[5]


@compiled
def attitude_of(y):
    """Give the Euler parameters in the state y, body to space."""
    return y[6], y[7], y[8], y[9]


@compiled
def spin_of(y):
    """Give the angular velocity in the state y, body frame [rad/s]."""
    return y[10], y[11], y[12]


@compiled
def derivative(body, y, dy):
    """Write the time derivative of the state y into dy.

    m a_C = f and J_C ω̇ + ω × J_C ω = m_C; Strzalko et al. 2008, eqs (21)-(22).

    Args:
        body: the coin.
        y: state, (13,).
        dy: where its rate of change goes, (13,).
    """
    v, e, w = velocity_of(y), attitude_of(y), spin_of(y)
    R = rotation_matrix(e)
    f, m_C = force_and_moment(body, apply_transposed(R, v), w)
    f_space = apply(R, f)
    gyroscopic = cross(w, apply(body.inertia, w))
    dy[0], dy[1], dy[2] = v
    dy[3] = f_space[0] / body.mass
    dy[4] = f_space[1] / body.mass
    dy[5] = f_space[2] / body.mass - body.gravity
    dy[6], dy[7], dy[8], dy[9] = quaternion_rate(e, w)
    dy[10], dy[11], dy[12] = apply(body.inertia_inverse, subtract(m_C, gyroscopic))


@compiled
def step(body, y, dt, stages, y_new):
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
def normalise(y):
    """Bring the Euler parameters of the state y back to norm 1."""
    norm = (y[6] ** 2 + y[7] ** 2 + y[8] ** 2 + y[9] ** 2) ** 0.5
    for i in range(6, 10):
        y[i] /= norm


@compiled
def step_error(body, y, dt, stages):
    """Estimate the error of the step just made, relative to the scales of the coin.

    The scales: r for positions, √(g r) beside |v| for velocities, 1 for Euler parameters, √(g/r) beside
    |ω| for angular velocities.
    """
    speed = (body.gravity * body.radius) ** 0.5 + (y[3] ** 2 + y[4] ** 2 + y[5] ** 2) ** 0.5
    spin = (body.gravity / body.radius) ** 0.5 + (y[10] ** 2 + y[11] ** 2 + y[12] ** 2) ** 0.5
    sum_5, sum_3 = 0.0, 0.0
    for i in range(STATE_SIZE):
        size = body.radius if i < 3 else speed if i < 6 else 1.0 if i < 10 else spin
        e5, e3 = error_parts(stages, i)
        sum_5 += (e5 / size) ** 2
        sum_3 += (e3 / size) ** 2
    return combined_error(dt, sum_5, sum_3, STATE_SIZE)


@compiled
def first_step(body, y):
    """Give a step with which to start a flight [s]: a twentieth of a radian, or of the time to fall r."""
    spin = (y[10] ** 2 + y[11] ** 2 + y[12] ** 2) ** 0.5
    return 0.05 / (spin + (body.gravity / body.radius) ** 0.5)


@compiled
def accepted_step(body, y, dt, stages, y_new):
    """Advance the state by a step whose error is within `TOLERANCE`, at most dt long.

    Args:
        body: the coin.
        y: state at the start, (13,).
        dt: length to try first [s].
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
        error = step_error(body, y, dt, stages) / TOLERANCE
        if error <= 1:
            return dt, dt * step_factor(error)
        dt *= step_factor(error)
        if dt == 0:
            raise FloatingPointError("the motion leaves the range of floating-point numbers")


@compiled
def sample_flight(body, start, start_time, times, states):
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
    stages = np.empty((STAGES, STATE_SIZE))
    y, y_new = start.copy(), np.empty(STATE_SIZE)
    elapsed, dt, steps = 0.0, first_step(body, y), 1
    for i in range(len(times)):
        while True:
            ahead = times[i] - start_time - elapsed
            if ahead <= dt:
                break
            made, dt = accepted_step(body, y, dt, stages, y_new)
            elapsed += made
            steps += 1
            y[:] = y_new
        derivative(body, y, stages[0])
        step(body, y, ahead, stages, states[i])
    return steps
