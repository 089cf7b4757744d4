"""Coins tossed by MuJoCo Warp on the processor."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import mujoco_warp
import numpy as np
import warp

from adapters.mjcf import ONE_STEP, SPRING, model_of
from adapters.shared import AIR, rotations


@dataclass
class MujocoWarp:
    """MuJoCo Warp with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        C, release, rows, done = np.asarray(scenario.coin.center_of_mass), scenario.release, [], 0
        w, R = np.asarray(release.angular_velocity), rotations(np.atleast_2d(release.attitude))[0]
        with warp.ScopedDevice("cpu"):
            plain = model_of(scenario, self.settings, self.dt, *AIR)
            model, data = mujoco_warp.put_model(plain), mujoco_warp.make_data(plain)
            with warp.ScopedCapture() as step:
                mujoco_warp.step(model, data)
            data.qpos.assign(np.array([[*release.position - R @ C, *release.attitude]], np.float32))
            data.qvel.assign(np.array([[*release.velocity - R @ np.cross(w, C), *w]], np.float32))
            for due in np.rint(np.asarray(times) / self.dt).astype(int):
                for _ in range(due - done):
                    warp.capture_launch(step.graph)
                done = due
                rows.append(np.concatenate([data.qpos.numpy()[0], data.qvel.numpy()[0]]))
        q, v = np.split(np.array(rows, float), [7], axis=1)
        R, w = rotations(q[:, 3:]), v[:, 3:]
        position, velocity = q[:, :3] + R @ C, v[:, :3] + np.einsum("nij,nj->ni", R, np.cross(w, C))
        return {"position": position, "velocity": velocity, "quaternion": q[:, 3:], "angular_velocity": w}


VERSION = f"MuJoCo Warp {version('mujoco-warp')}"
DEFAULT: dict[str, str | float] = {
    "bounce": SPRING,
    "option": "",
    "precision": "float32",
    "thinnest shape": 1e-5,
}
RIGID = {"bounce": ONE_STEP, "solimp": "0.9999 0.9999 0.001 0.5 2"}
as_documented = MujocoWarp(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = MujocoWarp(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
IMPLICIT = {"option": 'integrator="implicitfast"'}
tuned = MujocoWarp(f"{VERSION}, tuned", DEFAULT | RIGID | IMPLICIT, 0.001)
