"""Two explicit Runge-Kutta methods for qpos and qvel of a free joint, Euler parameters and all."""

import math

import numpy as np

from cointoss.coin_mj.model.state import Motion
from cointoss.models.kernel.arrays import Array, copy_into, four, three
from cointoss.models.kernel.compiled import compiled

# Row s has the weights of the rates before for the state of stage s; the last row those for the step's end.
CLASSICAL = np.array(
    [[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 1 / 2, 0, 0], [0, 0, 1, 0], [1 / 6, 1 / 3, 1 / 3, 1 / 6]]
)
"""RK4: of fourth order, in 4 stages."""
TSITOURAS = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [0.161, 0, 0, 0, 0, 0],
        [-0.008480655492356989, 0.335480655492357, 0, 0, 0, 0],
        [2.8971530571054935, -6.359448489975075, 4.3622954328695815, 0, 0, 0],
        [5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525, 0, 0],
        [
            5.86145544294642,
            -12.92096931784711,
            8.159367898576159,
            -0.071584973281401,
            -0.028269050394068383,
            0,
        ],
        [
            0.09646076681806523,
            0.01,
            0.4798896504144996,
            1.379008574103742,
            -3.290069515436081,
            2.324710524099774,
        ],
    ]
)
"""Tsitouras 2011: of fifth order, in 6 stages."""
TSITOURAS_NODES = TSITOURAS.sum(axis=1)
"""The times of its stages, in steps."""


@compiled
def write_rate(motion: Motion | Array, acceleration: Array, rate: Array) -> None:
    """Write the rate of change of a state.

    Args:
        motion: qpos and qvel, (13,).
        acceleration: rate of qvel there, (6,).
        rate: where it goes, (13,).
    """
    (e0, e1, e2, e3), (a, b, c) = four(motion, 3), three(motion, 10)
    e_rate = (
        (-e1 * a - e2 * b - e3 * c) / 2,
        (e0 * a + e2 * c - e3 * b) / 2,
        (e0 * b + e3 * a - e1 * c) / 2,
        (e0 * c + e1 * b - e2 * a) / 2,
    )
    copy_into(rate, three(motion, 7) + e_rate + three(acceleration, 0) + three(acceleration, 3))


@compiled
def stage_motion(start: Motion, rates: Array, weights: Array, stage: int, dt: float, motion: Array) -> None:
    """Write the state at which the rate of a stage but the first is wanted.

    Its Euler parameters have not quite the norm 1: their own rate is linear in them, and MuJoCo's
    accelerations do not depend on the norm.

    Args:
        start: qpos and qvel at the start of the step, (13,).
        rates: of the stages before, (>= stage, 13).
        weights: of the method.
        stage: its number.
        dt: length of the step [s].
        motion: where the state goes, (13,).
    """
    for i in range(13):
        change = 0.0
        for before in range(stage):
            change += weights[stage, before] * rates[before, i]
        motion[i] = start[i] + dt * change


@compiled
def end_motion(start: Motion, rates: Array, weights: Array, dt: float, motion: Array) -> Array:
    """Write the state at the end of the step, its Euler parameters of norm 1, and give it; see above."""
    stage_motion(start, rates, weights, len(weights) - 1, dt, motion)
    normalise(motion)
    return motion


@compiled
def normalise(motion: Array) -> None:
    """Make the norm of the Euler parameters of a motion, (13,), exactly 1."""
    size = math.sqrt(motion[3] ** 2 + motion[4] ** 2 + motion[5] ** 2 + motion[6] ** 2)
    for i in range(3, 7):
        motion[i] /= size
