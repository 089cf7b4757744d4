"""A coin tossed by Rapier: its cylinder on a half space, in single precision."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import rapier3d as rapier

from adapters.shared import THINNEST, by_name, friction_of, rows_at


def _xyz(vector: Any) -> np.ndarray:
    """Return Rapier's vector as an array."""
    return np.array([vector.x, vector.y, vector.z])


def _matrix(turn: Any) -> np.ndarray:
    """Return Rapier's rotation as a matrix."""
    return np.array(turn.to_matrix(), float).reshape(3, 3)


@dataclass
class Rapier:
    """Rapier with the settings that differ from the defaults, of its world and the coin.

    Rapier averages the restitutions (and frictions) of two colliders, so floor and coin have the same.
    """

    name: str
    world: dict[str, float]
    body: dict[str, float]
    dt: float = 1 / 60

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set, and the least thickness [m]."""
        return {"thinnest": THINNEST} | self.world | self.body

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them."""
        world, handle = self._world(scenario, friction_of(scenario))
        body = world.rigid_bodies[handle]

        def state() -> tuple[Any, ...]:
            q, turn = body.rotation, _matrix(body.rotation)
            x, spin = _xyz(body.translation) + turn @ scenario.coin.center_of_mass, turn.T @ _xyz(body.angvel)
            return x, _xyz(body.linvel), (q.w, q.i, q.j, q.k), spin

        return by_name(rows_at(times, self.dt, world.step, state))

    def _world(self, scenario: Any, friction: float) -> tuple[Any, Any]:
        """Return a new world and the coin's handle; the origin of its frame is the geometric centre."""
        coin, release = scenario.coin, scenario.release
        world = rapier.PhysicsWorld((0.0, 0.0, -scenario.gravity))
        for name, value in ({"dt": self.dt} | self.world).items():
            setattr(world.integration_parameters, name, value)
        moments = np.diag(coin.moments)
        if np.any(coin.moments != np.diag(moments)):
            raise NotImplementedError(f"coin.moments: {coin.moments}, accepted: a diagonal matrix")
        turn = rapier.Rotation3(*map(float, release.attitude))
        matrix, centre = _matrix(turn), np.asarray(coin.center_of_mass, float)
        mass = rapier.MassProperties(tuple(centre), coin.mass, tuple(moments))
        origin = np.asarray(release.position) - matrix @ centre
        builder = rapier.RigidBody.dynamic().additional_mass_properties(mass)
        builder = builder.position(rapier.Isometry3(tuple(origin), turn))
        builder = builder.linvel(tuple(map(float, release.velocity)))
        builder = builder.angvel(tuple(matrix @ np.asarray(release.angular_velocity)))
        for name, value in self.body.items():
            builder = getattr(builder, name)(value)
        cylinder = rapier.Collider.cylinder(max(coin.thickness, THINNEST) / 2, coin.radius).density(0.0)
        floor, cylinder = (
            shape.restitution(scenario.floor.restitution).friction(friction)
            for shape in (
                rapier.Collider.halfspace((0.0, 0.0, 1.0)),
                cylinder.rotation((np.pi / 2, 0.0, 0.0)),
            )
        )
        world.add_collider(floor)
        return world, world.add_body(builder, [cylinder])


as_documented = Rapier("Rapier 0.36.1, as documented", {}, {})
tuned = Rapier(
    "Rapier 0.36.1, tuned",
    {"length_unit": 0.01, "normalized_max_linear_velocity": 1e5},
    {"can_sleep": False, "allow_fast_rotation": True},
    0.001,
)
