"""Coins tossed by MJX, MuJoCo in JAX, one at a time on the processor."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from mujoco import mjx

from adapters.mjcf import ONE_STEP, SPRING, joint_of, model_of, states_of
from adapters.shared import AIR

ROWS = 256
"""Number of states that a compiled call returns."""


@jax.jit
def advanced(
    model: mjx.Model, data: mjx.Data, numbers: jax.Array
) -> tuple[mjx.Data, tuple[jax.Array, jax.Array]]:
    """Return the state after those numbers of steps, and positions and velocities after each of them."""

    def row(data: mjx.Data, n: jax.Array) -> tuple[mjx.Data, tuple[jax.Array, jax.Array]]:
        data = lax.fori_loop(0, n, lambda _, data: mjx.step(model, data), data)
        return data, (data.qpos, data.qvel)

    return lax.scan(row, data, numbers)


@dataclass
class Mjx:
    """MJX with a contact and options; what `settings` does not name stays at its default."""

    name: str
    settings: dict[str, str | float]
    dt: float = 0.002

    def simulate(self, scenario: Any, times: np.ndarray) -> dict[str, np.ndarray]:
        """Return the states at the steps next to the times, (n, 3) and (n, 4); spin in the body frame."""
        L, states = float(self.settings["units per metre"]), []
        with jax.enable_x64(self.settings["precision"] == "float64"):
            model = mjx.put_model(model_of(scenario, self.settings, self.dt, *AIR))
            q, v = map(jnp.array, joint_of(scenario, L))
            data = mjx.make_data(model).replace(qpos=q, qvel=v)
            numbers = np.diff(np.rint(np.asarray(times) / self.dt).astype(np.int32), prepend=0)
            for chunk in np.split(
                np.pad(numbers, (0, -len(numbers) % ROWS)), range(ROWS, len(numbers), ROWS)
            ):
                data, rows = advanced(model, data, jnp.array(chunk))
                states.append(np.concatenate(rows, axis=1))
        return states_of(scenario, np.concatenate(states)[: len(numbers)].astype(float), L)


VERSION = f"MJX {version('mujoco-mjx')}"
DEFAULT: dict[str, str | float] = {
    "thinnest shape": 1e-5,
    "bounce": SPRING,
    "option": "",
    "precision": "float32",
    "units per metre": 1,
}
RIGID = {
    "bounce": ONE_STEP,
    "solimp": "0.9999 0.9999 0.001 0.5 2",
    "precision": "float64",
    "units per metre": 1000,
}
as_documented = Mjx(f"{VERSION}, as documented", DEFAULT)
as_documented_rk4 = Mjx(f"{VERSION}, as documented, RK4", DEFAULT | {"option": 'integrator="RK4"'})
tuned = Mjx(f"{VERSION}, tuned", DEFAULT | RIGID, 0.001)
