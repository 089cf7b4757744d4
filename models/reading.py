"""Read a scenario file (TOML)."""

import tomllib
from functools import lru_cache
from os import PathLike
from typing import Any

from pydantic import ValidationError

from cointoss.models.describing import describe
from cointoss.models.errors import FieldError, ScenarioError, require_type
from cointoss.models.scenario import Scenario
from cointoss.models.sources import scenario_text
from cointoss.models.unlikely import warn_of_unlikely_units
from cointoss.models.unused import warn_of_unused_fields

LONGEST_LINE = 2000
"""Characters: what takes one line, as a key, could be nested too deeply for the memory."""
FORMAT = 1
"""The field `format` of the file of a scenario or a hand; a file without one is of format 1."""

ScenarioSource = Scenario | str | PathLike[str]
"""A scenario, the path of its file, or the name of one that comes with the package."""


def scenario_of(source: ScenarioSource) -> Scenario:
    """Return a scenario as it is, or that of a file or a name.

    Raises:
        ScenarioError: as `load`.
    """
    return source if isinstance(source, Scenario) else load(source)


def load(source: str | PathLike[str]) -> Scenario:
    """Return the scenario of a file, or one of the package by its name.

    Args:
        source: path of a TOML file, or a name from `named_scenarios`.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
        UnitWarning: for a number that was probably meant in another unit.
    """
    scenario = parse(scenario_text(source), str(source))
    warn_of_unused_fields(scenario.floor, scenario.air)
    warn_of_unlikely_units(scenario.gravity, scenario.coin, scenario.release, scenario.ending)
    return scenario


def parse(text: str, source: str) -> Scenario:
    """Read a scenario from TOML.

    Args:
        text: the TOML text.
        source: what to call it in messages.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
        TypeError: for what is no text.
    """
    require_type("text", text, str, "TOML as text, such as scenario.to_toml() returns")
    return _parsed(text, source)


@lru_cache(maxsize=32)
def _parsed(text: str, source: str) -> Scenario:
    """Return a scenario, which is frozen: the same for the same text, with what was computed of it."""
    try:
        return Scenario.model_validate(tables_of(text, source))
    except ValidationError as error:
        raise ScenarioError(f"{source}: {describe(error, Scenario)}") from None


def tables_of(text: str, source: str) -> dict[str, Any]:
    """Return what TOML of this format says, of lines that are not too long.

    Raises:
        ScenarioError: naming the source and what is accepted.
    """
    for number, line in enumerate(text.split("\n"), start=1):
        if len(line) > LONGEST_LINE:
            few = f"accepted: at most {LONGEST_LINE}"
            raise ScenarioError(f"{source}: line {number} has {len(line)} characters; {few}")
    try:
        tables = tomllib.loads(text)
    except RecursionError:
        raise ScenarioError(f"{source}: nested too deeply; accepted: tables of numbers and lists") from None
    except tomllib.TOMLDecodeError as error:
        raise ScenarioError(f"{source}: not TOML: {error}; accepted: TOML") from None
    number = tables.pop("format", FORMAT)
    # True == 1.
    if type(number) is not int or number != FORMAT:
        wrong = FieldError("format", number, f"{FORMAT}, or no such field; a newer cointoss may read others")
        raise ScenarioError(f"{source}: {wrong}")
    return tables
