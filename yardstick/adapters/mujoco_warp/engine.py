"""Coins tossed by MuJoCo Warp on the processor."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import mujoco_warp
import numpy as np
import warp

from adapters.mjcf import ONE_STEP, SPRING, joint_of, model_of, states_of
from adapters.shared import AIR, rows_at


@dataclass
class MujocoWarp:
    """MuJoCo Warp with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        with warp.ScopedDevice("cpu"):
            plain = model_of(scenario, self.settings, self.dt, *AIR)
            model, data = mujoco_warp.put_model(plain), mujoco_warp.make_data(plain)
            with warp.ScopedCapture() as step:
                mujoco_warp.step(model, data)
            for column, start in zip((data.qpos, data.qvel), joint_of(scenario), strict=True):
                column.assign(start[None].astype(np.float32))
            rows = rows_at(
                times,
                self.dt,
                lambda: warp.capture_launch(step.graph),
                lambda: (data.qpos.numpy()[0], data.qvel.numpy()[0]),
            )
        return states_of(scenario, rows)


VERSION = f"MuJoCo Warp {version('mujoco-warp')}"
DEFAULT: dict[str, str | float] = {
    "bounce": SPRING,
    "option": "",
    "precision": "float32",
    "thinnest shape": 1e-5,
}
RIGID = {
    "bounce": ONE_STEP,
    "solimp": "0.9999 0.9999 0.001 0.5 2",
    "option": 'integrator="implicitfast"',
}
as_documented = MujocoWarp(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = MujocoWarp(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
tuned = MujocoWarp(f"{VERSION}, tuned", DEFAULT | RIGID, 0.001)
