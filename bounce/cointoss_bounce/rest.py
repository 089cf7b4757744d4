"""The rest of a body on a plane: its depth, and whether it hops or sinks."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from cointoss_bounce.bodies import BALL, FlatBody
from cointoss_bounce.contact import ContactSettings
from cointoss_bounce.jacobian import jacobian_of
from cointoss_bounce.unlogged import unlogged

STEPS = 20_000
"""A body that can come to rest has done so after this number of steps."""
LOOKED_AT = STEPS // 4
"""The last of them."""
FALL = 50.0
"""Speed of the fall before, over g dt."""
STILL = 1e-3
"""A body that moves by less than this part of g dt² in the last quarter of the steps lies still."""
HOP = 0.05
"""A body that rises by less than this part of its depth then does not hop."""


def depth_at_rest(contact: ContactSettings, body: FlatBody = BALL) -> float:
    """Return how deep a body lies by theory, flat on a plane [m]: infinite where nothing holds it.

    A contact i carries the force k x m_i/(1 - d), m_i = 1/(J_i M⁻¹ J_iᵀ) the mass that it meets, so that
    x = (1 - d) g/k m/Σ m_i. m/Σ m_i is 1 where a body touches under its mass centre alone, 1/4 to 7/4 for a
    box, 1/3 to 5/3 for an upright cylinder. Without the flag diagexact MuJoCo takes m for each m_i.

    Args:
        contact: the settings, of a stiffness and a damping, with the gravity.
        body: it lies flat.
    """
    stiffness, impedance = -contact.solref[0], float(contact.solimp.split()[0])
    if stiffness == 0:
        return math.inf
    model = body.compiled(contact, body.height * (1 - 1e-6))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    masses = [model.body_mass[1]] * data.ncon
    if contact.exact:
        masses = [1 / _response(model, data, touch) for touch in data.contact]
    return (1 - impedance) * contact.gravity / stiffness * model.body_mass[1] / sum(masses)


def _response(model: mujoco.MjModel, data: mujoco.MjData, touch: Any) -> float:
    """Return J M⁻¹ Jᵀ of a contact of the body and the plane [1/kg]."""
    row, moved = touch.frame[:3] @ jacobian_of(model, data, touch.pos, 1), np.zeros((1, model.nv))
    mujoco.mj_solveM(model, data, moved, row[None])
    return float(row @ moved[0])


@dataclass(frozen=True, kw_only=True)
class Rest:
    """The rest of a body under its own weight; under n times its weight it lies or sinks n times as deep."""

    depth: float
    """The depth in the plane, in the mean over the last quarter of the steps [m]."""
    hop: float
    """Rise from its lowest to its highest position then, without what it sinks [m]; 0 where it is still."""
    sinking: float
    """The mean speed at which the body sinks [m/s]; 0 where it lies still."""


def rest_of(contact: ContactSettings, body: FlatBody = BALL) -> Rest:
    """Let a body fall on a plane, and measure what it does when its bounces have ended.

    The fall is 50 steps' worth of gravity fast and 20,000 steps are made, whatever the step, so that what is
    found scales with g dt².

    Args:
        contact: the settings, with the gravity.
        body: it comes down flat.
    """
    dt, gravity = contact.timestep, contact.gravity
    model = body.compiled(contact, body.height)
    data = mujoco.MjData(model)
    data.qvel[2] = -FALL * gravity * dt
    last, times = np.empty(LOOKED_AT), dt * np.arange(LOOKED_AT)
    with unlogged():
        mujoco.mj_step(model, data, nstep=STEPS - LOOKED_AT)
        for step in range(LOOKED_AT):
            mujoco.mj_step(model, data)
            last[step] = body.height - data.qpos[2]
    sinking, start = np.polyfit(times, last, 1)
    hop, depth = float(np.ptp(last - sinking * times - start)), float(last.mean())
    still = STILL * gravity * dt**2
    return Rest(
        depth=depth,
        hop=hop if hop > max(still, HOP * depth) else 0.0,
        sinking=float(sinking) if abs(sinking) * times[-1] > still else 0.0,
    )
