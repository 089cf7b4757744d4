"""Where MuJoCo's settings for a bounce fail: thin floors, bodies that a contact turns, pinched ones."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco

from cointoss_bounce import PairBounce, bounce
from cointoss_bounce.contact import ContactSettings
from cointoss_reproduction.setups.mujoco_models import FLOOR, model_of, rubbing_pair

BALL = 0.02
"""Radius of the ball that falls on a floor [m]."""
FALLS, FALLING = 10, 3.0
"""The number of falls, each at another phase of a step; the speed of a fall [m/s]."""
PINCH, PINCHED, MU = 20.0, 0.1, 1.0
"""Force of either plate on a body [N]; the body's mass [kg]; friction."""


def falls_through(contact: ContactSettings, thickness: float | None) -> int:
    """Return how many of `FALLS` balls go through a floor: a box of a thickness [m], or a plane."""
    floor = FLOOR
    if thickness is not None:
        floor = f'<geom type="box" size="1 1 {thickness / 2!r}" pos="0 0 {-thickness / 2!r}"/>'
    ball = f'<body><freejoint/><geom size="{BALL}" {contact.pasted()}/></body>'
    model = model_of(contact, floor + ball, 'gravity="0 0 0"')
    through = 0
    for number in range(FALLS):
        data = mujoco.MjData(model)
        data.qpos[2] = BALL + FALLING * contact.timestep * (2 + (number + 0.5) / FALLS)
        data.qvel[2] = -FALLING
        mujoco.mj_step(model, data, nstep=round(0.5 / FALLING / contact.timestep))
        through += int(data.qpos[2] < 0)
    return through


def leg(contact: ContactSettings) -> PairBounce:
    """Return how a hopper's leg bounces: a weight on a slide, a thigh and a shin on hinges.

    The slide leans by 0.0003, so that the leg is not thrown straight but as an impulse at the foot moves it.
    """
    body = (
        '<body pos="0 0 1"><joint type="slide" axis="0.0003 0 1"/><geom size="0.1" mass="3"/>'
        '<body euler="0 30 0"><joint axis="0 1 0"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.04" mass="1"/>'
        '<body pos="0 0 -0.4" euler="0 -60 0"><joint axis="0 1 0"/>'
        '<geom name="shin" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="0.5" '
        f"{contact.pasted()}/></body></body></body>"
    )
    return bounce(model_of(contact, FLOOR + body), "shin", "floor")


def cylinder(contact: ContactSettings, beside: float) -> PairBounce:
    """Return how a cylinder bounces that comes down flat on a ball, its axis beside the ball's middle [m]."""
    bodies = (
        f'<geom name="ball" size="0.1"/><body pos="{beside} 0 0.3"><freejoint/>'
        f'<geom name="cylinder" type="cylinder" size="0.1 0.05" {contact.pasted()}/></body>'
    )
    return bounce(model_of(contact, bodies), "cylinder", "ball")


def creep(contact: ContactSettings, option: str, pair: bool) -> float | None:
    """Return the speed at which a box creeps down between two plates that pinch it [m/s].

    None where it falls out of them within 2 s.

    Args:
        contact: of all three.
        option: further attributes of <option>.
        pair: whether the contacts are pairs whose slip has a damping of its own, -1/dt.
    """
    rough = f'friction="{MU}" {contact.geom}'
    plates = "".join(
        f'<body pos="{x} 0 1"><joint type="slide" axis="1 0 0"/>'
        f'<geom name="{name}" type="box" size="0.02 0.03 0.03" mass="0.1" {rough}/></body>'
        for name, x in (("left", -0.045), ("right", 0.045))
    )
    box = (
        '<body pos="0 0 1"><freejoint/>'
        f'<geom name="box" type="box" size="0.025 0.02 0.02" mass="{PINCHED}" {rough}/></body>'
    )
    pairs = "".join(rubbing_pair(contact, side, "box", MU) for side in ("left", "right"))
    model = model_of(contact, plates + box, option, f"<contact>{pairs}</contact>" if pair else "")
    data, heights = mujoco.MjData(model), []
    data.qfrc_applied[:2] = PINCH, -PINCH
    for _ in range(2):
        mujoco.mj_step(model, data, nstep=round(1 / contact.timestep))
        heights.append(float(data.qpos[4]))
    return heights[0] - heights[1] if heights[1] > 0.95 else None
