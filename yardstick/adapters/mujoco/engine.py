"""Coins tossed by MuJoCo, with the settings of its documentation and with settings found by measurement."""

from dataclasses import dataclass
from math import pi
from typing import Any

import mujoco
import numpy as np

from adapters.mjcf import ONE_STEP, SPRING, joint_of, model_of, states_of


def drag_of(scenario: Any) -> np.ndarray:
    """Return the linear drag's coefficients, of force and moment along a cylinder's axes, (6,)."""
    r, h, ln, lt = scenario.coin.radius, scenario.coin.thickness, scenario.air.normal, scenario.air.tangential
    disc, wall = pi * r**2, pi * r * h
    ct, cn = 2 * disc * lt + wall * (lt + ln / 2), disc * ln + 2 * wall * lt
    d = disc * (r**2 * ln / 4 + h**2 * lt / 2) + wall * (h**2 * (ln + 2 * lt) / 24 + r**2 * lt)
    return np.array([ct, ct, cn, d, d, (disc + 2 * wall) * r**2 * lt])


@dataclass
class Mujoco:
    """MuJoCo with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        model, drag = model_of(scenario, self.settings, self.dt, "air.exponent"), drag_of(scenario)
        data, rows = mujoco.MjData(model), []
        R, q, v = data.xmat[1].reshape(3, 3), data.qpos, data.qvel
        q[:], v[:] = joint_of(scenario)

        def air(_: mujoco.MjModel, data: mujoco.MjData) -> None:
            data.qfrc_passive -= np.concatenate([R @ (drag[:3] * (R.T @ v[:3])), drag[3:] * v[3:]])

        mujoco.set_mjcb_passive(air if drag.any() else None)
        for n in np.diff(np.rint(np.asarray(times) / self.dt).astype(int), prepend=0):
            mujoco.mj_step(model, data, int(n)) if n else None
            rows.append(np.concatenate([q, v]))
        mujoco.set_mjcb_passive(None)
        return states_of(scenario, np.array(rows))


VERSION = f"MuJoCo {mujoco.__version__}"
DEFAULT: dict[str, str | float] = {"bounce": SPRING, "option": "", "flag": "", "thinnest shape": 1e-5}
BEST = {
    "option": 'integrator="implicitfast" cone="elliptic"',
    "flag": 'diagexact="enable"',
    "solimp": "0.9999 0.9999 0.001 0.5 2",
}
as_documented = Mujoco(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = Mujoco(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
tuned = Mujoco(f"{VERSION}, tuned", DEFAULT | BEST | {"bounce": ONE_STEP}, 0.001)
