"""The tangent map of a flight: how a small change of its start grows.

The Runge-Kutta tableau acts on the linearised equations of motion at the stages of a flight: the result is
the derivative of the very numbers that these steps compute, their lengths held.
"""

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.air.force import force_and_moment, write_jacobian
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.integrated_flight import accepted_step, first_step, step
from cointoss.analytic.flight.runge_kutta import end_point, stage_point
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, spin_of, state_of, velocity_of
from cointoss.analytic.numerics.rotation import quaternion_rate, rotation_change
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.analytic.numerics.tolerances import STEP_ERROR
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, cross, subtract

STEP_ERROR_OF_GROWTH = 1e-7
"""Error allowed in one step where b > 0 and each step takes many quadratures: a growth is wanted to 1e-3."""


@compiled
def derivative_change(body: Body, y: Array, force: Vector, jacobian: Array, dy: Array, rate: Array) -> None:
    """Write the change of `flight.derivative` with the state into `rate`.

    Args:
        body: the coin.
        y: state, (13,).
        force: of the air there, body frame, (3,) [N].
        jacobian: of the air's force and moment there, see `write_jacobian`, (6, 6).
        dy: change of the state, (13,).
        rate: where the change of its rate of change goes, (13,).
    """
    _, v, e, w, R = state_of(y)
    dv, de, dw = velocity_of(dy), attitude_of(dy), spin_of(dy)
    dR = rotation_change(e, de)
    dv_body = add(apply_transposed(dR, v), apply_transposed(R, dv))
    df, dm_C = _part(jacobian, 0, dv_body, dw), _part(jacobian, 3, dv_body, dw)
    df_space = add(apply(dR, force), apply(R, df))
    d_gyroscopic = add(cross(dw, apply(body.inertia, w)), cross(w, apply(body.inertia, dw)))
    by_attitude, by_spin = quaternion_rate(de, w), quaternion_rate(e, dw)
    for i in range(3):
        rate[i] = dv[i]
        rate[3 + i] = df_space[i] / body.mass
    for i in range(4):
        rate[6 + i] = by_attitude[i] + by_spin[i]
    rate[10], rate[11], rate[12] = apply(body.inertia_inverse, subtract(dm_C, d_gyroscopic))


@compiled
def _part(jacobian: Array, first: int, dv: Vector, dw: Vector) -> Vector:
    """Return three rows of a jacobian, from this one on, times a change of the motion."""
    by_v = (_row(jacobian, first, 0), _row(jacobian, first + 1, 0), _row(jacobian, first + 2, 0))
    by_w = (_row(jacobian, first, 3), _row(jacobian, first + 1, 3), _row(jacobian, first + 2, 3))
    return add(apply(by_v, dv), apply(by_w, dw))


@compiled
def _row(table: Array, row: int, column: int) -> Vector:
    """Return three numbers of a row, from a column on."""
    return table[row, column], table[row, column + 1], table[row, column + 2]


@compiled
def step_change(body: Body, y: Array, dt: float, stages: Array, changes: Array) -> None:
    """Carry small changes of the state through the step that `flight.step` has just made.

    Args:
        body: the coin.
        y: state at the start of the step, (13,).
        dt: its length [s].
        stages: the rates of change at its stages, (12, 13).
        changes: one change of the state in each row, (n, 13); become those at the end of the step.
    """
    points, forces, jacobians = (
        np.empty((STAGES, STATE_SIZE)),
        np.empty((STAGES, 3)),
        np.empty((STAGES, 6, 6)),
    )
    for stage in range(STAGES):
        point = points[stage]
        stage_point(y, dt, stages, stage, point)
        at_stage = state_of(point)
        v, w = apply_transposed(at_stage.R, at_stage.velocity), at_stage.spin
        (forces[stage, 0], forces[stage, 1], forces[stage, 2]), _ = force_and_moment(body, v, w)
        write_jacobian(body, v, w, jacobians[stage])
    end = np.empty(STATE_SIZE)
    end_point(y, dt, stages, end)
    e = attitude_of(end)
    square = e[0] ** 2 + e[1] ** 2 + e[2] ** 2 + e[3] ** 2
    slopes, inside = np.empty((STAGES, STATE_SIZE)), np.empty(STATE_SIZE)
    for change in changes:
        for stage in range(STAGES):
            stage_point(change, dt, slopes, stage, inside)
            force = _row(forces, stage, 0)
            derivative_change(body, points[stage], force, jacobians[stage], inside, slopes[stage])
        end_point(change, dt, slopes, inside)
        copy_into(change, inside)
        # The quaternion is brought back to norm 1.
        along = (e[0] * change[6] + e[1] * change[7] + e[2] * change[8] + e[3] * change[9]) / square
        for i in range(4):
            change[6 + i] = (change[6 + i] - along * e[i]) / square**0.5


@compiled
def flight_tangent(body: Body, y: Array, duration: float, changes: Array, moved: NDArray[np.bool_]) -> None:
    """Carry small changes of the state through a flight.

    Args:
        body: the coin.
        y: state at the start, (13,); becomes the state at the end.
        duration: of the flight [s].
        changes: one change of the state in each row, (n, 13); become those at the end of the flight.
        moved: set to True for the components of the state that do not stay exactly zero, (13,).
    """
    stages, y_new = np.empty((STAGES, STATE_SIZE)), np.empty(STATE_SIZE)
    elapsed, dt = 0.0, first_step(body, y)
    tolerance = STEP_ERROR if body.air.exponent is None else STEP_ERROR_OF_GROWTH
    while elapsed < duration:
        made, dt_next = accepted_step(body, y, dt, tolerance, stages, y_new)
        if elapsed + made >= duration:
            made = duration - elapsed
            derivative(body, y, stages[0])
            step(body, y, made, stages, y_new)
        for i in range(STATE_SIZE):
            moved[i] = moved[i] or y[i] != 0 or y_new[i] != 0
        step_change(body, y, made, stages, changes)
        copy_into(y, y_new)
        elapsed += made
        dt = dt_next
