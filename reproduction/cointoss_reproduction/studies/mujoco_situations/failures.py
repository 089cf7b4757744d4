"""Where MuJoCo's settings for a bounce fail: thin floors, bodies that a contact turns, pinched ones."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco

from cointoss.coin_mj import PairBounce, bounce
from cointoss.study import ContactSettings

BALL = 0.02
"""Radius of the ball that falls on a floor [m]."""
FALLS, SPEED = 10, 3.0
"""At as many phases of a step; at a speed [m/s]."""
PINCH, PINCHED, MU = 20.0, 0.1, 1.0
"""Force of either plate on a body [N]; the body's mass [kg]; friction."""


def falls_through(contact: ContactSettings, thickness: float | None) -> int:
    """Return how many of `FALLS` balls go through a floor: a box of a thickness [m], or a plane."""
    floor = '<geom type="plane" size="0 0 1"/>'
    if thickness is not None:
        floor = f'<geom type="box" size="1 1 {thickness / 2!r}" pos="0 0 {-thickness / 2!r}"/>'
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco>{contact.option}<worldbody>{floor}<body><freejoint/>"
        f'<geom size="{BALL}" condim="1" priority="1" {contact.geom}/></body></worldbody></mujoco>'
    )
    model.opt.gravity[:] = 0
    through = 0
    for number in range(FALLS):
        data = mujoco.MjData(model)
        data.qpos[2] = BALL + SPEED * contact.timestep * (2 + (number + 0.5) / FALLS)
        data.qvel[2] = -SPEED
        mujoco.mj_step(model, data, nstep=round(0.5 / SPEED / contact.timestep))
        through += data.qpos[2] < 0
    return int(through)


def leg(contact: ContactSettings) -> PairBounce:
    """Return how a hopper's leg bounces: a weight on a slide, a thigh and a shin on hinges."""
    return bounce(
        mujoco.MjModel.from_xml_string(
            f"<mujoco>{contact.option}<worldbody>"
            '<geom name="floor" type="plane" size="0 0 1"/>'
            '<body pos="0 0 1"><joint type="slide" axis="0 0 1"/><geom size="0.1" mass="3"/>'
            '<body euler="0 30 0"><joint axis="0 1 0"/>'
            '<geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.04" mass="1"/>'
            '<body pos="0 0 -0.4" euler="0 -60 0"><joint axis="0 1 0"/>'
            '<geom name="shin" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="0.5" '
            f'condim="1" priority="1" {contact.geom}/>'
            "</body></body></body></worldbody></mujoco>"
        ),
        "shin",
        "floor",
    )


def cylinder(contact: ContactSettings, beside: float) -> PairBounce:
    """Return how a cylinder bounces that comes down flat on a ball, its axis beside the ball's middle [m]."""
    return bounce(
        mujoco.MjModel.from_xml_string(
            f'<mujoco>{contact.option}<worldbody><geom name="ball" size="0.1"/>'
            f'<body pos="{beside} 0 0.3"><freejoint/><geom name="cylinder" type="cylinder" size="0.1 0.05" '
            f'condim="1" priority="1" {contact.geom}/></body></worldbody></mujoco>'
        ),
        "cylinder",
        "ball",
    )


def creep(contact: ContactSettings, option: str, pair: bool) -> float | None:
    """Return the speed at which a box creeps down between two plates that pinch it [m/s].

    None where it falls out of them within 2 s.

    Args:
        contact: of all three.
        option: further attributes of <option>.
        pair: whether the contacts are pairs whose slip has a damping of its own, -1/dt.
    """
    plate = (
        '<body name="{0}" pos="{1} 0 1"><joint type="slide" axis="1 0 0"/>'
        f'<geom name="{{0}}" type="box" size="0.02 0.03 0.03" mass="0.1" friction="{MU}" '
        f"{contact.geom}/></body>"
    )
    damping = f'friction="{MU} {MU} 0 0 0" solreffriction="0 {-1 / contact.timestep!r}"'
    pairs = "".join(
        f'<pair geom1="{side}" geom2="box" condim="3" {damping} {contact.geom}/>'
        for side in ("left", "right")
    )
    opening = contact.option.replace("<option ", f"<option {option} ")
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco>{opening}<worldbody>{plate.format('left', -0.045)}{plate.format('right', 0.045)}"
        '<body pos="0 0 1"><freejoint/><geom name="box" type="box" size="0.025 0.02 0.02" '
        f'mass="{PINCHED}" friction="{MU}" {contact.geom}/></body></worldbody>'
        f"{f'<contact>{pairs}</contact>' if pair else ''}</mujoco>"
    )
    data, heights = mujoco.MjData(model), []
    data.qfrc_applied[:2] = PINCH, -PINCH
    for _ in range(2):
        mujoco.mj_step(model, data, nstep=round(1 / contact.timestep))
        heights.append(float(data.qpos[4]))
    return heights[0] - heights[1] if heights[1] > 0.95 else None
