"""A coin tossed by PhysX on the processor, as SAPIEN wraps it, without a renderer."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import sapien
from sapien import physx

from adapters.shared import THINNEST, by_name, friction_of, rows_at

UPRIGHT = (np.sqrt(0.5), 0, -np.sqrt(0.5), 0)


@dataclass
class Sapien:
    """PhysX with the settings that differ from SAPIEN's defaults, of the scene, the shapes and the coin.

    PhysX averages the restitutions (and frictions) of two shapes, so floor and coin have the same.
    """

    name: str
    scene: dict[str, float]
    shape: dict[str, float]
    body: dict[str, float]
    dt: float = 0.01

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set, and the least thickness [m]; SAPIEN's cylinder is a prism of 32 sides."""
        return {"thinnest": THINNEST, "sides": 32} | self.scene | self.shape | self.body

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them."""
        scene, coin = self._scene(scenario, friction_of(scenario))

        def state() -> tuple[Any, ...]:
            centre = coin.entity_pose * coin.cmass_local_pose
            turn = coin.entity_pose.to_transformation_matrix()[:3, :3].astype(float)
            return centre.p, coin.linear_velocity, coin.entity_pose.q, turn.T @ coin.angular_velocity

        return by_name(rows_at(times, self.dt, scene.step, state))

    def _scene(self, scenario: Any, friction: float) -> tuple[Any, Any]:
        """Return a new scene and the coin in it; the origin of its frame is the geometric centre."""
        coin, release, config = scenario.coin, scenario.release, physx.PhysxSceneConfig()
        config.gravity = np.array([0, 0, -scenario.gravity])
        _set(config, self.scene)
        physx.set_scene_config(config)
        scene = sapien.Scene([physx.PhysxCpuSystem()])
        scene.set_timestep(self.dt)
        material = physx.PhysxMaterial(friction, friction, scenario.floor.restitution)
        cylinder = (coin.radius, max(coin.thickness, THINNEST) / 2, material)
        made, ground = physx.PhysxRigidDynamicComponent(), physx.PhysxRigidStaticComponent()
        for owner, shape in (
            (ground, physx.PhysxCollisionShapePlane(material)),
            (made, physx.PhysxCollisionShapeCylinder(*cylinder)),
        ):
            shape.local_pose = sapien.Pose(q=UPRIGHT)
            _set(shape, self.shape)
            owner.attach(shape)
            scene.add_entity(sapien.Entity().add_component(owner))
        moments, axes = np.linalg.eigh(coin.moments)
        axes[:, 0] *= np.linalg.det(axes)
        frame = np.block([[axes, np.reshape(coin.center_of_mass, (3, 1))], [0, 0, 0, 1]])
        inertial = {"mass": coin.mass, "cmass_local_pose": sapien.Pose(frame), "inertia": moments}
        start = sapien.Pose(release.position, release.attitude)
        start *= sapien.Pose(-np.asarray(coin.center_of_mass))
        spin = start.to_transformation_matrix()[:3, :3] @ np.asarray(release.angular_velocity)
        motion = {"linear_velocity": release.velocity, "angular_velocity": spin}
        _set(made.entity, {"pose": start})
        _set(made, inertial | self.body | motion)
        return scene, made


def _set(owner: Any, values: dict[str, Any]) -> None:
    """Set the owner's attributes."""
    for name, value in values.items():
        setattr(owner, name, value)


DAMPED = {"angular_damping": 0.0, "max_angular_velocity": 1e6, "sleep_threshold": 0.0}
SOLVER = {"solver_position_iterations": 100, "solver_velocity_iterations": 10}
as_documented = Sapien("SAPIEN 3.0.3 (PhysX), as documented", {}, {}, {})
tuned = Sapien(
    "SAPIEN 3.0.3 (PhysX), tuned",
    {"bounce_threshold": 0.0},
    {"contact_offset": 1e-4},
    DAMPED | SOLVER,
    0.001,
)
