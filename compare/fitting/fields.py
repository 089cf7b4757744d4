"""The fields that a fit to one toss may free; no engine is imported."""

from typing import Any

from cointoss.compare.sweep.axes import NUMBERS, Span, spans_of
from cointoss.models.names import SPIN
from cointoss.models.scenario import Scenario

CLOCK = "clock"
"""The time that the observer's clock shows at the release, fitted as if it were a field [s]."""
FIELDS = {CLOCK: "s"} | {
    field: unit
    for field, unit in NUMBERS.items()
    if field != SPIN and not field.startswith(("ending.", "release.quaternion."))
}
"""What may be free, and its SI unit."""


def spans_given(vary: Any, scenario: Scenario) -> tuple[Span, ...]:
    """Return the spans of the fields that are free.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    return spans_of(vary, scenario, FIELDS, '{"floor.restitution": (0.4, 0.9)}', free=[CLOCK])
