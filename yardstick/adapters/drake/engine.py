"""A coin tossed by Drake's MultibodyPlant."""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from math import log
from typing import Any

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import AddContactMaterial, Cylinder, HalfSpace, ProximityProperties
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import AddMultibodyPlant, CoulombFriction, MultibodyPlantConfig
from pydrake.multibody.tree import RotationalInertia, SpatialInertia
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder

from adapters.shared import THINNEST, by_name, friction_of

ALLOWANCE = 1e-3
"""How deep a body lies by default, MultibodyPlantConfig.penetration_allowance [m]."""


def dissipation(restitution: float, speed: float) -> float:
    """Return Hunt and Crossley's d [s/m] with which a point that hits at the speed has the restitution.

    With f = k x (1 + d v), a = d v before and b = d v after: a - ln(1 + a) = -b - ln(1 - b).
    """
    low, high = 0.0, min(1 / restitution if restitution else 1e3, 1e3)
    for _ in range(100):
        a = (low + high) / 2
        b = restitution * a
        low, high = (low, a) if b >= 1 or a - log(1 + a) + b + log(1 - b) < 0 else (a, high)
    return low / speed


@dataclass
class Drake:
    """Drake with point contact, its dissipation chosen for one speed; a continuous plant has an accuracy."""

    name: str
    plant: dict[str, str | float]
    accuracy: float = 0.0
    stiffness: float | None = None
    speed: float = 2.5
    dt: float = 0.001

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set; speed is that [m/s] of an impact with the scenario's restitution."""
        more = {"accuracy": self.accuracy, "point_stiffness": self.stiffness or "default"}
        return {"thinnest": THINNEST, "speed": self.speed} | more | self.plant

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them; NaN where Drake stops.

        A discrete plant is advanced to the middle of its step, so that rounding never adds or omits one.
        """
        plant, body, simulator = self._plant(scenario, friction_of(scenario))
        context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        centre, release = np.asarray(scenario.coin.center_of_mass, float), scenario.release
        turn = RotationMatrix(Quaternion(release.attitude / np.linalg.norm(release.attitude)))
        arm, spin = turn @ centre, turn @ np.asarray(release.angular_velocity)
        plant.SetFreeBodyPose(context, body, RigidTransform(turn, release.position - arm))
        start = SpatialVelocity(spin, release.velocity - np.cross(spin, arm))
        plant.SetFreeBodySpatialVelocity(context, body, start)
        rows, early = [], 0 if self.accuracy else 0.5
        with suppress(RuntimeError):
            for step in np.rint(np.asarray(list(times)) / self.dt).astype(int):
                if step:
                    simulator.AdvanceTo((step - early) * self.dt)
                pose = plant.EvalBodyPoseInWorld(context, body)
                motion = plant.EvalBodySpatialVelocityInWorld(context, body)
                turn, spin = pose.rotation(), motion.rotational()
                arm = turn @ centre
                q, v = turn.ToQuaternion().wxyz(), motion.translational() + np.cross(spin, arm)
                rows.append(np.hstack([pose.translation() + arm, v, q, turn.inverse() @ spin]))
        rows += [np.full(13, np.nan)] * (len(times) - len(rows))
        k = self.stiffness or scenario.coin.mass * scenario.gravity / ALLOWANCE
        return by_name(np.array(rows)) | {"stiffness": np.array(k)}

    def _plant(self, scenario: Any, friction: float) -> tuple[Any, Any, Simulator]:
        """Return the plant, the coin and the simulator; the body's frame lies in the geometric centre."""
        builder, coin = DiagramBuilder(), scenario.coin
        plant, _ = AddMultibodyPlant(MultibodyPlantConfig(**{"time_step": self.dt} | self.plant), builder)
        j = np.asarray(coin.moments)
        inertia = RotationalInertia(*np.diag(j), j[0, 1], j[0, 2], j[1, 2])
        mass = SpatialInertia.MakeFromCentralInertia(coin.mass, coin.center_of_mass, inertia)
        body, surface = plant.AddRigidBody("coin", mass), ProximityProperties()
        cylinder = Cylinder(coin.radius, max(coin.thickness, THINNEST))
        damping = dissipation(scenario.floor.restitution, self.speed)
        AddContactMaterial(surface, damping, self.stiffness, CoulombFriction(friction, friction))
        for owner, shape in ((plant.world_body(), HalfSpace()), (body, cylinder)):
            plant.RegisterCollisionGeometry(owner, RigidTransform(), shape, "surface", surface)
        plant.mutable_gravity_field().set_gravity_vector([0, 0, -scenario.gravity])
        plant.Finalize()
        simulator = Simulator(builder.Build())
        if self.accuracy:
            ResetIntegratorFromFlags(simulator, "runge_kutta3", self.dt)
            simulator.get_mutable_integrator().set_target_accuracy(self.accuracy)
        return plant, body, simulator


as_documented = Drake("Drake 1.51.1, as documented", {})
tuned = Drake("Drake 1.51.1, tuned", {"time_step": 0.0}, accuracy=1e-6, stiffness=1e6)
