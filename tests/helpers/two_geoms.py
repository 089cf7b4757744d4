"""Models of MuJoCo in which a ball meets another geom."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco

from cointoss.coin_mj.bounces.recipe import recipe_of

DT = 2e-3
HARD = recipe_of(0.8, DT)
SET = f'{HARD.geom} condim="1" priority="1"'
FLOOR = '<geom name="a" type="plane" size="1 1 1"/>'


def ball(more, place="0 0 1", size=0.1):
    return f'<body pos="{place}"><freejoint/><geom name="b" size="{size}" {more}/></body>'


def model(bodies, integrator="implicitfast", more=""):
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" integrator="{integrator}"/>'
        f"<worldbody>{bodies}</worldbody>{more}</mujoco>"
    )
