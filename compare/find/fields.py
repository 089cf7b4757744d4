"""The fields that a search may vary; no engine is imported."""

from collections.abc import Mapping
from typing import Any

from cointoss.compare.sweep.axes import NUMBERS, Span, spans_of
from cointoss.models.scenario import Scenario

FIELDS = {
    name: unit
    for name, unit in NUMBERS.items()
    if name not in ("ending.max_impacts", "ending.until") and not name.startswith("release.quaternion.")
}
"""What may vary, and its unit: not a number of impacts, nothing after the toss, and no component of what has
norm 1."""


def spans(vary: Mapping[str, Any], scenario: Scenario) -> tuple[Span, ...]:
    """Return the spans of fields that vary, each between two values.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    return spans_of(vary, scenario, FIELDS, '{"height": ("20 cm", "60 cm")}')
