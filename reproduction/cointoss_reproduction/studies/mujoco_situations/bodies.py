"""Bodies that stand in a stack, hit each other, slide and fall, by MuJoCo's settings for a bounce."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np

from cointoss.study import Array
from cointoss_bounce.contact import ContactSettings
from cointoss_bounce.drops import PHASES, SPEED
from cointoss_reproduction.setups.mujoco_models import RECIPE, model_of, sliding_ball

STACK = (0.1, 0.1, 0.1, 0.1, 10.0)
"""Masses of boxes, from below [kg]."""
RADIUS = 0.1
"""The radius of the balls [m]."""


def stack(contact: ContactSettings, condim: int) -> tuple[float, float]:
    """Return how deep the uppermost of five boxes is after 40 s [m], and how fast it sinks then [m/s].

    Every geom has the line that is printed, with a condim; a depth of more than a tenth of a box: the stack
    has fallen. The flag diagexact takes the mass that a corner meets: without it a stack lies less deep.

    Args:
        contact: the settings.
        condim: 1 as printed, without friction; 3 with MuJoCo's own.
    """
    boxes = "".join(
        f'<body pos="0 0 {0.05 + 0.1 * number}"><freejoint/>'
        f'<geom type="box" size="0.05 0.05 0.05" mass="{mass}" {contact.pasted(condim)}/></body>'
        for number, mass in enumerate(STACK)
    )
    model = model_of(contact, f'<geom type="plane" size="0 0 1" {contact.pasted(condim)}/>{boxes}')
    data, heights = mujoco.MjData(model), []
    for duration in (30, 10):
        mujoco.mj_step(model, data, nstep=round(duration / contact.timestep))
        heights.append(float(data.qpos[-5]))
    return 0.05 + 0.1 * (len(STACK) - 1) - heights[1], (heights[0] - heights[1]) / 10


def ball(place: float, contact: ContactSettings) -> str:
    """Return a ball of 1 kg that slides along x."""
    return (
        f'<body pos="{place} 0 0"><joint type="slide" axis="1 0 0"/>'
        f'<geom size="{RADIUS}" mass="1" condim="1" {contact.geom}/></body>'
    )


def rod(contact: ContactSettings) -> str:
    """Return a rod of 10 kg, 1 m long, hinged at one end, that a ball may hit at the other."""
    return (
        '<body pos="0.3 0 1"><joint type="hinge" axis="0 1 0"/>'
        '<inertial pos="0 0 -0.5" mass="10" diaginertia="0.83333333 0.83333333 0.001"/>'
        f'<geom type="capsule" fromto="0 0 0 0 0 -1.2" size="0.05" condim="1" {contact.geom}/></body>'
    )


def hits(contact: ContactSettings, bodies: str) -> Array:
    """Return the velocities of bodies, the first of which came at 1 m/s, when no more of them touch."""
    model = model_of(contact, bodies, 'gravity="0 0 0"')
    data = mujoco.MjData(model)
    data.qvel[0] = 1.0
    mujoco.mj_step(model, data, nstep=round(1 / contact.timestep))
    return data.qvel.copy()


def sliding(
    contact: ContactSettings, friction: float, slip: float, option: str = RECIPE
) -> tuple[float, float]:
    """Return the errors of the restitution and of the slip of a ball that slides.

    A ball of 10 cm comes down at `SPEED` on a `<pair>` with Coulomb friction: the slip of a solid ball ends
    at max(0, slip - 7/2 μ (1 + e) v).

    Returns:
        Largest |e' - e|, and largest error of the slip over `SPEED`, over 16 phases of a step.
    """
    e, errors = 0.8, []
    model = sliding_ball(contact, RADIUS, friction, option)
    for number in range(PHASES):
        data = mujoco.MjData(model)
        data.qpos[2] = RADIUS + SPEED * contact.timestep * (2 + (number + 0.5) / PHASES)
        data.qvel[:3] = slip, 0.0, -SPEED
        while data.qvel[2] < 0 or data.qpos[2] < RADIUS:
            mujoco.mj_step(model, data)
        after = max(0.0, slip - 3.5 * friction * (1 + e) * SPEED)
        found = data.qvel[0] - RADIUS * data.qvel[4]
        errors.append((abs(data.qvel[2] / SPEED - e), abs(found - after) / SPEED))
    worst = np.max(errors, axis=0)
    return float(worst[0]), float(worst[1])


def falling_balls(contact: ContactSettings, duration: float = 10.0) -> float:
    """Return the change of energy, over itself, of SimBenchmark's 49 balls of 10 kg that fall on a plane."""
    balls = "".join(
        f'<body pos="{2 * i} {2 * j} {1.5 + 0.1 * (i + j)}"><freejoint/>'
        f'<geom size="0.5" mass="10" condim="1" priority="1" {contact.geom}/></body>'
        for i in range(7)
        for j in range(7)
    )
    model = model_of(contact, f'<geom type="plane" size="0 0 1" condim="1"/>{balls}')
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data, energies = mujoco.MjData(model), []
    for steps in (0, round(duration / contact.timestep)):
        mujoco.mj_step(model, data, nstep=steps)
        mujoco.mj_forward(model, data)
        energies.append(float(data.energy.sum()) - 49 * 10 * 9.81 * 0.5)
    return energies[1] / energies[0] - 1
