"""One scenario tossed by both engines, and how the answers compare."""

from dataclasses import dataclass

import numpy as np

from compare.engines import Engine, EngineSettings
from compare.metrics.impulses import Differences, errors_of_impacts, match
from compare.metrics.sequences import agreement_horizon, common_prefix
from compare.metrics.trajectories import attitude_angle, distance, parting_time
from models.reading import ScenarioSource, scenario_of
from models.records import Array, Toss, UnsupportedError
from models.scenario import Scenario
from models.stages import stage

TIMES = 2400
PARTED = 0.1
"""Two paths have parted when they are further apart than this part of the radius."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Together:
    """Both paths at the same times, as far as both tosses last; arrays are read-only."""

    time: Array
    """(n,) [s]."""
    distance: Array
    """Between the mass centres, (n,) [m]."""
    attitude_angle: Array
    """Of the rotation from one attitude to the other, (n,) [rad]."""
    parting_time: float | None
    """When the distance first exceeds `PARTED` r [s]."""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.time, self.distance, self.attitude_angle):
            array.setflags(write=False)


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Two tosses of one scenario and their differences."""

    scenario: Scenario
    analytic: Toss
    mujoco: Toss
    differences: Differences
    """Of the impacts, MuJoCo against analytic."""
    together: Together
    common_prefix: int
    """Leading symbols of the sequences that agree."""
    errors: Array
    """Relative error of each of MuJoCo's impulses: see `errors_of_impacts`, (n,)."""
    horizon: int
    """Leading symbols that must agree: within MuJoCo's own horizon, and within that of its errors in the
    analytic engine."""

    def __post_init__(self) -> None:
        """Make the array read-only."""
        self.errors.setflags(write=False)


def compare(scenario: ScenarioSource, mujoco: EngineSettings | None = None) -> Comparison | tuple[Toss, str]:
    """Toss a scenario by both engines and compare the answers.

    Args:
        scenario: what to toss, or its path or name.
        mujoco: MuJoCo's settings, by default those of one toss.

    Returns:
        The comparison; or, where MuJoCo can't realise the scenario, the analytic toss and why.

    Raises:
        UnsupportedError: for what the analytic engine doesn't model.
    """
    described = scenario_of(scenario)
    a = Engine.ANALYTIC.package.toss(described)
    engine = Engine.MUJOCO.package
    try:
        b = engine.toss(described, settings=mujoco or engine.FINE)
    except UnsupportedError as error:
        return a, str(error)
    with stage("comparing the tosses"):
        errors = errors_of_impacts(b)
        return Comparison(
            scenario=described,
            analytic=a,
            mujoco=b,
            differences=match(a.impacts, b.impacts),
            together=_together(a, b),
            common_prefix=common_prefix(a.sequence, b.sequence),
            errors=errors,
            horizon=min(b.trusted_impacts, agreement_horizon(a, errors)),
        )


def _together(a: Toss, b: Toss) -> Together:
    times = np.linspace(0, min(a.end_time, b.end_time), TIMES)
    path_a, path_b = a.sample(times), b.sample(times)
    apart = distance(path_a, path_b)
    limit = PARTED * a.scenario.coin.radius
    return Together(
        time=times,
        distance=apart,
        attitude_angle=attitude_angle(path_a, path_b),
        parting_time=parting_time(times, apart, limit),
    )
