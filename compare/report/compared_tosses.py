"""What the tosses of one scenario have in common, and what they do not: numbers alone."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cointoss.compare.engines import EngineSettings
from cointoss.compare.film.filmed import Filmed, followed
from cointoss.compare.metrics.impulses import Differences, errors_of_impacts, match
from cointoss.compare.metrics.sequences import agreement_horizon, common_prefix
from cointoss.compare.metrics.trajectories import attitude_angle, distance, parting_time
from cointoss.models.labelled import ReadOnlyArrays
from cointoss.models.records import Array, Toss, UnsupportedError
from cointoss.models.scenario import Scenario

TIMES = 2400
NEARLY = 0.95
"""Flights are compared up to this part of the time of the first touch."""
PARTED = 0.1
"""Two paths have parted when they are further apart than this part of the radius."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Together(ReadOnlyArrays):
    """Both paths at the same times, as far as both tosses last; arrays are read-only."""

    time: Array
    """The times at which the paths are compared, (n,) [s]."""
    distance: Array
    """The distance between the mass centres, (n,) [m]."""
    attitude_angle: Array
    """The angle of the rotation from one attitude to the other, (n,) [rad]."""
    parting_time: float | None
    """The time at which the distance first exceeds `PARTED` r [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Against:
    """A toss held against the measure; how they differ is computed when it is first asked for."""

    measure: Toss
    """The analytic toss."""
    toss: Toss
    """The toss of the other engine."""

    @property
    def most_impacts(self) -> int:
        """The number of impacts of the toss that has more."""
        return max(len(self.measure.impacts), len(self.toss.impacts))

    @cached_property
    def differences(self) -> Differences:
        """The differences of the impacts, the measure's minus the other's."""
        return match(self.measure.impacts, self.toss.impacts)

    @cached_property
    def together(self) -> Together:
        """Both paths at the same times."""
        a, b = self.measure, self.toss
        times = np.linspace(0, min(a.end_time, b.end_time), TIMES)
        path_a, path_b = a.sample(times), b.sample(times)
        apart = distance(path_a, path_b)
        return Together(
            time=times,
            distance=apart,
            attitude_angle=attitude_angle(path_a, path_b),
            parting_time=parting_time(times, apart, PARTED * a.scenario.coin.radius),
        )

    @cached_property
    def flight_error(self) -> float:
        """How far the other's first flight is off: part of its way, or of its turn where that is more."""
        firsts = [
            time for toss in (self.measure, self.toss) for time in (toss.end_time, *toss.impacts.time[:1])
        ]
        k = max(int(np.searchsorted(self.together.time, NEARLY * min(firsts))) - 1, 0)
        release, (end,) = self.measure.scenario.release, self.measure.sample(self.together.time[k]).position
        way = max(float(np.linalg.norm(end - release.position)), self.measure.scenario.coin.radius)
        turn = max(float(np.linalg.norm(release.angular_velocity)) * self.together.time[k], 1.0)
        return float(max(self.together.distance[k] / way, self.together.attitude_angle[k] / turn))

    @cached_property
    def common_prefix(self) -> int:
        """Leading symbols of the sequences that agree."""
        return common_prefix(self.measure.sequence, self.toss.sequence)

    @cached_property
    def errors(self) -> Array:
        """Relative error of each of the other engine's impulses: see `errors_of_impacts`, (n,), read-only."""
        errors = errors_of_impacts(self.toss)
        errors.setflags(write=False)
        return errors

    @cached_property
    def common_horizon(self) -> int:
        """Leading symbols that must agree: within the other engine's own horizon, and that of its errors.

        How far each toss is trusted by itself, its own horizon of trust, is its `trusted_impacts`.
        """
        return min(self.toss.trusted_impacts, agreement_horizon(self.measure, self.errors))

    @property
    def common_horizon_time(self) -> float | None:
        """The time of the last impact whose face must be shared, where others follow [s]."""
        times = self.measure.impacts.time
        return float(times[self.common_horizon - 1]) if 0 < self.common_horizon < self.most_impacts else None


@dataclass(frozen=True, kw_only=True, eq=False)
class ComparedTosses:
    """The numbers of a `cointoss.compare.report.comparison.Comparison`, without what shows them."""

    name: str
    """The name of the scenario."""
    text: str
    """The scenario's TOML."""
    tosses: tuple[Toss, ...]
    """One toss by each engine that can toss the scenario; the first is the measure, the analytic toss."""
    absent: Mapping[str, str] = field(default_factory=dict)
    """Why the other engines can't toss the scenario, by their names."""
    settings: Mapping[str, EngineSettings] = field(default_factory=dict)
    """The settings of our engines, by their names; where there are none, those of one toss."""

    @property
    def measure(self) -> Toss:
        """The analytic toss, against which the others are held."""
        return self.tosses[0]

    @property
    def scenario(self) -> Scenario:
        """What was tossed."""
        return self.measure.scenario

    @cached_property
    def against(self) -> tuple[Against, ...]:
        """Each other toss, held against the measure."""
        return tuple(Against(measure=self.measure, toss=toss) for toss in self.tosses[1:])

    def __getitem__(self, engine: str) -> Against:
        """Return the toss of an engine, held against the measure.

        Raises:
            UnsupportedError: for an engine that can't toss the scenario.
            KeyError: for one that was not asked, naming those that were.
        """
        if engine in self.absent:
            raise UnsupportedError(self.absent[engine])
        pairs = {pair.toss.engine: pair for pair in self.against}
        if engine not in pairs:
            raise KeyError(f"{engine}; accepted: {', '.join([*pairs, *self.absent])}")
        return pairs[engine]

    @cached_property
    def filmed(self) -> list[Filmed]:
        """The tosses as they are shown: on, beyond their endings, until the coin lies still."""
        return [followed(toss, self.settings.get(toss.engine)) for toss in self.tosses]
