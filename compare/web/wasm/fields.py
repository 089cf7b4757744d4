"""The fields of a scenario as a page has them: their places in a row of numbers, and what each accepts."""

import math
from typing import Any

import numpy as np

from cointoss.models.errors import accepted, ends_of
from cointoss.models.fields import BODY, COMPONENTS, UNITS, WORDS, printed_unit
from cointoss.models.laws import ContactLaw, EndingTest, RestitutionKind
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.words import Word

_TABLES = ("coin", "air", "floor", "release", "ending")
_INERTIA = "coin.inertia"
_WORDED: dict[str, type[Word]] = {
    "floor.contact": ContactLaw,
    "floor.restitution_kind": RestitutionKind,
    "ending.test": EndingTest,
}
"""Fields that are a word, in a row its integer."""
_Place = tuple[str | int, ...]


def _in_table(table: str) -> dict[str, _Place]:
    """Return the places of a table's numbers and words, as a scenario file has them, by their names."""
    part: Any = Scenario.model_fields[table].annotation
    found: dict[str, _Place] = {}
    for key in part.model_fields:
        path = f"{table}.{key}"
        if path == _INERTIA:
            for i, row in enumerate(BODY):
                found |= {f"{path}.{row}.{name}": (table, key, i, k) for k, name in enumerate(BODY)}
        elif path in COMPONENTS:
            found |= {f"{path}.{name}": (table, key, i) for i, name in enumerate(COMPONENTS[path])}
        else:
            found[path] = (table, key)
    return found


PLACES: dict[str, _Place] = {"gravity": ("gravity",)}
"""Of each field in a scenario file."""
for _table in _TABLES:
    PLACES |= _in_table(_table)
FIELDS = tuple(PLACES)
"""By their places in a row of numbers, where what a scenario does not have is not a number."""


def fields_of(scenario: Scenario) -> dict[str, float | str]:
    """Return a scenario as a page has it: its fields by their names, numbers in SI."""
    tables = scenario.as_tables()
    found = {name: _value(tables, place) for name, place in PLACES.items()}
    return {name: value for name, value in found.items() if value is not None}


def row_of(scenario: Scenario) -> Array:
    """Return a scenario as a row of numbers, (n,), in the order of `FIELDS`."""
    given = fields_of(scenario)
    words = {name: kind(given[name]).value for name, kind in _WORDED.items()}
    return np.array([(given | words).get(name, math.nan) for name in FIELDS], dtype=float)


def described() -> list[dict[str, Any]]:
    """Return what a page has to know of each field to check a value, in the package's own words."""
    return [_described(name, place) for name, place in PLACES.items()]


def _value(tables: Any, place: _Place) -> float | str | None:
    for step in place:
        if isinstance(step, str) and step not in tables:
            return None
        tables = tables[step]
    return tables


def _described(name: str, place: _Place) -> dict[str, Any]:
    default, is_required = _default(place)
    ends = ends_of(place, Scenario)
    texts = {problem: accepted(place, Scenario, problem) for problem in ("type", "finite", "bounds")}
    if is_required:
        texts["missing"] = accepted(place[:2], Scenario, "missing")
    return {
        "name": name,
        "shown": "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in place)[1:],
        "word": WORDS.get(name, name),
        "unit": printed_unit(UNITS.get(name, "")),
        "default": default,
        "words": _WORDED[name].by_value() if name in _WORDED else None,
        "whole": name == "ending.max_impacts",
        "least": ends.get("ge"),
        "most": ends.get("le"),
        "accepted": texts,
    }


def _default(place: _Place) -> tuple[float | str | None, bool]:
    """Return the default of a field, None for nothing, and whether it has to be given."""
    model: Any = Scenario
    for step in place[:-1]:
        if isinstance(step, str) and step in _TABLES:
            model = model.model_fields[step].annotation
    field = model.model_fields[next(step for step in reversed(place) if isinstance(step, str))]
    if field.is_required():
        return None, True
    value = field.default
    for step in place:
        if isinstance(step, int) and value is not None:
            value = value[step]
    return str(value) if isinstance(value, Word) else value, False


def _first_places() -> tuple[int, ...]:
    found: dict[_Place, int] = {}
    return tuple(
        found.setdefault(place[:2], i) if _default(place) == (None, False) else -1
        for i, place in enumerate(PLACES.values())
    )


FIRST = _first_places()
"""For each field that may be left out, the place of the first number of its list; -1 for the others."""
