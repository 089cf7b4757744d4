"""The cases of the suite, as cases.toml has them."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from cointoss.models.scenario import Scenario


@dataclass(frozen=True, kw_only=True)
class Case:
    """A scenario, what is measured of it, and what is right; the fields are those of cases.toml."""

    name: str
    title: str
    quantity: str
    """Its name in `cointoss.compare.conform.quantities`."""
    scenario: Scenario
    until: float
    """The time of the last state [s]."""
    every: float | None = None
    """The spacing of the states, where a step is too fine [s]."""
    tosses: int = 1
    """Of so many releases by hand."""
    right: tuple[float, ...]
    """The right value, in SI."""
    scale: float
    """Of an error; 0 of faces."""
    source: str
    """Where the right value comes from."""
    tolerance: dict[str, float]
    """The largest error that passes, of an engine that is `event_driven` and of one that is `stepping`."""
    reason: str
    """Why so much."""
    points_to: str
    """What a miss often means."""
    full_until: float | None = None
    full_tosses: int | None = None
    full_right: tuple[float, ...] | None = None
    """The same for `--full`, where they are other."""

    @property
    def is_short(self) -> bool:
        """Whether it is run with several steps."""
        return self.full_until is None and self.full_tosses is None


@cache
def cases() -> tuple[Case, ...]:
    """Return all cases, in the order of the file."""
    text = (resources.files("cointoss.compare.conform") / "cases.toml").read_text(encoding="utf-8")
    tables = tomllib.loads(text)
    return tuple(_case(tables["scenario"], table) for table in tables["case"])


def _case(base: dict[str, Any], table: dict[str, Any]) -> Case:
    changed = [part for pair in table.pop("change").items() for part in pair]
    table |= {name: tuple(table[name]) for name in ("right", "full_right") if name in table}
    return Case(**table, scenario=Scenario.checked(base).replace(*changed))
