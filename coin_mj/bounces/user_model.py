"""A model of the user's own: loaded, and two of its geoms set to touch each other alone."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import copy
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from cointoss.coin_mj.bounces.unlogged import unlogged
from cointoss.models.errors import FieldError
from cointoss.models.records import Array

FARTHEST = 1e3
"""Distance beyond which two geoms are not moved together [m]."""
TRIES = 200
"""Moves by which two geoms are brought to a distance."""
TURN = 0.2
"""The largest of these moves [m or rad]."""


def load_model(path: Path | str) -> mujoco.MjModel:
    """Return the model of an XML file, which MuJoCo's loader reads, with the files that it names.

    Raises:
        FieldError: naming the file and why it does not load.
    """
    if not Path(path).is_file():
        raise FieldError("model", str(path), "an XML file of MuJoCo that exists")
    try:
        with unlogged():
            return mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, mujoco.FatalError) as error:
        why = "; ".join(line.strip() for line in str(error).splitlines() if line.strip())
        raise FieldError("model", str(path), f"an XML file that MuJoCo loads ({why})") from None


def geom_of(model: mujoco.MjModel, name: str) -> int:
    """Return the number of a geom, given its name or its number.

    Raises:
        FieldError: naming what was given and the geoms that exist.
    """
    found = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name)
    if found < 0 and name.isascii() and name.isdigit() and int(name) < model.ngeom:
        found = int(name)
    if found < 0:
        known = [model.geom(number).name or str(number) for number in range(min(model.ngeom, 12))]
        more = ", ..." if model.ngeom > len(known) else ""
        raise FieldError("geom", name, f"a geom of the model, by name or number: {', '.join(known)}{more}")
    return found


class Pair:
    """Two geoms of a model, alone, that one joint or a free body brings together.

    Other geoms touch nothing. A geom on a free body comes straight along the normal, without turning; where
    neither geom is on one, the joints move as an impulse between the two geoms would move them.
    """

    def __init__(self, model: mujoco.MjModel, one: int, two: int) -> None:
        """Set both geoms at a distance.

        Raises:
            FieldError: where no joint brings them together, or MuJoCo lets them pass through each other.
        """
        self.model = copy.copy(model)
        self.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        self.geoms = {one, two}
        others = np.array([number not in self.geoms for number in range(model.ngeom)])
        self.model.geom_contype[others] = 0
        self.model.geom_conaffinity[others] = 0
        for number in range(model.npair):
            if {int(model.pair_geom1[number]), int(model.pair_geom2[number])} != self.geoms:
                self.model.pair_margin[number] = -FARTHEST
        self.one, self.two = one, two
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.size = float(min(r for r in self.model.geom_rbound[[one, two]] if r > 0) or 1.0)
        self._bring_to(-1e-3 * self.size)
        self.contact = self._contact()
        self._bring_to(self.contact.includemargin + 1e-3 * self.size)
        self.start = self.data.qpos.copy()

    def set_apart(self, gap: float, speed: float) -> None:
        """Set the geoms a gap before they touch [m], at a speed toward each other [m/s]."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] = self.start
        mujoco.mj_forward(self.model, self.data)
        approach = self._bring_to(self.contact.includemargin + gap)
        self.data.qvel[:] = speed * approach
        mujoco.mj_forward(self.model, self.data)

    def touches(self) -> list[Any]:
        """Return the active contacts between both geoms."""
        return [
            contact
            for contact in self.data.contact
            if {int(contact.geom[0]), int(contact.geom[1])} == self.geoms and contact.efc_address >= 0
        ]

    def distance(self) -> float:
        """Return the signed distance of both geoms [m]."""
        return float(mujoco.mj_geomDistance(self.model, self.data, self.one, self.two, FARTHEST, np.zeros(6)))

    def push(self) -> float:
        """Return the normal force between both geoms [N]."""
        force, total = np.zeros(6), 0.0
        for number, contact in enumerate(self.data.contact):
            if {int(contact.geom[0]), int(contact.geom[1])} == self.geoms and contact.efc_address >= 0:
                mujoco.mj_contactForce(self.model, self.data, number, force)
                total += force[0]
        return total

    def _contact(self) -> Any:
        """Return a contact of both geoms where they overlap."""
        for contact in self.data.contact:
            if {int(contact.geom[0]), int(contact.geom[1])} == self.geoms:
                return copy.copy(contact)
        raise self._apart("MuJoCo lets them pass (contype and conaffinity, exclude, or parent and child)")

    def _bring_to(self, distance: float) -> Array:
        """Bring the geoms to a distance [m]; return the velocity that brings them nearer at 1 m/s, (nv,)."""
        for _ in range(TRIES):
            found, normal, point = self._nearest()
            approach = self._approach(normal, point)
            missing = distance - found
            if abs(missing) < 1e-9 * self.size:
                return approach
            move = -missing * approach
            move *= min(1.0, TURN / np.abs(move).max()) if not self._free() else 1.0
            mujoco.mj_integratePos(self.model, self.data.qpos, move, 1.0)
            mujoco.mj_forward(self.model, self.data)
        raise self._apart("no joint brings them together")

    def _nearest(self) -> tuple[float, Array, Array]:
        """Return the distance [m], the normal from the second geom to the first, and a point between."""
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

    def _approach(self, normal: Array, point: Array) -> Array:
        """Return the generalised velocity by which the geoms come nearer at 1 m/s."""
        velocity = np.zeros(self.model.nv)
        free = self._free()
        if free is not None:
            dof, sign = free
            velocity[dof : dof + 3] = -sign * normal
            return velocity
        row = normal @ (self._jacobian(self.one, point) - self._jacobian(self.two, point))
        mujoco.mj_solveM(self.model, self.data, velocity[None], row[None])
        response = row @ velocity
        if response < 1e-12 / max(self.model.body_mass.sum(), 1e-12):
            raise self._apart("no joint brings them together")
        return -velocity / response

    def _free(self) -> tuple[int, float] | None:
        """Return the first coordinate of the free joint that moves a geom, and that geom's side."""
        bodies = [int(self.model.body_rootid[self.model.geom_bodyid[geom]]) for geom in (self.one, self.two)]
        if bodies[0] == bodies[1]:
            return None
        for body, sign in zip(bodies, (1.0, -1.0), strict=True):
            joint = int(self.model.body_jntadr[body])
            if joint >= 0 and self.model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
                return int(self.model.jnt_dofadr[joint]), sign
        return None

    def _jacobian(self, geom: int, point: Array) -> Array:
        """Return the Jacobian of a point of a geom's body, (3, nv)."""
        jacobian = np.zeros((3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, jacobian, None, point, self.model.geom_bodyid[geom])
        return jacobian

    def _apart(self, why: str) -> FieldError:
        names = [self.model.geom(geom).name or str(geom) for geom in (self.one, self.two)]
        return FieldError("geoms", " and ".join(names), f"two geoms that touch: {why}")
