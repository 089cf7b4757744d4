"""How much energy a tumbling body gains or loses in free flight, by each of MuJoCo's integrators."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math

import mujoco
import numpy as np

from cointoss_bounce.unlogged import unlogged

SPIN = 2 * math.pi * 10
"""The spin of the body [rad/s]: ten turns a second."""
DURATION = 0.5
"""The duration of the flight [s]."""
MODEL = """<mujoco>
  <option timestep="{timestep!r}" integrator="{integrator}" gravity="0 0 0">
    <flag energy="enable"/>
  </option>
  <worldbody>
    <body><freejoint/><geom type="box" size="0.05 0.1 0.025" mass="1"/></body>
  </worldbody>
</mujoco>"""
"""A brick whose edges are as 1 to 2 to 4; the change depends on no length and no mass."""


def energy_change(integrator: str, timestep: float) -> float:
    """Return the change of a brick's energy over itself, in half a second at ten turns a second.

    The brick starts to turn about the diagonal of its frame, so that it tumbles. The change is proportional
    to the spin squared and, but for RK4, to the step.

    Args:
        integrator: of MuJoCo, by its name in a model.
        timestep: [s].
    """
    model = mujoco.MjModel.from_xml_string(MODEL.format(timestep=timestep, integrator=integrator))
    data = mujoco.MjData(model)
    data.qvel[3:] = SPIN / math.sqrt(3)
    mujoco.mj_forward(model, data)
    before = data.energy[1]
    with unlogged():
        mujoco.mj_step(model, data, nstep=max(1, round(DURATION / timestep)))
    mujoco.mj_forward(model, data)
    return float(np.nan_to_num(data.energy[1] / before - 1, nan=math.inf))
