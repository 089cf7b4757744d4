"""The classical Runge-Kutta method for qpos and qvel of a free joint, Euler parameters and all."""

import math

from models.kernel.compiled import compiled


@compiled
def stage_motion(start, rate, stage, dt, motion):
    """Write the state at which the rate of stage 1, 2 or 3 is wanted.

    Its Euler parameters have not quite the norm 1: their own rate is linear in them, and MuJoCo's
    accelerations do not depend on the norm.

    Args:
        start: qpos and qvel at the start of the step, (13,).
        rate: of the stage before, (13,).
        stage: its number.
        dt: length of the step [s].
        motion: where the state goes, (13,).
    """
    part = dt if stage == 3 else dt / 2
    for i in range(13):
        motion[i] = start[i] + part * rate[i]


@compiled
def add_rate(motion, acceleration, stage, rate, total):
    """Write the rate of change of a stage, and add it to their weighted sum.

    Args:
        motion: qpos and qvel of the stage, (13,).
        acceleration: rate of qvel there, (6,).
        stage: its number, from 0.
        rate: where its rate goes, (13,).
        total: the sum, (13,).
    """
    e0, e1, e2, e3 = motion[3], motion[4], motion[5], motion[6]
    a, b, c = motion[10], motion[11], motion[12]
    for i in range(3):
        rate[i] = motion[7 + i]
    rate[3] = (-e1 * a - e2 * b - e3 * c) / 2
    rate[4] = (e0 * a + e2 * c - e3 * b) / 2
    rate[5] = (e0 * b + e3 * a - e1 * c) / 2
    rate[6] = (e0 * c + e1 * b - e2 * a) / 2
    for i in range(6):
        rate[7 + i] = acceleration[i]
    weight = 1.0 if stage in (0, 3) else 2.0
    for i in range(13):
        total[i] += weight * rate[i]


@compiled
def end_motion(start, total, dt, motion):
    """Write the state at the end of the step, its Euler parameters of norm 1, and give it; see above."""
    for i in range(13):
        motion[i] = start[i] + dt / 6 * total[i]
    size = math.sqrt(motion[3] ** 2 + motion[4] ** 2 + motion[5] ** 2 + motion[6] ** 2)
    for i in range(3, 7):
        motion[i] /= size
    return motion
