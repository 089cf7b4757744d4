"""How fast MuJoCo makes many whole tosses, how exactly, and a loop of fixed steps."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import time
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import mujoco
import numpy as np

from cointoss import ContactLaw, Scenario, coin_mj, load
from cointoss.coin_mj import MANY, MujocoSettings, Realisation
from cointoss.study import Array, Progress, cores_used, of_release, paragraphs, rows_from_states, table
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.mujoco_impacts import (
    draw_touches,
    impulse_errors,
    on_floor,
    restitution_errors,
)
from cointoss_reproduction.setups.mujoco_study import RESTITUTIONS, RUBBED, Spread, spread
from cointoss_reproduction.studies.mujoco_many.fixed_steps import loop_model, restitutions_of_coins

SEED, TOSSES, TOUCHES = 5, 400, 100
SCENARIO = "fig24a"
"""Tossed from random releases."""
SETTINGS = {realisation: replace(MANY, contact=realisation) for realisation in Realisation}
ENOUGH = 1e-2
"""An error of restitution that may do."""
LOOP_STEPS = 20_000
"""Of the loop, to be timed."""
LONGEST_STEP = {Realisation.SPRING: np.pi / MANY.stiffness**0.5 / 5, Realisation.ONE_STEP: 1e-3}
"""Of the loop: the first that is tried [s]."""
FINEST_STEP = 1e-7
"""The last [s]; with much finer ones MuJoCo takes impacts for errors."""


class FixedSteps(NamedTuple):
    """Of `mj_step` with fixed steps and the same contact."""

    step: float
    """The longest, of those each 1/√2 of the one before, with which the restitution errs no more [s]."""
    tosses_per_second: float
    """On as many threads, each with a core of its own."""


@dataclass(frozen=True, kw_only=True)
class Speed:
    """Of one realisation, at the default settings of `coin_mj.toss_rows`."""

    tosses_per_second: float
    """On so many threads, each with a core of its own: by the processor time."""
    duration: float
    """Of a toss, on average [s]."""
    restitution: Spread
    """|χ' - χ| of impacts on a smooth floor."""
    smooth: Spread
    """Relative errors of impulses on a smooth floor."""
    coulomb: Spread
    """And on one of friction `RUBBED`."""
    loop: FixedSteps | None
    """Whose restitution errs no more, at worst; none where no step is fine enough."""
    loop_enough: FixedSteps | None
    """Whose restitution errs by at most `ENOUGH`."""


@dataclass(frozen=True, kw_only=True)
class TossSpeeds:
    """Speeds on all threads."""

    threads: int
    speeds: dict[str, Speed]
    """By realisation."""


def compute(progress: Progress, tosses: int = TOSSES, touches: int = TOUCHES, seed: int = SEED) -> TossSpeeds:
    """Time `tosses` tosses by each realisation, and measure the errors of `touches` impacts."""
    rng = np.random.default_rng(seed)
    scenario, starts = load(SCENARIO), draw_states(rng, tosses)
    smooth = draw_touches(rng, touches, RESTITUTIONS)
    speeds, threads = {}, cores_used()
    for number, (realisation, settings) in enumerate(SETTINGS.items(), start=1):
        speeds[realisation.value] = _speed(scenario, starts, settings, smooth, threads)
        progress(number, len(SETTINGS))
    return TossSpeeds(threads=threads, speeds=speeds)


def draw_states(rng: np.random.Generator, count: int) -> Array:
    """Draw states at a hand's height, in any attitude, with spins up to 40 rad/s about each axis, (n, 13)."""
    e = rng.normal(size=(count, 4))
    height = np.stack([np.zeros(count), np.zeros(count), rng.uniform(0.05, 0.6, count)], axis=1)
    velocity, spin = rng.uniform(-0.3, 0.3, (count, 3)), rng.uniform(-40, 40, (count, 3))
    return np.hstack([height, velocity, e / np.linalg.norm(e, axis=1)[:, None], spin])


def _speed(
    scenario: Scenario, starts: Array, settings: MujocoSettings, smooth: list[Scenario], threads: int
) -> Speed:
    rows = rows_from_states(scenario, starts)
    # The first toss compiles.
    coin_mj.toss_rows(rows[:1], settings=settings)
    start = time.process_time()
    outcomes = coin_mj.toss_rows(rows, settings=settings)
    seconds = time.process_time() - start
    restitution = spread(restitution_errors(smooth, settings))
    duration = float(outcomes.end_time.mean())
    loops = {
        error: _loop(scenario, settings, smooth, error, threads / duration)
        for error in (restitution.worst, ENOUGH)
    }
    rubbed = [on_floor(case, ContactLaw.COULOMB, RUBBED) for case in smooth]
    return Speed(
        tosses_per_second=threads * len(rows) / seconds,
        duration=duration,
        restitution=restitution,
        smooth=spread(impulse_errors(smooth, settings)),
        coulomb=spread(impulse_errors(rubbed, settings)),
        loop=loops[restitution.worst],
        loop_enough=loops[ENOUGH],
    )


def _loop(
    scenario: Scenario,
    settings: MujocoSettings,
    smooth: list[Scenario],
    error: float,
    seconds_per_second: float,
) -> FixedSteps | None:
    """Return the fastest loop whose restitution errs by at most `error`.

    Args:
        scenario: tossed, to time the loop.
        settings: of the contact.
        smooth: touches, to measure the errors.
        error: of the worst of them.
        seconds_per_second: seconds of tosses on all threads in one toss's.
    """
    chi, step = np.array([case.floor.restitution for case in smooth]), LONGEST_STEP[settings.contact]
    while step > FINEST_STEP:
        if np.abs(restitutions_of_coins(smooth, settings, step) - chi).max() <= error:
            return FixedSteps(step, seconds_per_second / _loop_seconds(scenario, settings, step))
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


def measures(found: TossSpeeds) -> dict[str, Any]:
    """Return what the claims name."""
    times_faster = [
        speed.tosses_per_second / speed.loop_enough.tosses_per_second
        for speed in found.speeds.values()
        if speed.loop_enough is not None
    ]
    return {
        "worst": max(speed.restitution.worst for speed in found.speeds.values()),
        "ratio": min(times_faster, default=np.inf),
    }


def tables(found: TossSpeeds) -> str:
    """Return the tables, in Markdown."""
    speeds, loops = [], []
    for name, speed in found.speeds.items():
        fits = speed.restitution, speed.smooth, speed.coulomb
        errors = [f"{fit.median:.0e} ({fit.worst:.0e})" for fit in fits]
        speeds.append([name, f"{speed.tosses_per_second:.0f}", *errors])
        for error, loop in ((speed.restitution.worst, speed.loop), (ENOUGH, speed.loop_enough)):
            cells = [f"none down to {FINEST_STEP:.0e}", "", ""]
            if loop is not None:
                ratio = float(f"{speed.tosses_per_second / loop.tosses_per_second:.2g}")
                cells = [f"{loop.step:.1e}", f"{loop.tosses_per_second:.2g}", f"{ratio:,g}"]
            loops.append([f"{name}, restitution to {error:.0e}", *cells])
    return paragraphs(
        table("contact | tosses per second | restitution | impulse, smooth | impulse, Coulomb", speeds),
        table("`mj_step` with fixed steps | step [s] | tosses per second | times fewer", loops),
        f"On {found.threads} threads with a core each, by the processor's time; "
        f"a toss lasts {found.speeds[Realisation.SPRING.value].duration:.1f} s on average.",
    )


REPRODUCTION = recorded(__name__, compute, record=TossSpeeds, measures=measures, tables=tables, draw={})
