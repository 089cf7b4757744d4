"""What restitution bodies of other mass and shape get from `mj_step` and MuJoCo's contact settings."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from cointoss.study import Array
from cointoss_bounce.contact import GRAVITY, ContactSettings
from cointoss_bounce.drops import LONGEST, PHASES, SPEED
from cointoss_reproduction.setups.mujoco_models import model_of

SIZE = 0.1
"""The size of the bodies [m]."""
BODY = 1
"""Number of the body and of its geom; the world and its plane come first."""


@dataclass(frozen=True)
class Shape:
    """A body that comes down without spin."""

    geom: str
    """Attributes of its geom."""
    tilt: str = "0 0 0"
    """Euler angles [deg]."""
    center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """C, where it is not in the middle [m]; the moment of inertia is a ball's then."""


_BOX = f'type="box" size="{SIZE} {2 * SIZE} {SIZE / 2}"'
SHAPES = {
    "ball": Shape(f'type="sphere" size="{SIZE}"'),
    "ball, C off its middle": Shape(f'type="sphere" size="{SIZE}"', center=(0.04, 0.0, 0.03)),
    "box on a corner": Shape(_BOX, tilt="35 25 0"),
    "box on an edge": Shape(_BOX, tilt="0 30 0"),
    "cylinder on its rim": Shape(f'type="cylinder" size="{SIZE} {SIZE / 5}"', tilt="30 0 0"),
    "box flat": Shape(_BOX),
    "box flat, C off its middle": Shape(_BOX, center=(0.04, 0.06, 0.0)),
}


@dataclass(frozen=True, kw_only=True)
class Touch(ContactSettings):
    """Settings of a contact, with what touches there."""

    speculative: bool = False
    """The flag of this name: contacts that would come within the step act at its beginning."""
    mass: float = 1.0
    """The mass of the body [kg]."""
    body: str = 'priority="1"'
    """More attributes of the body's geom."""
    plane: str = ""
    """More attributes of the plane's geom."""


@dataclass(frozen=True)
class BodyRebounds:
    """What bodies did that touched anywhere between two steps."""

    restitutions: Array
    """The restitution of each point that touched first, (`PHASES`, points); 0 where a body did not leave."""
    depth: float
    """The greatest depth over `SPEED` [s]."""


def rebounds(shape: Shape, touch: Touch) -> BodyRebounds:
    """Let a body come down with `SPEED`, without weight, in every phase of a step."""
    drops = [_drop(shape, touch, (number + 0.5) / PHASES) for number in range(PHASES)]
    return BodyRebounds(np.array([drop[0] for drop in drops]), max(drop[1] for drop in drops) / SPEED)


def resting_depth(touch: Touch) -> float:
    """Return how deep a ball lies in the floor under its weight [m]."""
    model = _model(SHAPES["ball"], touch)
    model.opt.gravity[2] = -GRAVITY
    data = mujoco.MjData(model)
    data.qpos[2] = SIZE
    mujoco.mj_step(model, data, nstep=20 * LONGEST)
    return float(SIZE - data.qpos[2])


def _model(shape: Shape, touch: Touch) -> mujoco.MjModel:
    inertial = ""
    if any(shape.center):
        moment, (x, y, z) = 0.4 * touch.mass * SIZE**2, shape.center
        moments = f'mass="{touch.mass}" diaginertia="{moment} {moment} {moment}"'
        inertial = f'<inertial pos="{x} {y} {z}" {moments}/>'
    model = model_of(
        touch,
        f'<geom type="plane" size="0 0 1" condim="1" {touch.plane}/>'
        f'<body euler="{shape.tilt}"><freejoint/>{inertial}'
        f'<geom {shape.geom} mass="{touch.mass}" condim="1" {touch.geom} {touch.body}/></body>',
        'gravity="0 0 0"',
    )
    model.opt.enableflags |= touch.speculative * int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    return model


def _drop(shape: Shape, touch: Touch, phase: float) -> tuple[Array, float]:
    """Return the restitution of each point that touches first, and the greatest depth [m]."""
    model = _model(shape, touch)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    data.qpos[2] = -_corners(model, data)[:, 2].min() + SPEED * touch.timestep * (2 + phase)
    data.qvel[2] = -SPEED
    mujoco.mj_forward(model, data)
    corners = _corners(model, data)
    low = corners[corners[:, 2] < corners[:, 2].min() + 1e-9 * SIZE]
    points = (low - data.xpos[BODY]) @ data.xmat[BODY].reshape(3, 3)
    depth, touched = 0.0, False
    for _ in range(LONGEST):
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        depth = max(depth, -_corners(model, data)[:, 2].min())
        pressed = bool(data.nefc) and data.efc_force.max() > 1e-9 * touch.mass * SPEED / touch.timestep
        touched = touched or pressed or data.ncon > 0
        # A speculative contact first lets the body come to the floor.
        if touched and not pressed and (data.qvel[2] > 0 or not touch.speculative):
            return np.array([_rise(model, data, point) for point in points]) / SPEED, depth
    return np.zeros(len(points)), depth


def _rise(model: Any, data: Any, point: Array) -> float:
    """Return the vertical velocity of a point of the body, (3,) in its frame [m/s]."""
    jacobian = np.zeros((3, model.nv))
    place = data.xpos[BODY] + data.xmat[BODY].reshape(3, 3) @ point
    mujoco.mj_jac(model, data, jacobian, None, place, BODY)
    return float((jacobian @ data.qvel)[2])


def _corners(model: Any, data: Any) -> Array:
    """Return the points of the body's shape that may be lowest, space frame, (n, 3) [m]."""
    kinds, turn, size = mujoco.mjtGeom, data.geom_xmat[BODY].reshape(3, 3), model.geom_size[BODY]
    kind, up = model.geom_type[BODY], turn[2]
    if kind == kinds.mjGEOM_SPHERE:
        return data.geom_xpos[BODY] - [[0.0, 0.0, size[0]]]
    if kind == kinds.mjGEOM_BOX:
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        return data.geom_xpos[BODY] + signs * size @ turn.T
    level = np.array([-up[0], -up[1]]) / np.hypot(up[0], up[1]) * size[0]
    return data.geom_xpos[BODY] + [[*level, side * size[1]] for side in (-1, 1)] @ turn.T
