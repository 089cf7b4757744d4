"""How fast MuJoCo makes many whole tosses, how exactly, and a loop of fixed steps."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import json
import time
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
from numba import config

import coin_mj
from coin_mj import MANY, Realisation, Settings
from coin_mj.model.state import of_release
from compare.reproduction.runner import Figure, Made, Progress
from compare.reproduction.setups.mujoco_fixed_steps import loop_model, restitutions_of_coins
from compare.reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    on_floor,
    relative_errors,
)
from compare.reproduction.setups.mujoco_study import RESTITUTIONS, RUBBED, Spread, spread
from models.laws import ContactLaw
from models.reading import load
from models.records import Array
from models.releases import Releases
from models.scenario import Scenario

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


class Loop(NamedTuple):
    """Of `mj_step` with fixed steps and the same contact."""

    step: float
    """The longest, of those each 1/√2 of the one before, with which the restitution errs no more [s]."""
    tosses_per_second: float
    """On as many threads, each with a core of its own."""


@dataclass(frozen=True, kw_only=True)
class Speed:
    """Of one realisation, at the default settings of `coin_mj.toss_many`."""

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
    loop: Loop | None
    """Whose restitution errs no more, at worst; none where no step is fine enough."""
    loop_enough: Loop | None
    """Whose restitution errs by at most `ENOUGH`."""


@dataclass(frozen=True, kw_only=True)
class Study:
    """Speeds on so many threads."""

    threads: int
    speeds: dict[str, Speed]
    """By realisation."""


def run(folder: Path, progress: Progress) -> Made:
    """Make the study: numbers.json."""
    study = compute(TOSSES, TOUCHES, SEED, progress)
    (folder / "numbers.json").write_text(
        json.dumps(asdict(study), indent=1, allow_nan=False), encoding="utf-8"
    )
    return Made(text=text(study), failed=check(study))


def compute(tosses: int, touches: int, seed: int, progress: Progress) -> Study:
    """Time `tosses` tosses by each realisation, and measure the errors of `touches` impacts."""
    rng = np.random.default_rng(seed)
    scenario, releases = load(SCENARIO), draw_releases(rng, tosses)
    smooth = draw_touches(rng, touches, RESTITUTIONS)
    speeds, threads = {}, config.__dict__["NUMBA_NUM_THREADS"]
    for number, (realisation, settings) in enumerate(SETTINGS.items(), start=1):
        speeds[realisation.value] = _speed(scenario, releases, settings, smooth, threads)
        progress(number, len(SETTINGS))
    return Study(threads=threads, speeds=speeds)


def draw_releases(rng: np.random.Generator, count: int) -> Releases:
    """Draw releases from a hand's height, in any attitude, with spins up to 40 rad/s about each axis."""
    e = rng.normal(size=(count, 4))
    height = np.stack([np.zeros(count), np.zeros(count), rng.uniform(0.05, 0.6, count)], axis=1)
    return Releases(
        position=height,
        velocity=rng.uniform(-0.3, 0.3, (count, 3)),
        quaternion=e / np.linalg.norm(e, axis=1)[:, None],
        angular_velocity=rng.uniform(-40, 40, (count, 3)),
    )


def _speed(
    scenario: Scenario, releases: Releases, settings: Settings, smooth: list[Scenario], threads: int
) -> Speed:
    # The first toss compiles.
    coin_mj.toss_many(scenario, draw_releases(np.random.default_rng(0), 1), settings=settings)
    start = time.process_time()
    outcomes = coin_mj.toss_many(scenario, releases, settings=settings)
    seconds = time.process_time() - start
    found = by_mujoco(smooth, settings)
    before, after = first(found, "contact_velocity_before"), first(found, "contact_velocity_after")
    chi = np.array([case.floor.restitution for case in smooth])
    restitution = spread(np.abs(-after[:, 2] / before[:, 2] - chi))
    duration = float(outcomes.end_time.mean())
    loops = {
        error: _loop(scenario, settings, smooth, error, threads / duration)
        for error in (restitution.worst, ENOUGH)
    }
    rubbed = [on_floor(case, ContactLaw.COULOMB, RUBBED) for case in smooth]
    return Speed(
        tosses_per_second=threads * len(releases) / seconds,
        duration=duration,
        restitution=restitution,
        smooth=spread(_errors(smooth, settings)),
        coulomb=spread(_errors(rubbed, settings)),
        loop=loops[restitution.worst],
        loop_enough=loops[ENOUGH],
    )


def _errors(cases: list[Scenario], settings: Settings) -> Array:
    return relative_errors(first(by_law(cases), "impulse"), first(by_mujoco(cases, settings), "impulse"))


def _loop(
    scenario: Scenario,
    settings: Settings,
    smooth: list[Scenario],
    error: float,
    seconds_per_second: float,
) -> Loop | None:
    """Give the fastest loop whose restitution errs by at most `error`.

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
            return Loop(step, seconds_per_second / _loop_seconds(scenario, settings, step))
        step /= 2**0.5
    return None


def _loop_seconds(scenario: Scenario, settings: Settings, step: float) -> float:
    """Give the time that the loop takes for a second of a toss [s]."""
    model = loop_model(scenario, settings, step)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(scenario.body, scenario.release)
    start = time.process_time()
    mujoco.mj_step(model, data, nstep=LOOP_STEPS)
    return (time.process_time() - start) / data.time


def check(study: Study) -> tuple[str, ...]:
    """Give the claims that the numbers don't bear out."""
    claims = {
        "restitution errs by at most 1e-2": all(s.restitution.worst < ENOUGH for s in study.speeds.values()),
        "no loop of fixed steps that is as exact is a tenth as fast": all(
            s.loop is None or s.tosses_per_second > 10 * s.loop.tosses_per_second
            for s in study.speeds.values()
        ),
    }
    return tuple(claim for claim, holds in claims.items() if not holds)


def text(study: Study) -> str:
    """Give the table, in Markdown."""

    def errors(fit: Spread) -> str:
        return f"{fit[0]:.0e} ({fit[1]:.0e})"

    lines = [
        "| contact | tosses per second | restitution | impulse, smooth | impulse, Coulomb |",
        "|---|---|---|---|---|",
    ]
    for name, speed in study.speeds.items():
        parts = (speed.restitution, speed.smooth, speed.coulomb)
        lines.append(f"| {name} | {speed.tosses_per_second:.0f} | {' | '.join(map(errors, parts))} |")
    lines += [
        "",
        "| `mj_step` with fixed steps | step [s] | tosses per second | times fewer |",
        "|---|---|---|---|",
    ]
    for name, speed in study.speeds.items():
        for error, loop in ((speed.restitution.worst, speed.loop), (ENOUGH, speed.loop_enough)):
            row = f"{name}, restitution to {error:.0e}"
            if loop is None:
                lines.append(f"| {row} | none down to {FINEST_STEP:.0e} | | |")
                continue
            ratio = float(f"{speed.tosses_per_second / loop.tosses_per_second:.2g}")
            lines.append(f"| {row} | {loop.step:.1e} | {loop.tosses_per_second:.2g} | {ratio:,g} |")
    duration = study.speeds[Realisation.SPRING.value].duration
    lines += [
        "",
        f"On {study.threads} threads with a core each, by the processor's time; "
        f"a toss lasts {duration:.1f} s on average.",
    ]
    return "\n".join(lines)


FIGURE = Figure(
    title="how fast MuJoCo makes many tosses, how exactly, and beside a loop of fixed steps",
    seconds=200,
    files=("numbers.json",),
    run=run,
)
