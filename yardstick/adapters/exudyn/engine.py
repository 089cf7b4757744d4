"""A coin tossed by Exudyn: its rims carry spheres that touch the floor, a triangle.

Exudyn has no contact of a cylinder. The spheres' centres lie on the rims, and the triangle lies a sphere's
radius below the floor, so that a rim touches where the coin's does; friction acts that far below the floor.
"""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import SensorNode
from exudyn.rigidBodyUtilities import EulerParameters2RotationMatrix, RigidBodyInertia

from adapters.shared import friction_of

WIDE = 1e3
OUTPUTS = ("CoordinatesTotal", "Velocity", "AngularVelocityLocal")


def _sensor(node: Any, output: str) -> SensorNode:
    """Return a sensor that keeps the node's output."""
    kind = getattr(exudyn.OutputVariableType, output)
    return SensorNode(nodeNumber=node, outputVariableType=kind, storeInternal=True, writeToFile=False)


@dataclass
class Exudyn:
    """Exudyn's implicit trapezoidal rule, spheres on each rim, their contact, and a step within dt."""

    name: str
    spheres: int
    contact: dict[str, float]
    step: float = 0.0
    dt: float = 0.01

    @property
    def settings(self) -> dict[str, str | float]:
        """Return what is set; without friction the spheres' radius is 5 cm, with friction 1 mm."""
        return {"spheres on a rim": self.spheres, "step [s]": self.step or "dt"} | self.contact

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them; NaN where it stops."""
        steps = np.rint(np.asarray(list(times)) / self.dt).astype(int)
        system, node = self._system(scenario, friction_of(scenario))
        sensors = [system.AddSensor(_sensor(node, output)) for output in OUTPUTS]
        system.Assemble()
        count, inner = max(int(steps[-1]), 1), max(1, round(self.dt / (self.step or self.dt)))
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = (
            count * inner,
            count * self.dt,
        )
        settings.solution.file.write, settings.solution.sensors.writePeriod = False, self.dt
        with suppress(RuntimeError, ValueError):
            system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.TrapezoidalIndex2)
        stored = [system.GetSensorStoredData(sensor) for sensor in sensors]
        found = np.full((count + 1, 13), np.nan)
        at = np.rint(stored[0][:, 0] / self.dt).astype(int)
        found[at] = np.hstack([part[:, 1:] for part in stored])
        x, q, v, spin = np.split(found[steps], (3, 7, 10), axis=1)
        return {"position": x, "velocity": v, "quaternion": q, "angular_velocity": spin}

    def _system(self, scenario: Any, friction: float) -> tuple[Any, Any]:
        """Return a system and the node of the coin, whose reference point is its mass centre."""
        coin, release = scenario.coin, scenario.release
        system = exudyn.SystemContainer().AddSystem()
        turn = EulerParameters2RotationMatrix(release.attitude)
        made = system.CreateRigidBody(
            referencePosition=list(release.position),
            referenceRotationMatrix=turn,
            initialVelocity=list(release.velocity),
            initialAngularVelocity=list(turn @ np.asarray(release.angular_velocity)),
            inertia=RigidBodyInertia(coin.mass, np.asarray(coin.moments)),
            gravity=[0, 0, -scenario.gravity],
            returnDict=True,
        )
        ground = system.CreateGround()
        below = 1e-3 if friction else 0.05
        corners = exudyn.Vector3DList([[-WIDE, -WIDE, -below], [WIDE, -WIDE, -below], [0, WIDE, -below]])
        for angle in np.arange(self.spheres) * 2 * np.pi / self.spheres:
            for side in (-1, 1):
                rim = [coin.radius * np.cos(angle), coin.radius * np.sin(angle), side * coin.thickness / 2]
                system.CreateSphereTriangleContact(
                    itemNumbers=[made["bodyNumber"], ground],
                    localPosition0=list(np.array(rim) - coin.center_of_mass),
                    sphereRadius=below,
                    trianglePoints=corners,
                    dynamicFriction=friction,
                    restitutionCoefficient=max(scenario.floor.restitution, 1e-3),
                    show=False,
                    **self.contact,
                )
        return system, made["nodeNumber"]


CONTACT = {"contactStiffness": 1e5, "impactModel": 2}
as_documented = Exudyn("Exudyn 1.13.6, as documented", 16, CONTACT)
tuned = Exudyn("Exudyn 1.13.6, tuned", 32, CONTACT | {"contactStiffness": 1e6}, 1e-5, 0.001)
