"""The rest of a geom on another in a user's model, after the bounces: whether it lies still."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np

from cointoss_bounce.approach import Pair
from cointoss_bounce.arrays import Array
from cointoss_bounce.jacobian import jacobian_of
from cointoss_bounce.rest import HOP, LOOKED_AT, STEPS, STILL

FALL = 10.0
"""Speed at which the geoms come together, over what presses them together times dt."""
SLOPE = 0.01
"""The slope on which the slip is measured, or half of the friction where that is less."""
SINK = 0.01
"""A geom that sinks by less than this part of its depth, in the steps that are looked at, does not sink."""
EVERY = 5
"""Steps between two measurements of the geoms: an odd number, because some geoms hop every other step."""
SLIDING, AVERAGED = 2000, 500
"""Steps on the slope, and the last of them, over which the slip is averaged."""


@dataclass(frozen=True, kw_only=True)
class PairRest:
    """The motion of a geom on another under the model's gravity, over the last 5000 of 20,000 steps."""

    depth: float
    """The greatest depth of a contact, in the mean over the steps [m]."""
    hop: float
    """Rise along the normal from its lowest to its highest position, without what it sinks [m]; while they
    touch, that of the deepest contact where it is less; 0 for less than a twentieth of the depth."""
    sinking: float
    """The mean speed along the normal into the other [m/s]; 0 where that is less than a hundredth of the
    depth in that time, below 0 where it rises."""
    drift: float
    """The mean speed along the other's surface, under the model's gravity as it is [m/s]."""
    rocking: float
    """The largest angle between two attitudes, without turns about the normal [rad]; 0 where it rolls."""
    rolls: bool
    """Whether it turns and moves on along the other, rather than to and fro."""
    slope: float
    """The slope on which `slip` was measured: tangential over normal gravity; 0 where it was not."""
    slip: float
    """The mean speed at which the points that touch slip on that slope [m/s]; NaN where not measured, or
    where the geoms part within 2000 steps."""


class _Pose(NamedTuple):
    """Where the moving geom is, as the other sees it, and how deep it is in it."""

    place: Array
    """(3,) [m]."""
    attitude: Array
    """(3, 3)."""
    depth: float
    """0 where the geoms do not touch [m]."""


def rest_between(pair: Pair) -> PairRest | str:
    """Let one geom come to rest on the other under the model's gravity; return what it does, or why not.

    The geoms come together at 10 steps' worth of what presses them together, and 20,000 steps are made.
    Then gravity is tilted along the other's surface, and the slip of the points that touch is measured.
    """
    model, data, dt = pair.model, pair.data, float(pair.model.opt.timestep)
    mujoco.mj_resetData(model, data)
    data.qpos[:] = pair.start
    mujoco.mj_forward(model, data)
    pressing = pair.acceleration(np.zeros(model.nv))[0]
    if pressing <= 1e-6 * float(np.linalg.norm(model.opt.gravity)):
        both = "both are on free bodies, which fall alike: put the lower one on the world"
        return both if len(pair.free) > 1 else "nothing presses the geoms together where they touch"
    pair.set_apart(FALL * pressing * dt, 1.0)
    mujoco.mj_step(model, data, nstep=STEPS - LOOKED_AT)
    (moving, other), poses = _moving_first(pair), []
    for _ in range(LOOKED_AT // EVERY):
        mujoco.mj_step(model, data, nstep=EVERY)
        poses.append(_pose(pair, moving, other))
    if any(warning.number for warning in data.warning):
        return "the model becomes unstable"
    if not any(pose.depth for pose in poses):
        return f"the geoms do not touch any more after {STEPS} steps"
    away = pair.normal if moving == pair.one else -pair.normal
    still, normal = STILL * pressing * dt**2, data.geom_xmat[other].reshape(3, 3).T @ away
    places = np.array([pose.place for pose in poses])
    along, depths = places @ normal, np.array([pose.depth for pose in poses])
    # While they touch, the middle of a geom that turns rises and sinks, and its deepest contact changes.
    heights = min((along, -depths) if depths.all() else (along,), key=np.ptp)
    times = EVERY * dt * np.arange(len(poses))
    rise, start = np.polyfit(times, heights, 1)
    hop, depth = float(np.ptp(heights - rise * times - start)), float(depths.mean())
    hop = hop if hop > max(still, HOP * depth) else 0.0
    steps = np.diff(places - along[:, None] * normal, axis=0)
    drift, path = float(np.linalg.norm(steps.sum(axis=0))), float(np.linalg.norm(steps, axis=1).sum())
    rocking = _rocking(np.array([pose.attitude for pose in poses]), normal)
    turns = rocking * pair.size > still
    rolls = turns and drift > max(still, path / 2)
    slope = _slope(pair) if max(hop, drift) <= still else 0.0
    return PairRest(
        depth=depth,
        hop=hop,
        sinking=-float(rise) if abs(rise) * times[-1] > max(still, SINK * depth) else 0.0,
        drift=drift / float(times[-1]) if drift > still else 0.0,
        rocking=rocking if turns and not rolls else 0.0,
        rolls=rolls,
        slope=slope,
        slip=_slip(pair, slope) if slope else math.nan,
    )


def _moving_first(pair: Pair) -> tuple[int, int]:
    """Return the geom that moves, and that on which it lies: the one that is not thrown, or a plane."""
    thrown = pair.thrown(pair.normal)
    one_moves = thrown[0] == pair.one if thrown else pair.model.geom_rbound[pair.one] > 0
    return (pair.one, pair.two) if one_moves else (pair.two, pair.one)


def _pose(pair: Pair, moving: int, other: int) -> _Pose:
    data = pair.data
    frame = data.geom_xmat[other].reshape(3, 3)
    return _Pose(
        frame.T @ (data.geom_xpos[moving] - data.geom_xpos[other]),
        frame.T @ data.geom_xmat[moving].reshape(3, 3),
        max((-float(contact.dist) for contact in pair.touches().values()), default=0.0),
    )


def _rocking(attitudes: Array, normal: Array) -> float:
    """Return the largest angle by which the axis that was the normal at first leans from it [rad].

    Args:
        attitudes: (n, 3, 3).
        normal: (3,).
    """
    axes = attitudes @ (attitudes[0].T @ normal)
    return float(np.arctan2(np.linalg.norm(np.cross(axes, normal), axis=1), axes @ normal).max())


def _slope(pair: Pair) -> float:
    """Return the slope on which a slip is measured; 0 without friction, or where no free body lies."""
    held = pair.contact.dim > 1 and pair.free and pair.touches()
    return min(SLOPE, float(pair.contact.friction[0]) / 2) if held else 0.0


def _slip(pair: Pair, slope: float) -> float:
    """Tilt gravity about the contact, and return the mean slip of the points that touch [m/s]."""
    model, data = pair.model, pair.data
    frame, level = next(iter(pair.touches().values())).frame.copy(), model.opt.gravity.copy()
    model.opt.gravity[:] = level + slope * abs(float(level @ frame[:3])) * frame[3:6]
    mujoco.mj_step(model, data, nstep=SLIDING - AVERAGED)
    slips = []
    for _ in range(AVERAGED // EVERY):
        mujoco.mj_step(model, data, nstep=EVERY)
        slips.append(_slip_now(pair))
    model.opt.gravity[:] = level
    return float(np.mean(slips))


def _slip_now(pair: Pair) -> float:
    """Return the mean speed at which the points that touch slip [m/s]; NaN where none touches."""
    model, data, found = pair.model, pair.data, []
    for contact in pair.touches().values():
        bodies = model.geom_bodyid[[pair.one, pair.two]]
        one, two = (jacobian_of(model, data, contact.pos, body) for body in bodies)
        found.append(float(np.linalg.norm(contact.frame[3:].reshape(2, 3) @ ((one - two) @ data.qvel))))
    return float(np.mean(found)) if found else math.nan
