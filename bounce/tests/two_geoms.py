"""Models of MuJoCo in which a ball meets another geom."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np

from cointoss_bounce.recipe import recipe_of

DT = 2e-3
HARD = recipe_of(0.8, DT)
SET = f'{HARD.geom} condim="1" priority="1"'
ALONG_AXES = [f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1")]
FLOOR = '<geom name="a" type="plane" size="1 1 1"/>'


def ball(more, place="0 0 1", size=0.1):
    return f'<body pos="{place}"><freejoint/><geom name="b" size="{size}" {more}/></body>'


def model(bodies, integrator="implicitfast", more=""):
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" integrator="{integrator}"/>'
        f"<worldbody>{bodies}</worldbody>{more}</mujoco>"
    )


def rebound(built, radius, height):
    """Return √(h'/h) of a ball that is dropped from rest at a height over a plane."""
    data, highest = mujoco.MjData(built), 0.0
    data.qpos[2] = radius + height
    while data.qvel[2] <= 0:
        mujoco.mj_step(built, data)
    while data.qvel[2] > 0:
        highest = data.qpos[2] - radius
        mujoco.mj_step(built, data)
    return (highest / height) ** 0.5


def thrown(built, v, middle, start=1.0):
    """Yield what 60 plain steps without gravity make of a body, by phase.

    Args:
        built: the model; its third coordinate is a height.
        v: the speed, downward [m/s].
        middle: the height at which the body touches [m].
        start: its height in the model [m].
    """
    built.opt.gravity[:] = 0
    for phase in (np.arange(8) + 0.5) / 8:
        data = mujoco.MjData(built)
        data.qpos[2] += middle + (2 + phase) * v * built.opt.timestep - start
        data.qvel[2] = -v
        mujoco.mj_step(built, data, nstep=60)
        yield data
