"""What restitution a MuJoCo user's coins get from `mj_step` with a fixed step."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np

from cointoss import Scenario
from cointoss.coin_mj import MujocoSettings, Realisation
from cointoss.study import (
    Array,
    build,
    contact_velocity,
    gap,
    lowest_point,
    of_release,
    rebound_of,
    rotation_matrix,
    shape_thickness,
    to_mass_center,
)
from cointoss_bounce.drops import LONGEST, PHASES


def restitutions_of_coins(cases: Sequence[Scenario], settings: MujocoSettings, dt: float) -> Array:
    """Let coins come down on a smooth floor and step them with `mj_step`; give χ' of their first impacts.

    The integrator is the realisation's: Euler for one-step contacts, RK4 for springs. The touch falls
    anywhere between two steps, at another of the `PHASES` for each coin in turn.

    Args:
        cases: releases at the touch.
        settings: of the contact; its own steps are not used.
        dt: length of a step [s].

    Returns:
        (n,); nothing known (NaN) of a coin that is not free again within `LONGEST` steps.
    """
    return np.array(
        [
            _restitution_of_a_coin(case, settings, dt, (number % PHASES + 0.5) / PHASES)
            for number, case in enumerate(cases)
        ]
    )


def loop_model(case: Scenario, settings: MujocoSettings, dt: float) -> mujoco.MjModel:
    """Build the coin of a scenario for a loop of `mj_step` with steps of dt [s]."""
    one_step = settings.contact == Realisation.ONE_STEP
    rebound = rebound_of(case.floor.restitution, replace(settings, step=dt))
    model = build(case, rebound, 0.0, shape_thickness(case))
    model.opt.timestep = dt
    kinds = mujoco.mjtIntegrator
    model.opt.integrator = kinds.mjINT_EULER if one_step else kinds.mjINT_RK4
    return model


def _restitution_of_a_coin(case: Scenario, settings: MujocoSettings, dt: float, phase: float) -> float:
    body, model = case.body, loop_model(case, settings, dt)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, case.release)
    R, velocity = rotation_matrix(case.release.attitude), case.release.velocity
    point, _ = lowest_point(body, R[2], case.release.angular_velocity)
    fall = contact_velocity(body, R, velocity, case.release.angular_velocity, point)[2]
    data.qpos[2] -= fall * dt * phase
    touched = False
    for _ in range(LONGEST):
        mujoco.mj_step(model, data)
        x, v, e, w, _ = to_mass_center(body, data.qpos, data.qvel)
        R = rotation_matrix(e)
        touched = touched or gap(body, x[2], R[2]) < 0
        rise = contact_velocity(body, R, v, w, point)[2]
        mujoco.mj_forward(model, data)
        if touched and rise > 0 and data.qfrc_constraint[2] == 0:
            return -rise / fall
    return math.nan
