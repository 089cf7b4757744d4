"""What restitution a MuJoCo user gets from `mj_step` with a fixed step, without this project's machinery."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np

from coin_mj.model.scene import build, shape_thickness
from coin_mj.model.settings import Realisation, Settings, damping_ratio_of, rebound_of
from coin_mj.model.state import of_release, to_mass_center
from models.attitude import rotation_matrix
from models.geometry import contact_velocity, gap, lowest_point
from models.records import Array
from models.scenario import Scenario

_BALL = """
<mujoco>
  <option timestep="{dt!r}" integrator="{integrator}">
    <flag diagexact="enable"/>
  </option>
  <worldbody>
    <geom type="plane" size="0 0 1" condim="1"/>
    <body pos="0 0 {height!r}">
      <freejoint/>
      <geom type="sphere" size="0.01" mass="0.01" condim="1" priority="1"
            solref="{solref}" solimp="{solimp}"/>
    </body>
  </worldbody>
</mujoco>
"""
HARDEST, DEFAULT = "0.9999 0.9999 0.001 0.5 2", "0.9 0.95 0.001 0.5 2"
"""The largest impedance MuJoCo takes, and its own default, as solimp."""
LONGEST = 2000
"""A contact that goes on for more steps is no rebound."""
PHASES = 16
"""Heights of release, spread over the way of one step: a touch falls anywhere between two steps."""


def one_step_solref(restitution: float, dt: float) -> tuple[float, float]:
    """Return the solref that makes an impact within one step: "0 -(1 + e)/dt"."""
    return 0.0, -(1 + restitution) / dt


def spring_solref(restitution: float, dt: float, steps: int) -> tuple[float, float]:
    """Return the solref of a damped spring that is resolved by so many steps: k = (π/(n dt))², d = 2 ζ √k."""
    root = math.pi / (steps * dt)
    return -root * root, -2 * damping_ratio_of(restitution) * root


def restitutions_of_a_ball(
    solref: tuple[float, float], dt: float, integrator: str, solimp: str = HARDEST
) -> Array:
    """Drop a ball on a plane and step it with `mj_step`; give its speed after over that before.

    Args:
        solref: of the contact, direct form.
        dt: length of a step [s].
        integrator: "Euler", "implicitfast" or "RK4".
        solimp: of the contact.

    Returns:
        For each of the `PHASES` of the touch between two steps, (PHASES,).
    """
    found, speed = np.empty(PHASES), 2.0
    for number in range(PHASES):
        height = 0.01 + speed * dt * (2 + (number + 0.5) / PHASES)
        described = _BALL.format(
            dt=dt,
            integrator=integrator,
            height=height,
            solref=f"{solref[0]!r} {solref[1]!r}",
            solimp=solimp,
        )
        model = mujoco.MjModel.from_xml_string(described)
        data = mujoco.MjData(model)
        # Without weight the speed before and after is the same whenever it is read.
        model.opt.gravity[:] = 0
        data.qvel[2] = -speed
        touched = False
        for _ in range(LONGEST):
            mujoco.mj_step(model, data)
            touched = touched or data.ncon > 0
            if touched and data.ncon == 0 and data.qvel[2] > 0:
                break
        found[number] = data.qvel[2] / speed
    return found


def restitutions_of_coins(cases: Sequence[Scenario], settings: Settings, dt: float) -> Array:
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


def loop_model(case: Scenario, settings: Settings, dt: float) -> mujoco.MjModel:
    """Build the coin of a scenario for a loop of `mj_step` with steps of dt [s]."""
    one_step = settings.contact == Realisation.ONE_STEP
    rebound = rebound_of(case.floor.restitution, replace(settings, step=dt))
    model = build(case, rebound, 0.0, shape_thickness(case))
    model.opt.timestep = dt
    kinds = mujoco.mjtIntegrator
    model.opt.integrator = kinds.mjINT_EULER if one_step else kinds.mjINT_RK4
    return model


def _restitution_of_a_coin(case: Scenario, settings: Settings, dt: float, phase: float) -> float:
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
        x, v, e, w = to_mass_center(body, data.qpos, data.qvel)
        R = rotation_matrix(e)
        touched = touched or gap(body, x[2], R[2]) < 0
        rise = contact_velocity(body, R, v, w, point)[2]
        mujoco.mj_forward(model, data)
        if touched and rise > 0 and data.qfrc_constraint[2] == 0:
            return -rise / fall
    return math.nan
