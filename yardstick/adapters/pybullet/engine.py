"""A coin tossed by PyBullet: Bullet's cylinder on Bullet's plane."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pybullet as bullet

from adapters.shared import THINNEST, by_name, friction_of, rows_at

ROUGH = 10.0


def _state(coin: int) -> tuple[np.ndarray, ...]:
    """Return position, velocity, quaternion, body-frame spin and the rotation matrix."""
    (x, q), (v, spin) = bullet.getBasePositionAndOrientation(coin), bullet.getBaseVelocity(coin)
    turn = np.array(bullet.getMatrixFromQuaternion(q)).reshape(3, 3)
    return np.array(x), np.array(v), np.array([q[3], *q[:3]]), turn.T @ np.array(spin), turn


@dataclass
class PyBullet:
    """PyBullet with the settings that differ from the defaults, of its world and of its two bodies.

    Bullet multiplies the restitutions (and frictions) of two bodies, so the floor has 1.
    """

    name: str
    world: dict[str, float]
    body: dict[str, float]
    maximal: bool = False
    dt: float = 1 / 240

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set, and the least thickness [m]."""
        return {"useMaximalCoordinates": self.maximal, "thinnest": THINNEST} | self.world | self.body

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them."""
        coin = self._coin(scenario, friction_of(scenario, rough=ROUGH))
        rows = rows_at(times, self.dt, bullet.stepSimulation, lambda: _state(coin)[:4])
        bullet.disconnect()
        return by_name(rows)

    def _coin(self, scenario: Any, friction: float) -> int:
        """Return the number of the coin in a new world."""
        coin, release = scenario.coin, scenario.release
        moments, flags = np.diag(coin.moments), {"useMaximalCoordinates": self.maximal}
        if np.any(coin.moments != np.diag(moments)):
            raise NotImplementedError(f"coin.moments: {coin.moments}, accepted: a diagonal matrix")
        bullet.connect(bullet.DIRECT)
        bullet.setGravity(0, 0, -scenario.gravity)
        bullet.setPhysicsEngineParameter(fixedTimeStep=self.dt, **self.world)
        floor = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE), **flags)
        bullet.changeDynamics(floor, -1, restitution=1, lateralFriction=1, **self.body)
        size = {"radius": coin.radius, "height": max(coin.thickness, THINNEST)}
        offset = list(-np.asarray(coin.center_of_mass))
        shape = bullet.createCollisionShape(bullet.GEOM_CYLINDER, collisionFramePosition=offset, **size)
        turned = [*release.attitude[1:], release.attitude[0]]
        made = bullet.createMultiBody(coin.mass, shape, -1, list(release.position), turned, **flags)
        body = {"restitution": scenario.floor.restitution, "lateralFriction": friction} | self.body
        bullet.changeDynamics(made, -1, mass=coin.mass, localInertiaDiagonal=list(moments), **body)
        spin = _state(made)[4] @ np.asarray(release.angular_velocity)
        bullet.resetBaseVelocity(made, list(release.velocity), list(spin))
        return made


WORLD = {"restitutionVelocityThreshold": 0, "erp": 0, "contactERP": 0}
BODY = {"linearDamping": 0, "angularDamping": 0, "contactProcessingThreshold": 0, "collisionMargin": 1e-6}
as_documented = PyBullet("PyBullet 3.2.7, as documented", {}, {})
tuned = PyBullet("PyBullet 3.2.7, tuned", WORLD, BODY | {"maxJointVelocity": 1e9}, dt=0.001)
maximal = PyBullet("PyBullet 3.2.7, tuned, maximal coordinates", WORLD, BODY, True, 0.001)
