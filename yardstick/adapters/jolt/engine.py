"""A coin tossed by Jolt, which runs in node: its cylinder on its plane, in single precision."""

import json
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from adapters.shared import THINNEST, by_name, friction_of, rotations


@dataclass
class Jolt:
    """Jolt with the settings that differ from the defaults, of its world and of the coin.

    Of two restitutions Jolt takes the larger, so the floor has 0; of two frictions the root of the product.
    """

    name: str
    world: dict[str, float]
    body: dict[str, float]
    dt: float = 1 / 60

    @property
    def settings(self) -> dict[str, float]:
        """Return what is set, and the least thickness [m]."""
        return {"thinnest": THINNEST} | self.world | self.body

    def simulate(self, scenario: Any, times: Iterable[float]) -> dict[str, np.ndarray]:
        """Return the coin's states, rows at times: those of the steps nearest to them."""
        coin, release, moments = scenario.coin, scenario.release, np.diag(scenario.coin.moments)
        if np.any(coin.moments != np.diag(moments)) or any(coin.center_of_mass):
            raise NotImplementedError("coin: accepted: diagonal moments, and the mass centre in the middle")
        turn = rotations(np.array([release.attitude]))[0]
        toss = {
            "gravity": scenario.gravity,
            "mass": coin.mass,
            "radius": coin.radius,
            "thickness": max(coin.thickness, THINNEST),
            "inertia": list(moments),
            "restitution": scenario.floor.restitution,
            "friction": friction_of(scenario),
            "position": list(release.position),
            "velocity": list(release.velocity),
            "quaternion": list(release.attitude),
            "spin": list(turn @ release.angular_velocity),
            "dt": self.dt,
            "steps": np.rint(np.asarray(list(times)) / self.dt).astype(int).tolist(),
            "world": self.world,
            "body": self.body,
        }
        command = ["node", str(Path(__file__).with_name("toss.mjs")), str(Path(sys.prefix).parent)]
        ran = subprocess.run(command, input=json.dumps(toss), capture_output=True, text=True)
        if ran.returncode:
            raise RuntimeError(f"node: {ran.stderr.strip()[-400:]}")
        rows = np.array(json.loads(ran.stdout), float)
        rows[:, 10:] = np.einsum("nji,nj->ni", rotations(rows[:, 6:10]), rows[:, 10:])
        return by_name(rows)


as_documented = Jolt("Jolt 1.1.0 (jolt-physics), as documented", {}, {})
tuned = Jolt(
    "Jolt 1.1.0 (jolt-physics), tuned",
    {"mMinVelocityForRestitution": 0.0, "mPenetrationSlop": 1e-5, "mSpeculativeContactDistance": 1e-4},
    {
        "mLinearDamping": 0.0,
        "mAngularDamping": 0.0,
        "mMaxAngularVelocity": 1e5,
        "mAllowSleeping": False,
        "mApplyGyroscopicForce": True,
    },
    0.001,
)
