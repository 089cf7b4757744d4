"""Two geoms of a model, alone, set so that they come together at a speed."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import copy
from typing import Any

import mujoco
import numpy as np

from cointoss_bounce.arrays import Array
from cointoss_bounce.errors import FieldError
from cointoss_bounce.jacobian import jacobian_of
from cointoss_bounce.spring import end_of

FARTHEST = 1e3
"""Distance beyond which two geoms are not moved together [m]."""
TRIES = 200
"""Moves by which two geoms are brought to a distance."""
TURN = 0.2
"""The largest of these moves [m or rad]."""
CLOSED = 1e-10
"""Error of an equality constraint that is met [m or rad]."""
HELD = 1e-6
"""If two geoms approach at less than this part of a speed, equality constraints hold them."""
STRAIGHT = 1e-4
"""A body moves straight along a way if it leaves it, and turns, by less than this part of its motion."""


class Pair:
    """Two geoms of a model, alone, that joints bring together.

    Other geoms touch nothing. A geom whose joints let it move along the normal while no body turns approaches
    straight, with all that hangs on those joints. If neither can, the joints move as an impulse between the
    two geoms would move them. Bodies that active equality constraints couple move along. On a height field a
    body comes along the field's own z.
    """

    def __init__(self, model: mujoco.MjModel, one: int, two: int) -> None:
        """Set both geoms at a distance.

        Raises:
            FieldError: where no joint brings them together, or MuJoCo lets them pass through each other.
        """
        self.model = copy.copy(model)
        # MuJoCo before 3.4 has no sleep.
        self.model.opt.enableflags &= ~int(getattr(mujoco.mjtEnableBit, "mjENBL_SLEEP", 0))
        self.geoms = {one, two}
        others = np.array([number not in self.geoms for number in range(model.ngeom)])
        self.model.geom_contype[others] = 0
        self.model.geom_conaffinity[others] = 0
        ends = zip(model.pair_geom1, model.pair_geom2, strict=True)
        own = np.array([{int(first), int(second)} == self.geoms for first, second in ends], dtype=bool)
        self.model.pair_margin[~own] = -FARTHEST
        # MuJoCo adds the margins and the gaps of both geoms; those of a pair hold alone.
        of, where = ("pair", own) if own.any() else ("geom", [one, two])
        self.margin, self.gap = (
            float(getattr(model, f"{of}_{name}")[where].sum()) for name in ("margin", "gap")
        )
        self.one, self.two = one, two
        fields = [geom for geom in (one, two) if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_HFIELD]
        self.field = fields[0] if fields else None
        self.data, self.apart, self.spare = (mujoco.MjData(self.model) for _ in range(3))
        mujoco.mj_forward(self.model, self.data)
        bounds = [float(r) for r in self.model.geom_rbound[[one, two]] if r > 0]
        if not bounds:
            raise self._apart("at least one is no plane")
        self.size = min(bounds)
        self.free = [
            geom for geom in (one, two) if all(self._straight(geom, way) is not None for way in np.eye(3))
        ]
        self._close()
        if -self.margin > self.thinnest:
            raise self._apart(
                f"their margin is {self.margin:g} m, and the contact would push only from beyond the middle "
                "of the thinner one on"
            )
        # Below 0 a margin is the depth from which the contact pushes.
        self._bring_to(min(self.margin, 0.0) - 1e-3 * self.size)
        self.contact = self._contact()
        approach = self._bring_to(self.contact.includemargin + 1e-3 * self.size)
        self.start = self.data.qpos.copy()
        self.data.qvel[:] = approach
        mujoco.mj_forward(self.model, self.data)
        self.turning = round(float(np.linalg.norm(self.data.cvel[:, :3], axis=1).max()), 3)
        _, self.normal, point = self._nearest()
        self.soft = self._soft(self._row(self.normal, point))

    @property
    def thinnest(self) -> float:
        """Half of the thickness of the thinner geom, where it is thinnest; a plane has none [m]."""
        planes = int(mujoco.mjtGeom.mjGEOM_PLANE)
        halves = [self.model.geom_aabb[g, 3:].min() for g in self.geoms if self.model.geom_type[g] != planes]
        return float(min(halves))

    def set_apart(self, speed: float, steps: float) -> None:
        """Set the geoms so many steps before they touch, so that they then come together at a speed [m/s].

        What accelerates them meanwhile is taken into account as a constant acceleration.
        """
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] = self.start
        mujoco.mj_forward(self.model, self.data)
        duration, margin = steps * self.model.opt.timestep, self.contact.includemargin
        approach = self._bring_to(margin + speed * duration)
        forced, acceleration = self.acceleration(speed * approach)
        gained = duration * acceleration
        rk4 = self.model.opt.integrator == int(mujoco.mjtIntegrator.mjINT_RK4)
        # Integrators but RK4 have the velocity of half a step before.
        late = 0.0 if rk4 else forced * self.model.opt.timestep / 2
        gap, before = (speed - gained / 2) * duration, speed - gained - late
        if gap > 0:
            approach = self._bring_to(margin + gap)
        else:
            before = speed
        self.data.qvel[:] = before * approach
        mujoco.mj_forward(self.model, self.data)

    def touches(self) -> dict[int, Any]:
        """Return the active contacts between both geoms, by number."""
        return {number: contact for number, contact in self._between() if contact.efc_address >= 0}

    def has_passed(self) -> bool:
        """Return whether the geoms, which do not touch, are on the wrong sides of each other."""
        return (
            float(self._nearest()[1] @ self.normal) < 0 if self.field is None else self._over_field()[2] < 0
        )

    def push(self, touches: dict[int, Any]) -> float:
        """Return the normal force of some contacts [N]."""
        force, total = np.zeros(6), 0.0
        for number in touches:
            mujoco.mj_contactForce(self.model, self.data, number, force)
            total += force[0]
        return total

    def _between(self) -> list[tuple[int, Any]]:
        """Return the contacts between both geoms, with their numbers."""
        if not self.data.ncon:
            return []
        pairs = np.sort(self.data.contact.geom, axis=1)
        return [(int(n), self.data.contact[n]) for n in np.flatnonzero((pairs == sorted(self.geoms)).all(1))]

    def _contact(self) -> Any:
        """Return a contact of both geoms where they overlap."""
        for _, contact in self._between():
            return copy.copy(contact)
        raise self._apart("MuJoCo lets them pass (contype and conaffinity, exclude, or parent and child)")

    def _bring_to(self, distance: float) -> Array:
        """Bring the geoms to a distance [m]; return the velocity that brings them nearer at 1 m/s, (nv,)."""
        for _ in range(TRIES):
            found, normal, point = self._nearest()
            thrown = self.thrown(normal)
            approach = self._approach(thrown, self._row(normal, point))
            missing = distance - found
            if abs(missing) < 1e-9 * self.size:
                return approach
            move = -missing * approach
            move *= min(1.0, TURN / np.abs(move).max()) if thrown is None else 1.0
            mujoco.mj_integratePos(self.model, self.data.qpos, move, 1.0)
            mujoco.mj_forward(self.model, self.data)
            self._close()
        raise self._apart("no joint brings them together from where the model starts")

    def _close(self) -> None:
        """Move the joints to where the equality constraints are met, as far as they can be."""
        for _ in range(TRIES):
            errors = self.data.efc_pos[: self.data.ne]
            if np.abs(errors).max(initial=0.0) < CLOSED:
                return
            move = -self._by_equalities(errors)
            mujoco.mj_integratePos(self.model, self.data.qpos, move, 1.0)
            mujoco.mj_forward(self.model, self.data)
            if np.abs(move).max() < CLOSED:
                return

    def _by_equalities(self, change: Array) -> Array:
        """Return the least generalised velocity that changes the equality constraints so, (nv,)."""
        rows = np.zeros((self.data.ne, self.model.nv))
        for row, unit in zip(rows, np.eye(self.data.ne, self.data.nefc), strict=True):
            mujoco.mj_mulJacTVec(self.model, self.data, row, unit)
        by_force = np.zeros_like(rows)
        mujoco.mj_solveM(self.model, self.data, by_force, rows)
        return by_force.T @ np.linalg.lstsq(rows @ by_force.T, change)[0]

    def _nearest(self) -> tuple[float, Array, Array]:
        """Return the distance [m], the normal from the second geom to the first, and a point between."""
        if self.field is not None:
            return self._above_field()
        ends = np.zeros(6)
        distance = mujoco.mj_geomDistance(self.model, self.data, self.one, self.two, FARTHEST, ends)
        way = ends[3:] - ends[:3]
        length = np.linalg.norm(way)
        if distance >= FARTHEST:
            raise self._apart(f"they are further apart than {FARTHEST:g} m")
        if length < 1e-12:
            way = self.data.geom_xpos[self.two] - self.data.geom_xpos[self.one]
            length, distance = np.linalg.norm(way), abs(distance)
        sign = -1.0 if distance >= 0 else 1.0
        return float(distance), sign * way / length, (ends[:3] + ends[3:]) / 2

    def _over_field(self) -> tuple[int, Array, float]:
        """Return the geom over the height field, the field's z, and how high the geom's middle is [m]."""
        other = self.two if self.field == self.one else self.one
        up = self.data.geom_xmat[self.field].reshape(3, 3)[:, 2].copy()
        return other, up, float(up @ (self.data.geom_xpos[other] - self.data.geom_xpos[self.field]))

    def _above_field(self) -> tuple[float, Array, Array]:
        """Return the same above a height field, along its z, to which MuJoCo measures no distance."""
        other, up, height = self._over_field()
        place = self.data.geom_xpos[other].copy()
        size = self.model.hfield_size[self.model.geom_dataid[self.field]]
        reach = float(self.model.geom_rbound[other])

        def overlaps(lowered: float) -> bool:
            self.data.geom_xpos[other] = place - lowered * up
            mujoco.mj_collision(self.model, self.data)
            return any(contact.dist <= 0 for _, contact in self._between())

        reached = overlaps(height)
        inside = end_of(lambda lowered: not overlaps(lowered), height - size[2] - 2 * reach, height)
        mujoco.mj_forward(self.model, self.data)
        if not reached:
            raise self._apart("MuJoCo lets them pass, or the one is not above the height field")
        return inside, up if other == self.one else -up, place - inside * up

    def thrown(self, normal: Array) -> tuple[int, Array] | None:
        """Return the geom that comes nearer straight, at 1 m/s, and by which generalised velocity, (nv,).

        It is that on a free body, where one is.
        """
        ways = {self.one: -normal, self.two: normal}
        found = ((geom, self._straight(geom, ways[geom])) for geom in (*self.free, *ways))
        return next(((geom, velocity) for geom, velocity in found if velocity is not None), None)

    def _straight(self, geom: int, way: Array) -> Array | None:
        """Return the generalised velocity by which a geom moves, not the other, and no body turns, (nv,).

        Of several that by the joints nearest to the world, which moves the most; None where there is none.
        """
        own, other = (self._moves(self.model.geom_bodyid[number]) for number in (geom, *self.geoms - {geom}))
        chain = np.unique(self.model.dof_bodyid[own.any(axis=0)])
        rows = np.vstack([own[:3], *(self._moves(body)[3:] for body in chain)]) * ~other.any(axis=0)
        asked = np.pad(way, (0, 3 * len(chain)))
        for body in chain:
            upper = rows * (self.model.dof_bodyid <= body)
            velocity = np.linalg.lstsq(upper, asked)[0]
            if np.abs(upper @ velocity - asked).max() < STRAIGHT:
                return velocity
        return None

    def _moves(self, body: int) -> Array:
        """Return the Jacobian of a body's velocity, and below it that of its angular velocity, (6, nv)."""
        jacobian = np.zeros((6, self.model.nv))
        mujoco.mj_jacBody(self.model, self.data, jacobian[:3], jacobian[3:], body)
        return jacobian

    def _approach(self, thrown: tuple[int, Array] | None, row: Array) -> Array:
        """Return the generalised velocity by which the geoms come nearer at 1 m/s."""
        if thrown is not None:
            velocity = thrown[1]
        else:
            velocity = np.zeros(self.model.nv)
            mujoco.mj_solveM(self.model, self.data, velocity[None], row[None])
            response = row @ velocity
            if response < 1e-12 / max(self.model.body_mass.sum(), 1e-12):
                raise self._apart("no joint brings them together")
            velocity /= -response
        if self.data.ne:
            rates = np.zeros(self.data.nefc)
            mujoco.mj_mulJacVec(self.model, self.data, rates, velocity)
            velocity -= self._by_equalities(rates[: self.data.ne])
            nearer = -(row @ velocity)
            if nearer < HELD:
                raise self._apart("equality constraints hold them where they are")
            velocity /= nearer
        return velocity

    def acceleration(self, velocity: Array) -> tuple[float, float]:
        """Return by how much the speed at which the geoms come nearer grows at a velocity, (nv,) [m/s²].

        Both the forces on the joints and the turning of the bodies contribute.
        """
        _, normal, point = self._nearest()
        self.data.qvel[:] = velocity
        mujoco.mj_forward(self.model, self.data)
        row, change = self._row(normal, point), self._row(normal, point, mujoco.mj_jacDot)
        forced = -float(row @ self.data.qacc)
        total = forced - float(change @ velocity)
        self.data.qvel[:] = 0
        mujoco.mj_forward(self.model, self.data)
        return forced, total

    def _soft(self, row: Array) -> tuple[str, ...]:
        """Return the equality constraints and tendons that pull back when the geoms are pushed apart.

        Args:
            row: Jacobian of the speed at which both geoms part, (nv,).
        """
        velocity = np.zeros(self.model.nv)
        mujoco.mj_solveM(self.model, self.data, velocity[None], row[None])
        self.data.qvel[:] = velocity / (row @ velocity)
        mujoco.mj_forward(self.model, self.data)
        moved = np.abs(self.data.efc_vel[: self.data.ne]) > HELD
        equalities = sorted({int(number) for number in self.data.efc_id[: self.data.ne][moved]})
        tendon = self.model
        pulls = (tendon.tendon_stiffness != 0) | (tendon.tendon_damping != 0) | (tendon.tendon_limited != 0)
        tendons = np.flatnonzero(pulls & (np.abs(self.data.ten_velocity) > HELD))
        return (
            *(f"equality {self.model.equality(number).name or number}" for number in equalities),
            *(f"tendon {self.model.tendon(number).name or number}" for number in tendons),
        )

    def _row(self, normal: Array, point: Array, of: Any = mujoco.mj_jac) -> Array:
        """Return the Jacobian of the speed at which both geoms part, or its rate of change, (nv,)."""
        bodies = self.model.geom_bodyid[[self.one, self.two]]
        one, two = (jacobian_of(self.model, self.data, point, body, of) for body in bodies)
        return normal @ (one - two)

    def _apart(self, why: str) -> FieldError:
        names = [self.model.geom(geom).name or str(geom) for geom in (self.one, self.two)]
        return FieldError("geoms", " and ".join(names), f"two geoms that touch: {why}")
