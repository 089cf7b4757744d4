"""How fast MuJoCo makes many whole tosses, how exactly, and a loop of fixed steps."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import time
from dataclasses import replace

import mujoco
import numpy as np

from cointoss import ContactLaw, Scenario, coin_mj, load
from cointoss.coin_mj import MANY, MujocoSettings, Realisation
from cointoss.study import Array, cores_used, of_release, rows_from_states
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.mujoco_impacts import (
    draw_touches,
    impulse_errors,
    on_floor,
    restitution_errors,
    spread,
)
from cointoss_reproduction.setups.releases import directions, released
from cointoss_reproduction.studies.mujoco_many.fixed_steps import loop_model, restitutions_of_coins

SCENARIO = "fig24a"
"""The scenario whose coin is tossed from random releases."""
RESTITUTIONS, RUBBED = (0.2, 1.0), 0.3
"""The restitutions of the impacts; the coefficient of friction where there is friction."""
ENOUGH = 1e-2
"""An error of restitution that may suffice."""
LOOP_STEPS = 20_000
"""The number of steps of the loop that is timed."""
LONGEST_STEP = {Realisation.SPRING: np.pi / MANY.stiffness**0.5 / 5, Realisation.ONE_STEP: 1e-3}
"""The first step of the loop that is tried [s]."""
FINEST_STEP = 1e-7
"""The last step that is tried [s]; with much finer steps MuJoCo takes impacts for errors."""


def timed(
    contact: Realisation, tosses: int = 400, touches: int = 100, seed: int = 5
) -> dict[str, float | None]:
    """Time `tosses` tosses by a contact, measure the errors of `touches` impacts, and find loops as exact.

    The tosses of a second are those on all threads, each with a core of its own, by the processor's time.
    """
    settings, scenario = replace(MANY, contact=contact), load(SCENARIO)
    rng = np.random.default_rng(seed)
    rows = rows_from_states(scenario, draw_states(rng, tosses))
    smooth = draw_touches(rng, touches, RESTITUTIONS)
    rubbed = [on_floor(case, ContactLaw.COULOMB, RUBBED) for case in smooth]
    # The first toss compiles.
    coin_mj.toss_rows(rows[:1], settings=settings)
    start = time.process_time()
    duration = float(coin_mj.toss_rows(rows, settings=settings).end_time.mean())
    per_second = cores_used() * tosses / (time.process_time() - start)
    found: dict[str, float | None] = {
        "threads": cores_used(),
        "per_second": per_second,
        "duration": duration,
    }
    errors = {
        "restitution": restitution_errors(smooth, settings),
        "smooth": impulse_errors(smooth, settings),
        "coulomb": impulse_errors(rubbed, settings),
    }
    for name, of in errors.items():
        found |= {f"{name}_{which}": value for which, value in spread(of).items()}
    for name, error in (("own", float(errors["restitution"].max())), ("enough", ENOUGH)):
        step = _longest_step(smooth, settings, error)
        loop = cores_used() / duration / _loop_seconds(scenario, settings, step) if step else 0.0
        times = per_second / loop if loop else np.inf
        found |= {f"{name}_step": step, f"{name}_per_second": loop, f"{name}_times": times}
    return found


def draw_states(rng: np.random.Generator, count: int) -> Array:
    """Draw states at a hand's height, in any attitude, with spins up to 40 rad/s about each axis, (n, 13)."""
    attitude, height = directions(rng, count), rng.uniform(0.05, 0.6, count)
    velocity, spin = rng.uniform(-0.3, 0.3, (count, 3)), rng.uniform(-40, 40, (count, 3))
    return released(height, velocity, attitude, spin)


def _longest_step(smooth: list[Scenario], settings: MujocoSettings, error: float) -> float | None:
    """Return the longest step, of those each 1/√2 of the one before, whose restitution errs no more [s]."""
    chi, step = np.array([case.floor.restitution for case in smooth]), LONGEST_STEP[settings.contact]
    while step > FINEST_STEP:
        if np.abs(restitutions_of_coins(smooth, settings, step) - chi).max() <= error:
            return float(step)
        step /= 2**0.5
    return None


def _loop_seconds(scenario: Scenario, settings: MujocoSettings, step: float) -> float:
    """Return the time that the loop takes for a second of a toss [s]."""
    model = loop_model(scenario, settings, step)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(scenario.body, scenario.release)
    start = time.process_time()
    mujoco.mj_step(model, data, nstep=LOOP_STEPS)
    return (time.process_time() - start) / data.time


REPRODUCTION = study(__name__, Cells(timed, {"contact": tuple(Realisation)}))
