"""What two tosses of one scenario have in common, and what they do not: numbers alone."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cointoss.compare.engines import EngineSettings
from cointoss.compare.film.filmed import Filmed, followed
from cointoss.compare.metrics.impulses import Differences, errors_of_impacts, match
from cointoss.compare.metrics.sequences import agreement_horizon, common_prefix
from cointoss.compare.metrics.trajectories import attitude_angle, distance, parting_time
from cointoss.models.records import Array, Toss, UnsupportedError
from cointoss.models.scenario import Scenario

TIMES = 2400
PARTED = 0.1
"""Two paths have parted when they are further apart than this part of the radius."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Together:
    """Both paths at the same times, as far as both tosses last; arrays are read-only."""

    time: Array
    """The times at which the paths are compared, (n,) [s]."""
    distance: Array
    """The distance between the mass centres, (n,) [m]."""
    attitude_angle: Array
    """The angle of the rotation from one attitude to the other, (n,) [rad]."""
    parting_time: float | None
    """The time at which the distance first exceeds `PARTED` r [s]."""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.time, self.distance, self.attitude_angle):
            array.setflags(write=False)


@dataclass(frozen=True, kw_only=True, eq=False)
class ComparedTosses:
    """The numbers of a `cointoss.compare.report.comparison.Comparison`, without what shows them."""

    name: str
    """The name of the scenario."""
    text: str
    """The scenario's TOML."""
    analytic: Toss
    mujoco: Toss | None
    not_realisable: str | None = None
    """Why MuJoCo can't toss the scenario, where it can't."""
    settings: EngineSettings
    """MuJoCo's settings."""

    @property
    def scenario(self) -> Scenario:
        """What was tossed."""
        return self.analytic.scenario

    @property
    def tosses(self) -> tuple[Toss, ...]:
        """The tosses there are, the analytic first."""
        return (self.analytic,) if self.mujoco is None else (self.analytic, self.mujoco)

    @property
    def both(self) -> tuple[Toss, Toss]:
        """The analytic toss and MuJoCo's."""
        if self.mujoco is None:
            raise UnsupportedError(self.not_realisable)
        return self.analytic, self.mujoco

    @cached_property
    def differences(self) -> Differences:
        """The differences of the impacts, MuJoCo against analytic."""
        a, b = self.both
        return match(a.impacts, b.impacts)

    @cached_property
    def together(self) -> Together:
        """Both paths at the same times."""
        a, b = self.both
        times = np.linspace(0, min(a.end_time, b.end_time), TIMES)
        path_a, path_b = a.sample(times), b.sample(times)
        apart = distance(path_a, path_b)
        return Together(
            time=times,
            distance=apart,
            attitude_angle=attitude_angle(path_a, path_b),
            parting_time=parting_time(times, apart, PARTED * self.scenario.coin.radius),
        )

    @cached_property
    def common_prefix(self) -> int:
        """Leading symbols of the sequences that agree."""
        a, b = self.both
        return common_prefix(a.sequence, b.sequence)

    @cached_property
    def errors(self) -> Array:
        """Relative error of each of MuJoCo's impulses: see `errors_of_impacts`, (n,), read-only."""
        errors = errors_of_impacts(self.both[1])
        errors.setflags(write=False)
        return errors

    @cached_property
    def horizon(self) -> int:
        """Leading symbols that must agree: within MuJoCo's own horizon, and that of its errors."""
        a, b = self.both
        return min(b.trusted_impacts, agreement_horizon(a, self.errors))

    @property
    def horizon_time(self) -> float | None:
        """The time of the last impact whose face must be shared, where others follow [s]."""
        a, b = self.both
        follows = self.horizon < max(len(a.impacts), len(b.impacts))
        return float(a.impacts.time[self.horizon - 1]) if 0 < self.horizon and follows else None

    def filmed(self) -> list[Filmed]:
        """Return the tosses as films show them: on, beyond their endings, until the coin lies still."""
        settings = {"analytic": None, "mujoco": self.settings}
        return [followed(toss, settings[toss.engine]) for toss in self.tosses]
