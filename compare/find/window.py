"""A window of a scenario: fields that vary between two values each, and the tosses of points in it."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.compare.metrics.margin import accepted
from cointoss.compare.metrics.release_arrays import chosen
from cointoss.compare.sweep.axes import SPAN_FORM, Span, require_ends, span_of, split_span, unit_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.errors import ScenarioError
from cointoss.models.fields import UNITS
from cointoss.models.parts import LARGEST
from cointoss.models.records import Array, Face, Outcome
from cointoss.models.releases import changed_releases
from cointoss.models.scenario import Scenario

FIELDS = {
    name: unit
    for name, unit in UNITS.items()
    if name != "ending.max_impacts" and not name.startswith("release.quaternion.")
}
"""What may vary, and its unit: not a number of impacts, and no component of what has norm 1."""


class Ends(NamedTuple):
    """How the tosses of some points ended."""

    is_tossed: NDArray[np.bool_]
    """Whether the scenario accepts the point, (n,)."""
    outcome: NDArray[np.int8]
    impacts: NDArray[np.int32]
    last_face: NDArray[np.int8]


@dataclass(frozen=True, kw_only=True)
class Window:
    """A scenario, and the spans of the fields that vary; a point has each between 0 and 1."""

    scenario: Scenario
    spans: tuple[Span, ...]

    def values(self, points: Array) -> Array:
        """Return the fields' values at points, (n, fields); none beyond what a scenario can have."""
        starts, stops = (np.array([getattr(one, end) for one in self.spans]) for end in ("start", "stop"))
        return np.clip(starts + points * (stops - starts), -LARGEST, LARGEST)

    def scenario_at(self, point: Array) -> Scenario:
        """Return the scenario at a point, (fields,).

        Raises:
            ScenarioError: for values that make no valid scenario.
        """
        values = self.values(point).tolist()
        pairs = [part for span, value in zip(self.spans, values, strict=True) for part in (span.field, value)]
        return self.scenario.replace(*pairs[:2], *pairs[2:])

    def toss(self, points: Array, max_impacts: int | None = None) -> Ends:
        """Toss the coin at points, (n, fields), by the analytic engine.

        Those that differ in their release alone are made together.

        Args:
            points: where.
            max_impacts: after which a toss stops; None: as the scenario says.
        """
        limit = () if max_impacts is None else ("ending.max_impacts", max_impacts)
        n = len(points)
        ends = Ends(np.zeros(n, np.bool_), np.zeros(n, np.int8), np.zeros(n, np.int32), np.zeros(n, np.int8))
        if all(span.is_of_release for span in self.spans):
            self._toss_together(self.scenario.replace("gravity", self.scenario.gravity, *limit), points, ends)
            return ends
        for i, point in enumerate(points):
            try:
                scenario = self.scenario_at(point).replace("gravity", self.scenario.gravity, *limit)
            except ScenarioError:
                continue
            one = Ends._make(column[i : i + 1] for column in ends)
            replace(self, scenario=scenario, spans=())._toss_together(scenario, point[None, :0], one)
        return ends

    def _toss_together(self, scenario: Scenario, points: Array, ends: Ends) -> None:
        columns = self.values(points).T if self.spans else []
        changed = {span.field: values for span, values in zip(self.spans, columns, strict=True)}
        releases = changed_releases(scenario.release, len(points), changed)
        ends.is_tossed[:] = accepted(scenario, releases) if len(points) else False
        kept = np.flatnonzero(ends.is_tossed)
        if len(kept):
            tossed = analytic.toss_many(scenario, chosen(releases, kept))
            for name in ("outcome", "impacts", "last_face"):
                getattr(ends, name)[kept] = getattr(tossed, name)


@dataclass(frozen=True, kw_only=True)
class Target:
    """What a toss is to show."""

    sequence: str = ""
    """Faces up at the first touches, as in "HTTH"."""
    outcome: Outcome | None = None

    def __post_init__(self) -> None:
        """Check that it is something.

        Raises:
            SweepError: naming what is wrong and what is accepted.
        """
        if not isinstance(self.sequence, str) or set(self.sequence) - {"H", "T"}:
            raise SweepError(f"sequence: {self.sequence!r}, accepted: letters H and T, such as HTTH")
        if not self.sequence and self.outcome is None:
            raise SweepError("sequence, outcome: none; accepted: one of them, or both")

    @property
    def steps(self) -> int:
        """Touches and the outcome, each a step."""
        return len(self.sequence) + (self.outcome is not None)

    @property
    def in_words(self) -> str:
        """What is to be shown, for a person."""
        return ", ".join(filter(None, [self.sequence, "" if self.outcome is None else str(self.outcome)]))

    def shown(self, window: Window, points: Array, steps: int | None = None) -> NDArray[np.int64]:
        """Return how many leading steps the toss at each point shows, -1 where there is no toss, (n,).

        Args:
            window: where the points are.
            points: (n, fields).
            steps: to be looked at; by default all.
        """
        steps = self.steps if steps is None else steps
        shown, left = np.zeros(len(points), dtype=np.int64), np.arange(len(points))
        for touch in range(steps):
            if not len(left):
                break
            if touch < len(self.sequence):
                ends = window.toss(points[left], touch + 1)
                face = Face.HEADS if self.sequence[touch] == "H" else Face.TAILS
                met = (ends.impacts == touch + 1) & (ends.last_face == face)
            else:
                ends = window.toss(points[left])
                met = ends.outcome == self.outcome
            met &= ends.is_tossed
            shown[left[~ends.is_tossed]] = -1
            left = left[met]
            shown[left] += 1
        return shown


def window_of(vary: tuple[str, ...], scenario: Scenario) -> Window:
    """Return the window of FIELD=START:STOP, one or more.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    if not vary:
        raise SweepError(f"vary: nothing, accepted: {SPAN_FORM}, once or more")
    spans = []
    for text in vary:
        if not isinstance(text, str):
            raise SweepError(f"vary: {text!r}, accepted: {SPAN_FORM}")
        field, (start, stop) = split_span(text, 2, SPAN_FORM)
        if field in [span.field for span in spans]:
            raise SweepError(f"{field}: twice; accepted: each field once")
        span = span_of(field, start, stop, unit_of(field, scenario, FIELDS))
        require_ends(span, scenario)
        spans.append(span)
    return Window(scenario=scenario, spans=tuple(spans))
