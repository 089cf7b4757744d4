"""The points at which two geoms touch first, and their motion at the instants at which they meet and part."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from typing import Any, NamedTuple

import mujoco
import numpy as np

from cointoss_bounce.approach import Pair
from cointoss_bounce.arrays import Array
from cointoss_bounce.jacobian import jacobian_of
from cointoss_bounce.states import copied

SHARE = 0.1
"""A speed may differ at the touch by this part from the speed asked for and from that within a step."""


class Instant(NamedTuple):
    """The motion at the instant at which the points that touch first meet, or part."""

    speed: float
    """The mean speed at which the points part [m/s]."""
    energy: float
    """The kinetic energy of the whole model [J]."""
    is_coarse: bool
    """Whether the speed differs by more than `SHARE` from that of the state within a step."""


class Points:
    """Where both bodies touched first: points that stay with them, and the normals, which stay in space."""

    def __init__(self, pair: Pair, touches: list[Any]) -> None:
        """Take the contacts between both geoms, at their first touch, that overlap the most."""
        self.model, self.spare = pair.model, pair.spare
        self.bodies = [int(pair.model.geom_bodyid[geom]) for geom in (pair.one, pair.two)]
        gaps = np.array([contact.dist - contact.includemargin for contact in touches])
        # What overlaps by less came later: corners of a tilted box, edges between the prisms of a field.
        first = gaps <= gaps.min() / 2
        touches = [contact for contact, chosen in zip(touches, first, strict=True) if chosen]
        # MuJoCo's normal leads from the first geom of the contact to the second.
        signs = [-1.0 if int(contact.geom[0]) == pair.one else 1.0 for contact in touches]
        self.normals = np.array([s * c.frame[:3] for s, c in zip(signs, touches, strict=True)])
        at = np.array([contact.pos for contact in touches])
        self.places = [
            (at - pair.data.xpos[body]) @ pair.data.xmat[body].reshape(3, 3) for body in self.bodies
        ]
        self.overlap = float(gaps[first].mean())

    def at_touch(self, apart: mujoco.MjData, overlapping: float) -> Instant:
        """Return the motion where the points' gap is 0, within a step of a state in which they are apart.

        It is that at the state's acceleration; without constraints, where the points turn about in this step.
        Integrators but RK4 have the q̇ of half a step before a state.

        Args:
            apart: the state.
            overlapping: the speed of the points on the other side of the gap, a step before or after [m/s].
        """
        model, step = self.model, float(self.model.opt.timestep)
        rk4 = model.opt.integrator == int(mujoco.mjtIntegrator.mjINT_RK4)
        there = copied(model, apart, self.spare)
        mujoco.mj_step(model, there)
        row, gap, speed = self._row(apart), self.gap(apart), self.speed(apart)
        # RK4's step may meet the contact; the others' implicit damping takes less than their q̈ says.
        change = apart.qacc if rk4 else (there.qvel - apart.qvel) / step
        if not overlapping * speed > 0:
            change = apart.qacc_smooth
        velocity = apart.qvel + (0.0 if rk4 else step / 2) * change
        now = float(row @ velocity)
        then = math.copysign(math.sqrt(max(now**2 - 2 * gap * float(row @ change), 0.0)), speed)
        time = -gap / math.copysign(max(abs(now + then) / 2, abs(gap) / step), speed)
        there.qpos[:], there.qvel[:] = apart.qpos, velocity + time * change
        mujoco.mj_integratePos(model, there.qpos, velocity + time / 2 * change, time)
        mujoco.mj_fwdPosition(model, there)
        mujoco.mj_energyVel(model, there)
        found = self.speed(there)
        allowed = SHARE * abs(found) + 2 * step * gravity_in(model)
        return Instant(found, float(there.energy[1]), abs(found - speed) > allowed)

    def speed(self, data: mujoco.MjData) -> float:
        """Return the mean speed at which the points part [m/s]."""
        return float(self._row(data) @ data.qvel)

    def gap(self, data: mujoco.MjData) -> float:
        """Return how far the points have parted, in the mean, from where the geoms touch [m]."""
        one, two = self._now(data)
        return float(np.einsum("ij,ij->i", self.normals, one - two).mean()) + self.overlap

    def _row(self, data: mujoco.MjData) -> Array:
        """Return the mean row of the points' Jacobian along the normals, (nv,)."""
        one, two = (
            [jacobian_of(self.model, data, point, body) for point in points]
            for body, points in zip(self.bodies, self._now(data), strict=True)
        )
        return np.einsum("ij,ijk->k", self.normals, np.subtract(one, two)) / len(self.normals)

    def _now(self, data: mujoco.MjData) -> list[Array]:
        """Return the points of each body in the space frame, each (n, 3) [m]."""
        return [
            data.xpos[body] + places @ data.xmat[body].reshape(3, 3).T
            for body, places in zip(self.bodies, self.places, strict=True)
        ]


def gravity_in(model: mujoco.MjModel) -> float:
    """Return the gravity [m/s²]."""
    return float(np.linalg.norm(model.opt.gravity))
