"""How fast MuJoCo makes many whole tosses, and how exact its contacts are meanwhile."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import mujoco
import numpy as np
from numba import config

import coin_mj
from coin_mj import ContactSettings, Realisation
from coin_mj.contact import rebound_of
from coin_mj.ensemble import FLIGHT_ANGLE, STEPS, STIFFNESS
from coin_mj.scene import build, shape_thickness
from coin_mj.state import of_release
from compare.mujoco_fixed_steps import restitutions_of_a_ball, spring_solref
from compare.mujoco_impacts import by_law, by_mujoco, draw_touches, first, on_floor, relative_errors
from compare.mujoco_study import RESTITUTIONS, RUBBED, Spread, spread
from compare.reproduction import Figure, Made, Progress
from models.laws import ContactLaw
from models.reading import load
from models.records import Array
from models.releases import Releases
from models.scenario import Scenario

SEED, TOSSES, TOUCHES = 5, 400, 100
SCENARIO = "fig24a"
"""Tossed from random releases."""
SETTINGS = {
    realisation: ContactSettings(
        realisation=realisation, stiffness=STIFFNESS, steps=STEPS, flight_angle=FLIGHT_ANGLE
    )
    for realisation in Realisation
}
LOOP_STEPS = 20_000
"""Of the loop of fixed steps, to be timed."""
LOOP_STEPS_IN_CONTACT = (10, 20, 40, 80, 160)


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


@dataclass(frozen=True, kw_only=True)
class Study:
    """Speeds on so many threads."""

    threads: int
    speeds: dict[str, Speed]
    loop_steps: int
    """In a contact, of `mj_step` with a fixed step, so that a ball's restitution errs no more."""
    loop_tosses_per_second: float
    """Of that loop, on as many threads."""


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
    spring = speeds[Realisation.SPRING]
    steps = _loop_steps(scenario.floor.restitution, spring.restitution.worst)
    return Study(
        threads=threads,
        speeds=speeds,
        loop_steps=steps,
        loop_tosses_per_second=threads / (_loop_seconds(scenario, steps) * spring.duration),
    )


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
    scenario: Scenario, releases: Releases, settings: ContactSettings, smooth: list[Scenario], threads: int
) -> Speed:
    # The first toss compiles.
    coin_mj.toss_many(scenario, draw_releases(np.random.default_rng(0), 1), realisation=settings.realisation)
    start = time.process_time()
    outcomes = coin_mj.toss_many(scenario, releases, realisation=settings.realisation)
    seconds = time.process_time() - start
    found = by_mujoco(smooth, settings)
    before, after = first(found, "contact_velocity_before"), first(found, "contact_velocity_after")
    chi = np.array([case.floor.restitution for case in smooth])
    rubbed = [on_floor(case, ContactLaw.COULOMB, RUBBED) for case in smooth]
    return Speed(
        tosses_per_second=threads * len(releases) / seconds,
        duration=float(outcomes.end_time.mean()),
        restitution=spread(np.abs(-after[:, 2] / before[:, 2] - chi)),
        smooth=spread(_errors(smooth, settings)),
        coulomb=spread(_errors(rubbed, settings)),
    )


def _errors(cases: list[Scenario], settings: ContactSettings) -> Array:
    return relative_errors(first(by_law(cases), "impulse"), first(by_mujoco(cases, settings), "impulse"))


def _loop_steps(chi: float, error: float) -> int:
    """Give the fewest fixed steps in a contact whose restitution errs by no more than `error`."""
    for steps in LOOP_STEPS_IN_CONTACT:
        dt = np.pi / STIFFNESS**0.5 / steps
        if np.abs(restitutions_of_a_ball(spring_solref(chi, dt, steps), dt, "RK4") - chi).max() <= error:
            return steps
    return LOOP_STEPS_IN_CONTACT[-1]


def _loop_seconds(scenario: Scenario, steps: int) -> float:
    """Give the time that `mj_step` with the same spring and fixed steps takes for a second of a toss [s]."""
    settings = SETTINGS[Realisation.SPRING]
    rebound = rebound_of(scenario.floor.restitution, settings)
    model = build(scenario, rebound, 0.0, shape_thickness(scenario))
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(scenario.body, scenario.release)
    model.opt.timestep = rebound.duration / steps
    start = time.process_time()
    mujoco.mj_step(model, data, nstep=LOOP_STEPS)
    return (time.process_time() - start) / data.time


def check(study: Study) -> tuple[str, ...]:
    """Give the claims that the numbers don't bear out."""
    claims = {
        "restitution errs by at most 1e-2": all(s.restitution.worst < 1e-2 for s in study.speeds.values()),
        "tosses are made more than ten times as fast as by a loop of fixed steps": all(
            s.tosses_per_second > 10 * study.loop_tosses_per_second for s in study.speeds.values()
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
    spring = study.speeds[Realisation.SPRING.value]
    ratio = spring.tosses_per_second / study.loop_tosses_per_second
    lines += [
        "",
        f"On {study.threads} threads with a core each; a toss lasts {spring.duration:.1f} s on average. "
        f"A loop of `mj_step` with the same spring and {study.loop_steps} fixed steps in a contact would "
        f"make {study.loop_tosses_per_second:.2g} tosses per second: {ratio:.0f} times fewer.",
    ]
    return "\n".join(lines)


FIGURE = Figure(
    title="how fast MuJoCo makes many tosses, and how exact its contacts are meanwhile",
    seconds=120,
    files=("numbers.json",),
    run=run,
)
