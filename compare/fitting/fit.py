"""The fields of a scenario that explain what was seen of a coin, with their errors, or that none do."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from cointoss.analytic import toss
from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.fitting.fields import spans_given
from cointoss.compare.fitting.misfit import Misfit
from cointoss.compare.fitting.observed import Observed
from cointoss.compare.fitting.search import LeastSquaresSearch, Minimum
from cointoss.compare.fitting.table import read_seen
from cointoss.compare.metrics.estimates import LEVEL
from cointoss.compare.output.language import entry_of
from cointoss.compare.sweep.axes import Span
from cointoss.compare.sweep.errors import MOST_SEED, SweepError, require_whole
from cointoss.models.devices import Device
from cointoss.models.errors import ScenarioError
from cointoss.models.labelled import ReadOnlyArrays
from cointoss.models.processor import Processor
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Array, Toss
from cointoss.models.scenario import Scenario
from cointoss.models.stages import stage

STARTS, MOST_STARTS = 2048, 1 << 20
MOST_FIELDS = 12
"""The most free fields; one toss does not determine more."""
Spans = Mapping[str, tuple[float | str, float | str] | str]


@dataclass(frozen=True, kw_only=True)
class Fitted:
    """A field, and the value that explains best what was seen."""

    span: Span
    value: float
    sd: float
    """Standard deviation by linear propagation; infinite where what was seen does not determine the value."""
    interval: tuple[float, float] | None
    """Where the true value is in 99 of 100 cases, if the model is right: the lowest and the highest value
    that explain what was seen about as well as the best one; no further than the ends of the span. None where
    the model cannot do what was seen: then no value is the true one."""

    @property
    def at_end(self) -> bool:
        """Whether the value is at an end of its span, where the true one may be outside."""
        return self.span.ends_at(self.value)

    @property
    def is_cut(self) -> bool:
        """Whether the interval ends where its span does, and may go on outside."""
        return any(map(self.span.ends_at, self.interval or ()))


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit(ReadOnlyArrays):
    """What explains best what was seen of a coin, by the analytic engine; arrays are read-only."""

    observed: Observed
    scenario: Scenario
    """The scenario with the values that were found in its fields."""
    values: tuple[Fitted, ...]
    """The free fields and their values, in their order; the clock, if it was free, too."""
    covariance: Array
    """Covariance of these values, (k, k); infinite variances of what is not determined."""
    residuals: Array
    """What was seen less what this toss shows, in standard deviations, (n,): touches, faces, heights, tilts,
    and three components of the rotation for each attitude."""
    times: Array
    """The time at which the number of each residual was seen, (n,) [s]."""
    tested: NDArray[np.bool_]
    """Which residuals lie within the horizon of trust; others test nothing, (n,)."""
    touch_times: Array
    """Times of the touches seen, by the observer's clock, (m,) [s]; NaN where this toss makes none."""
    chi_square: float
    """Sum of the squares of the tested residuals."""
    degrees: int
    """Tested numbers less the values that they determine; no more than 0 where nothing is left to test the
    model."""
    clock: float
    """The observer's clock at the release [s]."""
    others: "tuple[Fit, ...]"
    """Other values in the spans that explain what was seen too, the best first; any may be the true ones."""

    @property
    def p_value(self) -> float:
        """How likely chance makes the right model miss by as much; NaN where nothing is left to test it."""
        return float(chi2.sf(self.chi_square, self.degrees)) if self.degrees > 0 else float("nan")

    @property
    def is_possible(self) -> bool:
        """Whether this toss can have been what was seen."""
        return not self.p_value < 1 - LEVEL

    @property
    def verdict(self) -> str:
        """Whether the model can do what was seen, in words."""
        if self.degrees <= 0:
            return "nothing is left to test the model: as many numbers are fitted as were seen"
        found = (
            f"chi-square {self.chi_square:.4g} for {self.degrees} "
            f"{'degree' if self.degrees == 1 else 'degrees'} of freedom, "
            f"{'p < 1e-300' if self.p_value < 1e-300 else f'p = {self.p_value:.2g}'}"
        )
        so = "" if self.is_possible else " with any values of its free fields that were found"
        return f"this model {'cannot' if so else 'can'} do what was seen{so}: {found}"

    @property
    def untested_touches(self) -> tuple[int, ...]:
        """The numbers of the touches that were seen beyond the horizon of trust, and so test nothing."""
        seen = self.observed.touch_numbers
        return tuple(seen[~self.tested[: len(seen)]].tolist())

    @cached_property
    def toss(self) -> Toss:
        """The toss that explains it, followed until the coin lies."""
        return toss(self.scenario.replace("ending.test", "lying"))

    def __getitem__(self, field: str) -> Fitted:
        """Return what was found for a free field.

        Raises:
            KeyError: for another field.
        """
        return entry_of({each.span.field: each for each in self.values}, field)

    def __repr__(self) -> str:
        """Return the values and the verdict."""
        told = (
            f"{each.span.field} = {each.value:.6g}"
            + (f" [{each.interval[0]:.6g}, {each.interval[1]:.6g}]" if each.interval else "")
            for each in self.values
        )
        return f"<Fit: {', '.join(told)}; {self.verdict}>"

    def as_dict(self) -> dict[str, Any]:
        """Return it in the form of `cointoss fit --json`, which has null for what is infinite or NaN.

        A model that cannot be right has no errors of its values: no `sd`, no interval, no covariance.
        """
        return {
            "values": {
                each.span.field: {
                    "value": each.value,
                    "sd": each.sd if each.interval else None,
                    "interval": each.interval,
                    "unit": each.span.unit,
                    "at_end": each.at_end,
                    "cut": each.is_cut,
                }
                for each in self.values
            },
            "covariance": self.covariance.tolist() if self.is_possible else None,
            "chi_square": self.chi_square,
            "degrees": self.degrees,
            "p_value": self.p_value,
            "possible": self.is_possible,
            "verdict": self.verdict,
            "residuals": self.residuals.tolist(),
            "tested": self.tested.tolist(),
            "untested_touches": self.untested_touches,
            "touch_times": self.touch_times.tolist(),
            "others": [{each.span.field: each.value for each in other.values} for other in self.others],
            "scenario": self.scenario.as_tables(),
        }

    def plot(self, ax: Any = None) -> Any:
        """Plot the height of the toss over the observer's time, with what was seen.

        Args:
            ax: matplotlib's Axes where to draw, by default in a new figure of pyplot.

        Returns:
            The axes.
        """
        from cointoss.compare.fitting.picture import plot_seen  # Matplotlib takes long to import

        tested = self.tested[: len(self.observed.touch_times)]
        return plot_seen(self.observed, self.toss, self.clock, tested, ax)


def fit(
    observed: Observed | str | PathLike[str],
    scenario: ScenarioSource | None = None,
    vary: Spans | None = None,
    *,
    sd: Mapping[str, float | str] | None = None,
    starts: int = STARTS,
    seed: int = 0,
    device: Device | str = Device.CPU,
) -> Fit:
    """Find the values of some fields of a scenario that explain what was seen of a coin.

        cointoss.fit("heard.csv", "coin.toml", {"floor.restitution": (0.4, 0.9)}, sd={"time": "1 ms"})

    The fit minimises the squared residuals of the analytic engine's toss, from many starts in the spans and
    first for the first touches. The standard deviations are those of linear propagation: of the errors
    of what was seen alone, if the model is right. Faces are compared with the toss; they determine no value.

    Args:
        observed: what was seen, or the path of a CSV file that has it.
        scenario: what is held fixed: a scenario, the path of its file, or a name such as "fig24a".
        vary: for each field its first and last value, (START, STOP) or "START:STOP", in SI or with a unit. A
            name may be a part that no other field has, such as "restitution". The field "clock" is the time
            that the observer's clock shows at the release; where it does not vary, that is 0.
        sd: standard deviations of "time", "height" and "attitude" where the file has none, in SI or as texts
            with a unit.
        starts: the number of starting points, spread evenly.
        seed: for the starting points.
        device: "cpu" or "auto": the CPU tosses, because a card finds how a toss ends, not what it shows
            before.

    Raises:
        ObservationError: for a file or numbers that can't be used.
        ValueError: for a standard deviation that nothing has.
        SweepError: for a field or a span that can't be used.
        ScenarioError: for a scenario that can't be used, or where no value of the spans makes one.
        UnsupportedError: for the device "cuda".
    """
    require_whole("starts", starts, 1, MOST_STARTS)
    require_whole("seed", seed, 0, MOST_SEED)
    seen = read_seen(observed, sd) if isinstance(observed, str | PathLike) else observed
    if not isinstance(seen, Observed):
        accepted = "an Observed, or the path of a CSV file; cointoss.flips takes counts"
        raise ObservationError(f"observed: {seen!r}, accepted: {accepted}")
    if scenario is None:
        raise SweepError("scenario: None, accepted: one whose fields explain what was seen")
    Processor(device).require_cpu("by a fit")
    misfit = _misfit(seen, scenario_of(scenario), {} if vary is None else vary)
    with stage("fitting"):
        searched = LeastSquaresSearch(misfit, starts=starts, seed=seed).found()
    if searched is None:
        misfit.scenario_of(np.array([(span.start + span.stop) / 2 for span in misfit.spans]))  # says why
        raise ScenarioError(
            "no start of the spans makes a scenario; accepted: spans in which the coin is free"
        )
    minima, ends = searched
    best, *others = (_fit_of(misfit, minimum, ends) for minimum in minima)
    values = tuple(each if best.is_possible else replace(each, interval=None) for each in best.values)
    return replace(best, values=values, others=tuple(other for other in others if other.is_possible))


def _misfit(seen: Observed, scenario: Scenario, vary: Spans) -> Misfit:
    """Return the misfit over the spans of the free fields; refuse what can't be free."""
    spans = spans_given(vary, scenario)
    if len(spans) > MOST_FIELDS:
        raise SweepError(f"vary: {len(spans)} fields; accepted: from 1 to {MOST_FIELDS}")
    for span in spans:
        if span.field.startswith("release.angles.") and scenario.release.angles is None:
            raise SweepError(
                f"{span.field}: this scenario has a quaternion; accepted: release.angles in its place"
            )
    return Misfit(scenario=scenario, spans=spans, observed=seen)


def _fit_of(misfit: Misfit, minimum: Minimum, ends: Array) -> Fit:
    deviations, shown = np.sqrt(np.diag(minimum.covariance)), minimum.predicted
    columns = minimum.values.tolist(), deviations.tolist(), np.sort(ends, axis=1).tolist()
    values = tuple(
        Fitted(span=span, value=value, sd=sd, interval=(low, high))
        for span, value, sd, (low, high) in zip(misfit.spans, *columns, strict=True)
    )
    return Fit(
        observed=misfit.observed,
        scenario=misfit.scenario_of(minimum.values),
        values=values,
        covariance=minimum.covariance,
        residuals=shown.residuals,
        times=misfit.times,
        tested=shown.is_tested,
        touch_times=shown.touch_times,
        chi_square=minimum.chi_square,
        degrees=int(np.sum(shown.is_tested & misfit.is_measured)) - minimum.determined,
        clock=float(misfit.clock_of(minimum.values[None])[0]),
        others=(),
    )
