"""Models stepped by MuJoCo, by MJX and by Warp, the last two on what their own packages find here."""

# The MuJoCo wheel describes no types; mujoco-mjx, JAX, mujoco-warp and Warp are no dependencies.
# pyright: reportAttributeAccessIssue=false, reportMissingImports=false

from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from typing import Any

import mujoco
import numpy as np
from mujoco import rollout

from cointoss import UnusableEngineError
from cointoss.study import Array, versions_of

PACKAGES = {"jax": "jax", "mujoco.mjx": "mujoco-mjx", "mujoco_warp": "mujoco-warp", "warp": "warp-lang"}
"""Packages by the modules of theirs that are used."""

Stepped = Callable[[Any, Array, Array, int], Array]
"""Returns qpos and qvel after each step, (steps, n, nq + nv), of a model, n states of both, and steps."""


def require_backends() -> dict[str, str]:
    """Return the versions of all that steps models here, by package.

    Raises:
        UnusableEngineError: naming a package that is not installed, and what installs it.
    """
    for module, package in PACKAGES.items():
        if find_spec(module) is None:
            accepted = "pip install mujoco-mjx mujoco-warp"
            raise UnusableEngineError(f"{package}: not installed; accepted: it is, by {accepted}")
    return versions_of(("mujoco", *PACKAGES.values()))


def by_mujoco(model: Any, qpos: Array, qvel: Array, steps: int) -> Array:
    """Step by MuJoCo."""
    start = np.hstack([np.zeros((len(qpos), 1)), qpos, qvel])
    states: Any = rollout.rollout(model, mujoco.MjData(model), start, nstep=steps)[0]
    return np.swapaxes(states[:, :, 1:], 0, 1)


def by_mjx(model: Any, qpos: Array, qvel: Array, steps: int, *, double: bool = False) -> Array:
    """Step by MJX, in float32 or, with `double`, in float64."""
    import jax
    from mujoco import mjx

    with jax.enable_x64(double):
        device_model, empty = mjx.put_model(model), mjx.make_data(model)

        def step(data: Any, _: Any) -> tuple[Any, Any]:
            data = mjx.step(device_model, data)
            return data, jax.numpy.concatenate([data.qpos, data.qvel])

        def path(q: Any, v: Any) -> Any:
            return jax.lax.scan(step, empty.replace(qpos=q, qvel=v), None, steps)[1]

        found = jax.jit(jax.vmap(path))(jax.numpy.array(qpos), jax.numpy.array(qvel))
        return np.swapaxes(np.asarray(found, float), 0, 1)


def by_warp(model: Any, qpos: Array, qvel: Array, steps: int) -> Array:
    """Step by Warp, which has float32 alone."""
    import mujoco_warp
    import warp

    warp.config.quiet = True
    device_model = mujoco_warp.put_model(model)
    data = mujoco_warp.put_data(model, mujoco.MjData(model), nworld=len(qpos))
    data.qpos.assign(qpos.astype(np.float32))
    data.qvel.assign(qvel.astype(np.float32))
    found = np.empty((steps, len(qpos), model.nq + model.nv))
    for step in range(steps):
        mujoco_warp.step(device_model, data)
        found[step] = np.concatenate([data.qpos.numpy(), data.qvel.numpy()], axis=1)
    return found


BACKENDS: dict[str, Stepped] = {
    "MuJoCo": by_mujoco,
    "MJX, float32": by_mjx,
    "MJX, float64": partial(by_mjx, double=True),
    "Warp, float32": by_warp,
}
"""The backends by the names of their columns."""
