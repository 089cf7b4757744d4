"""The restitution between two geoms of a user's own model, over speed and the phase of the step."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from cointoss.coin_mj.bounces.contact import INTEGRATORS
from cointoss.coin_mj.bounces.unlogged import unlogged
from cointoss.coin_mj.bounces.user_model import Pair, geom_of, load_model
from cointoss.models.errors import FieldError
from cointoss.models.records import Array

SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
"""At which the geoms come together [m/s]."""
PHASES = 8
"""Of the touch between two steps."""
LONGEST = 4000
"""A contact that goes on for more steps is no rebound."""
LOOKED_AT, SLOW, LYING = 10, 1e-3, 10
"""Geoms slower than this part of their speed at every tenth step, ten times in turn, lie on each other."""
MISSED = 60
"""Geoms that have not touched after so many steps have passed through each other."""


@dataclass(frozen=True, kw_only=True)
class PairBounce:
    """How two geoms of a model bounce off each other."""

    geoms: tuple[str, str]
    timestep: float
    """[s]."""
    integrator: str
    solref: tuple[float, float]
    """Of their contact, as MuJoCo mixes it."""
    solimp: str
    condim: int
    friction: float
    speeds: Array = field(default_factory=lambda: np.array(SPEEDS))
    """[m/s], (n,)."""
    restitutions: Array
    """Without gravity: the normal speed of the points that touched first, after over before, (n, `PHASES`).
    0 where the geoms do not part; NaN where they pass through each other or the model becomes unstable."""
    with_gravity: Array
    """Likewise, under the model's gravity."""
    durations: Array
    """For which the geoms push, without gravity [s], (n, `PHASES`)."""
    depths: Array
    """The greatest, without gravity [m], (n,)."""


def bounce(model: mujoco.MjModel | Path | str, one: str, two: str) -> PairBounce:
    """Return how two geoms of a model bounce off each other, by plain `mj_step` and the model's own options.

    Other geoms are kept out of it. A geom on a free body comes straight along the normal of the contact,
    without turning; where neither geom is on one, the joints move as an impulse between both would move them.
    All else of the model acts: its joints, springs, actuators and limits. Nothing is written.

    Args:
        model: of MuJoCo, or the path of its XML.
        one: a geom, by its name or number.
        two: another.

    Raises:
        ValueError: naming what does not load, exist or touch, and what is accepted.
    """
    loaded = model if isinstance(model, mujoco.MjModel) else load_model(model)
    first, second = geom_of(loaded, one), geom_of(loaded, two)
    if first == second:
        raise FieldError("geoms", f"{one} and {two}", "two different geoms")
    with unlogged():
        pair = Pair(loaded, first, second)
        touch = pair.contact
        gravity = pair.model.opt.gravity.copy()
        pair.model.opt.gravity[:] = 0
        free = _touches(pair)
        pair.model.opt.gravity[:] = gravity
        pulled = _touches(pair)
    return PairBounce(
        geoms=(one, two),
        timestep=float(pair.model.opt.timestep),
        integrator=INTEGRATORS[pair.model.opt.integrator],
        solref=(float(touch.solref[0]), float(touch.solref[1])),
        solimp=" ".join(f"{number:.12g}" for number in touch.solimp),
        condim=int(touch.dim),
        friction=float(touch.friction[0]),
        restitutions=free[..., 0],
        with_gravity=pulled[..., 0],
        durations=free[..., 1],
        depths=free[..., 2].max(axis=1),
    )


def _touches(pair: Pair) -> Array:
    """Return restitution, duration and depth of every touch, (speeds, phases, 3)."""
    return np.array([[_touch(pair, speed, (n + 0.5) / PHASES) for n in range(PHASES)] for speed in SPEEDS])


def _touch(pair: Pair, speed: float, phase: float) -> tuple[float, float, float]:
    """Return restitution, duration [s] and depth [m] of one touch."""
    model, data = pair.model, pair.data
    pair.set_apart(speed * model.opt.timestep * (2 + phase), speed)
    weightless = not model.opt.gravity.any()
    points: _Points | None = None
    before, pushing, depth, slow = math.nan, 0, 0.0, 0
    for step in range(LONGEST):
        velocity = data.qvel.copy()
        mujoco.mj_step(model, data)
        touches = pair.touches()
        if any(warning.number for warning in data.warning) or (points is None and step > MISSED):
            return math.nan, math.nan, depth
        if touches and points is None:
            points = _Points(pair, touches)
            first = float(np.mean([contact.dist - contact.includemargin for contact in touches]))
            before = points.speed_at_touch(pair, -points.speed(pair, velocity), first)
        if points is None:
            continue
        depth = max([depth, *(-float(contact.dist) for contact in touches)])
        pushed = pair.push() > 0
        pushing += pushed
        if pushed and pushing % LOOKED_AT == 0:
            slow = slow + 1 if abs(points.speed(pair, data.qvel)) < SLOW * speed else 0
        if slow == LYING:
            break
        if pushed or not pushing or (touches and not weightless):
            continue
        mujoco.mj_forward(model, data)
        after = points.speed(pair, data.qvel)
        if after > 0 or points.gap(pair) > 0:
            apart = pair.distance() - pair.contact.includemargin
            return points.speed_at_touch(pair, after, apart) / before, pushing * model.opt.timestep, depth
        if not touches:
            return math.nan, math.nan, depth
    return 0.0, pushing * model.opt.timestep, depth


class _Points:
    """Where both bodies touched first: points that stay with them, and the normals."""

    def __init__(self, pair: Pair, touches: list[Any]) -> None:
        self.bodies = [int(pair.model.geom_bodyid[geom]) for geom in (pair.one, pair.two)]
        self.normals, self.places = [], []
        for contact in touches:
            # MuJoCo's normal leads from the first geom of the contact to the second.
            sign = -1.0 if int(contact.geom[0]) == pair.one else 1.0
            self.normals.append(sign * contact.frame[:3])
            self.places.append(
                [
                    pair.data.xmat[body].reshape(3, 3).T @ (contact.pos - pair.data.xpos[body])
                    for body in self.bodies
                ]
            )

    def speed_at_touch(self, pair: Pair, speed: float, distance: float) -> float:
        """Return the speed that the points have where the geoms touch, at constant acceleration [m/s].

        Args:
            pair: with what accelerates it without contact.
            speed: at a distance [m/s].
            distance: from the touch [m].
        """
        acceleration = self.speed(pair, pair.data.qacc_smooth)
        return math.sqrt(max(speed**2 - 2 * acceleration * distance, 0.0))

    def speed(self, pair: Pair, velocity: Array) -> float:
        """Return the mean speed at which the points part [m/s], with the kinematics in `pair.data`."""
        total = 0.0
        for normal, body, point, side in self._now(pair):
            jacobian = np.zeros((3, pair.model.nv))
            mujoco.mj_jac(pair.model, pair.data, jacobian, None, point, body)
            total += side * float(normal @ (jacobian @ velocity))
        return total / len(self.normals)

    def gap(self, pair: Pair) -> float:
        """Return how far the points have parted, in the mean [m]; below 0 where the geoms went through."""
        parts = [side * float(normal @ point) for normal, _, point, side in self._now(pair)]
        return sum(parts) / len(self.normals)

    def _now(self, pair: Pair) -> Iterator[tuple[Array, int, Array, float]]:
        """Yield each point with its normal, its body, its place in the space frame, and its side."""
        for normal, places in zip(self.normals, self.places, strict=True):
            for body, place, side in zip(self.bodies, places, (1.0, -1.0), strict=True):
                point = pair.data.xpos[body] + pair.data.xmat[body].reshape(3, 3) @ place
                yield normal, body, point, side
