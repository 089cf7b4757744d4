"""A window of a scenario: fields that vary between two values each, and the tosses in it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Span
from cointoss.compare.sweep.batch import TOSS, Batch, Varied
from cointoss.models.batch import refused
from cointoss.models.quantities import LARGEST
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario


@dataclass(frozen=True, kw_only=True)
class Window:
    """A scenario, and the spans of the fields that vary; a point has each between 0 and 1."""

    scenario: Scenario
    spans: tuple[Span, ...]

    def values(self, points: Array) -> Array:
        """Return the fields' values at points, (n, fields); none beyond what a scenario can have."""
        starts, stops = (np.array([getattr(one, end) for one in self.spans]) for end in ("start", "stop"))
        return np.clip(starts + points * (stops - starts), -LARGEST, LARGEST)

    def scenario_of(self, values: Array) -> Scenario:
        """Return the scenario with some values of the fields, (fields,).

        Raises:
            ScenarioError: for values that make no valid scenario.
        """
        pairs = [
            part
            for span, value in zip(self.spans, values.tolist(), strict=True)
            for part in (span.field, value)
        ]
        return self.scenario.replace(*pairs[:2], *pairs[2:]) if pairs else self.scenario

    def rows(self, values: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return the tosses with values of the fields, (n, fields), as rows, (n, m), and which of them are
        scenarios, (n,)."""
        varied = tuple(
            Varied(field=span.field, dims=(TOSS,), values=column)
            for span, column in zip(self.spans, values.T, strict=True)
        )
        batch = Batch(scenario=self.scenario, varied=varied, sizes={TOSS: len(values)})
        rows = batch.rows(np.arange(len(values)))
        return rows, ~refused(rows, batch.fields)
