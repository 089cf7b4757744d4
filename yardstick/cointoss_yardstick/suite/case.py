"""The cases of the suite, as cases.toml has them."""

from dataclasses import dataclass
from functools import cache
from typing import Any

from cointoss import Scenario
from cointoss_yardstick.suite.tables import tables

HEIGHT = {"event_driven": 1e-3, "stepping": 1e-2}
"""The largest error of the lowest point's height at a touch and at rest, over the coin's radius.

It is beside the way of the lowest point between two states, of which a part counts without a step, and the
depth m g/k on a spring whose stiffness k the engine names.
"""


def kind_of(dt: float | None) -> str:
    """Return the name of the tolerance of an engine with a step or without one."""
    return "event_driven" if dt is None else "stepping"


@dataclass(frozen=True, kw_only=True)
class Case:
    """A scenario, what is measured of it, and what is right; the fields are those of cases.toml."""

    name: str
    title: str
    quantity: str
    """The name of the measured quantity in `cointoss_yardstick.suite.quantities`."""
    scenario: Scenario
    until: float
    """The time of the last state [s]."""
    every: float | None = None
    """The spacing of the states, where a step is too fine [s]."""
    tosses: int = 1
    """The number of tosses, from releases by hand where it is more than 1."""
    right: tuple[float, ...]
    """The right value, in SI."""
    scale: float
    """The scale by which an error is divided; 0 for faces."""
    source: str
    """Where the right value comes from."""
    tolerance: dict[str, float]
    """The largest error that passes, for an `event_driven` engine and for a `stepping` engine."""
    reason: str
    """Why the tolerance has this value."""
    full_until: float | None = None
    full_tosses: int | None = None
    full_right: tuple[float, ...] | None = None
    """The values of `until`, `tosses` and `right` with `--full`, where they differ."""

    @property
    def is_short(self) -> bool:
        """Whether it is run with several steps."""
        return self.full_until is None and self.full_tosses is None


@cache
def cases() -> tuple[Case, ...]:
    """Return all cases, in the order of the file."""
    return tuple(_case(tables()["scenario"], table) for table in tables()["case"])


def _case(base: dict[str, Any], table: dict[str, Any]) -> Case:
    changed = [part for pair in table["change"].items() for part in pair]
    table = {name: value for name, value in table.items() if name != "change"}
    table |= {name: tuple(table[name]) for name in ("right", "full_right") if name in table}
    return Case(**table, scenario=Scenario.checked(base).replace(*changed))
