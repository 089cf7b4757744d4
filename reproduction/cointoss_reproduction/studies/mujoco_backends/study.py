"""MuJoCo's settings for a bounce by MJX and Warp: what each takes, and what a body does."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import mujoco
import numpy as np
import pandas as pd

from cointoss.study import Array
from cointoss_bounce.bodies import BALL, FlatBody
from cointoss_bounce.contact import GRAVITY, ContactSettings, one_step_solref
from cointoss_bounce.drops import SPEED
from cointoss_bounce.recipe import SPRING_STEPS, recipe_of
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.mujoco_models import sliding_ball
from cointoss_reproduction.studies.mujoco_backends.backends import BACKENDS, Stepped, require_backends

E, STEP = 0.8, 2e-3
"""Restitution; step [s]."""
PHASES = 4
"""The number of phases of the touch between two steps."""
SLIP, FRICTION, SLIDING = 1.0, 0.3, FlatBody("sphere", (0.1,))
"""For a ball that slides: its slip [m/s], the coefficient of friction, and the ball."""
RUNS = "runs"
"""The answer of a backend that refuses nothing."""
EXACT = recipe_of(E, STEP)
ONE_STEP = replace(EXACT, exact=False)
SPRING = replace(recipe_of(E, STEP, SPRING_STEPS), exact=False)
Path = tuple[mujoco.MjModel, Array, Array, int]
"""A model, positions, velocities, and steps."""


def drop(contact: ContactSettings, body: FlatBody = BALL, **options: int) -> Path:
    """Return a body that comes down flat without weight at `PHASES` of a step.

    Args:
        contact: the settings.
        body: it comes down flat.
        options: of the model, by their names there.
    """
    model = body.compiled(contact, body.height)
    model.opt.gravity[:] = 0
    for name, option in options.items():
        setattr(model.opt, name, option)
    qpos, qvel = np.zeros((PHASES, 7)), np.zeros((PHASES, 6))
    qpos[:, 2] = body.height + SPEED * STEP * (2 + (np.arange(PHASES) + 0.5) / PHASES)
    qpos[:, 3], qvel[:, 2] = 1.0, -SPEED
    return model, qpos, qvel, 120 if contact.integrator in ("RK4", "discrete") else 12


def lying(contact: ContactSettings, duration: float) -> Path:
    """Return a ball that falls as fast as `rest_of` lets it fall, for a duration [s]."""
    model = BALL.compiled(contact, BALL.height)
    qvel = np.zeros((1, 6))
    qvel[0, 2] = -50 * GRAVITY * STEP
    return model, np.array([[0, 0, BALL.height, 1, 0, 0, 0]]), qvel, round(duration / STEP)


def sliding() -> Path:
    """Return a ball that slides as it comes down, with restitution and friction together."""
    _, qpos, qvel, steps = drop(ONE_STEP, SLIDING)
    qvel[:, 0] = SLIP
    return sliding_ball(ONE_STEP, SLIDING.height, FRICTION), qpos, qvel, steps


def restitution(paths: Array) -> dict[str, float]:
    """Return the smallest and the largest restitution, and the largest error."""
    e = paths[-1, :, 9] / SPEED
    return {"least": float(e.min()), "most": float(e.max()), "error": float(np.abs(e - E).max())}


def rest(paths: Array) -> dict[str, float]:
    """Return the mean depth in the last quarter and the hop then [m]."""
    heights = paths[-(len(paths) // 4) :, 0, 2]
    return {"depth": float(BALL.height - heights.mean()), "hop": float(np.ptp(heights))}


def slip(paths: Array) -> dict[str, float]:
    """Return the mean slip that is left [m/s], and the largest error of e."""
    left = paths[-1, :, 7] - SLIDING.height * paths[-1, :, 11]
    return {"slip": float(left.mean()), "error": restitution(paths)["error"]}


Setting = tuple[Callable[[], Path], Callable[[Array], dict[str, float]]]
"""What is stepped, and what is measured of it: nothing where it is asked whether it runs."""
DROPPED: dict[str, Callable[[], Path]] = {
    "one step, implicitfast": partial(drop, ONE_STEP),
    "the same, Euler": partial(drop, replace(ONE_STEP, integrator="Euler")),
    "the same, implicit": partial(drop, replace(ONE_STEP, integrator="implicit")),
    "the same, RK4": partial(drop, replace(ONE_STEP, integrator="RK4")),
    "one step, no stiffness": partial(drop, replace(ONE_STEP, solref=one_step_solref(E, STEP))),
    "spring of 40 steps, RK4": partial(drop, SPRING),
    "the same, discrete": partial(drop, replace(SPRING, integrator="discrete")),
    "box flat, one step": partial(drop, ONE_STEP, FlatBody("box", (0.1, 0.1, 0.05))),
    "capsule, one step": partial(drop, ONE_STEP, FlatBody("capsule", (0.02, 0.05))),
    "ellipsoid, one step": partial(drop, ONE_STEP, FlatBody("ellipsoid", (0.1, 0.1, 0.05))),
}
SETTINGS: dict[str, Setting] = {
    "flag diagexact": (partial(drop, EXACT), lambda _: {}),
    **{name: (path, restitution) for name, path in DROPPED.items()},
    # What one step has pressed in rises slowly.
    "one step, at rest": (partial(lying, ONE_STEP, 16.0), rest),
    "spring, at rest": (partial(lying, SPRING, 8.0), rest),
    "elliptic cone, condim 1": (
        partial(drop, ONE_STEP, cone=int(mujoco.mjtCone.mjCONE_ELLIPTIC)),
        lambda _: {},
    ),
    "restitution and friction together": (sliding, slip),
    "flag speculative": (
        partial(drop, ONE_STEP, enableflags=int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)),
        lambda _: {},
    ),
}


def installed() -> pd.DataFrame:
    """Return the versions of all that steps models here."""
    return pd.DataFrame(require_backends().items(), columns=["package", "version"])


def measured(setting: Setting, backend: Stepped) -> dict[str, Any]:
    """Return what a backend does with a setting; whatever it raises is its refusal."""
    make, measure = setting
    try:
        return {"answer": RUNS, **measure(backend(*make()))}
    except Exception as error:
        return {"answer": f"refused: {type(error).__name__}"}


def found(cells: pd.DataFrame) -> dict[str, float]:
    """Return what the claims name: how far MJX in float64 is from MuJoCo."""
    e = cells[cells["setting"] == "one step, implicitfast"].set_index("backend")[["least", "most"]]
    return {"double": float((e.loc["MJX, float64"] - e.loc["MuJoCo"]).abs().max())}


REPRODUCTION = study(
    __name__,
    Cells(installed, {}),
    Cells(measured, {"setting": SETTINGS, "backend": BACKENDS}),
    found=found,
)
