"""A coin tossed by DART: its cylinder on a box, as DART's collision detectors have no plane in common."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import dartpy
import numpy as np

from adapters.shared import THINNEST, by_name, friction_of, rows_at


@dataclass
class Dart:
    """DART with a collision detector; the floor has restitution 1, as DART multiplies the two."""

    name: str
    detector: str
    dt: float = 0.001

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set."""
        return {"thinnest": THINNEST, "floor": "BoxShape 20 m x 20 m x 1 m", "detector": self.detector}

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them."""
        world, body = self._world(scenario, friction_of(scenario))

        def state() -> tuple[Any, ...]:
            pose = body.getWorldTransform()
            q, spin = pose.quaternion(), pose.rotation().T @ body.getAngularVelocity()
            return body.getCOM(), body.getCOMLinearVelocity(), (q.w(), q.x(), q.y(), q.z()), spin

        return by_name(rows_at(times, self.dt, world.step, state))

    def _world(self, scenario: Any, friction: float) -> tuple[Any, Any]:
        """Return a new world and the coin in it; the origin of its frame is the geometric centre."""
        coin, release, world = scenario.coin, scenario.release, dartpy.simulation.World()
        world.setTimeStep(self.dt)
        world.setGravity([0, 0, -scenario.gravity])
        world.getConstraintSolver().setCollisionDetector(getattr(dartpy.collision, self.detector)())
        floor, made = dartpy.dynamics.Skeleton("floor"), dartpy.dynamics.Skeleton("coin")
        _, ground = floor.createWeldJointAndBodyNodePair()
        joint, body = made.createFreeJointAndBodyNodePair()
        cylinder = dartpy.dynamics.CylinderShape(coin.radius, max(coin.thickness, THINNEST))
        for owner, shape, height, restitution in (
            (ground, dartpy.dynamics.BoxShape([20, 20, 1]), -0.5, 1.0),
            (body, cylinder, 0.0, scenario.floor.restitution),
        ):
            node = owner.createShapeNode(shape)
            node.setRelativeTranslation([0, 0, height])
            node.createCollisionAspect()
            node.createDynamicsAspect()
            node.getDynamicsAspect().setRestitutionCoeff(restitution)
            node.getDynamicsAspect().setFrictionCoeff(friction)
        j, centre = np.asarray(coin.moments), np.asarray(coin.center_of_mass, float)
        body.setMass(coin.mass)
        body.setMomentOfInertia(*np.diag(j), j[0, 1], j[0, 2], j[1, 2])
        body.setLocalCOM(centre)
        world.addSkeleton(floor)
        world.addSkeleton(made)
        pose, spin = dartpy.math.Isometry3(), np.asarray(release.angular_velocity, float)
        pose.set_quaternion(dartpy.math.Quaternion(*release.attitude))
        turn = pose.rotation()
        pose.set_translation(np.asarray(release.position) - turn @ centre)
        joint.setTransform(pose)
        joint.setAngularVelocity(turn @ spin)
        joint.setLinearVelocity(np.asarray(release.velocity) - turn @ np.cross(spin, centre))
        return world, body


as_documented = Dart("DART 6.20.0, as documented", "FCLCollisionDetector")
tuned = Dart("DART 6.20.0, tuned", "OdeCollisionDetector")
