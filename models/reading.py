"""Read a scenario file (TOML)."""

import difflib
import tomllib
from functools import lru_cache
from importlib import resources
from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from cointoss.models.bounded import TooLargeError, read_bounded
from cointoss.models.errors import FieldError, ScenarioError, describe, require_type
from cointoss.models.scenario import Scenario
from cointoss.models.unused import warn_of_unused_fields

MOST_BYTES = 1 << 16
"""The largest size of a scenario's file [bytes]."""
LONGEST_LINE = 2000
"""Characters: what takes one line, as a key, could be nested too deeply for the memory."""
FORMAT = 1
"""The field `format` of the file of a scenario or a hand; a file without one is of format 1."""

ScenarioSource = Scenario | str | PathLike[str]
"""A scenario, the path of its file, or the name of one that comes with the package."""


def named_scenarios() -> list[str]:
    """Return the names of the scenarios that come with the package."""
    folder = resources.files("cointoss.models") / "scenarios"
    return sorted(
        entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml")
    )


def title_of(name: str) -> str:
    """Return what a scenario of the package is, from its first line.

    Args:
        name: one of `named_scenarios`.
    """
    first, _, _ = scenario_text(name).partition("\n")
    return first.removeprefix("# ").removesuffix(".").replace(" of Strzalko et al. 2008", "").rstrip(",")


def scenario_text(source: str | PathLike[str]) -> str:
    """Return the text of a scenario file, or of a scenario of the package by its name.

    Raises:
        ScenarioError: if there is no such file, it can't be read as text, or `source` is of another type.
    """
    if not isinstance(source, str | PathLike):
        way_out = "; Scenario(**tables) makes one of a dict" if isinstance(source, dict) else ""
        raise ScenarioError(
            f"scenario: of type {type(source).__name__}, accepted: a Scenario, the path of its file, or a "
            f"name such as fig24a{way_out}"
        )
    names = named_scenarios()
    path, source = Path(source), str(source)
    try:
        if not source:
            raise FileNotFoundError
        if source in names and (not path.exists() or path.is_dir()):
            return (resources.files("cointoss.models") / "scenarios" / f"{source}.toml").read_text(
                encoding="utf-8"
            )
        return plain_text(path, source)
    except OSError as error:
        wrong = (
            "no such file" if isinstance(error, FileNotFoundError) else f"can't be read ({error.strerror})"
        )
        near = difflib.get_close_matches(source, names, n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        raise ScenarioError(
            f"{source or '(no name)'}: {wrong}; accepted: a TOML file, or one of: {', '.join(names)}{hint}"
        ) from None


def plain_text(path: Path, source: str) -> str:
    """Return the text of a small file in UTF-8, each line ended by a newline.

    Raises:
        ScenarioError: if it is too large or no text.
        OSError: if it can't be read.
    """
    try:
        text = read_bounded(path, MOST_BYTES).decode("utf-8-sig")
    except TooLargeError as error:
        raise ScenarioError(f"{source}: {error}; accepted: at most {MOST_BYTES} bytes of text") from None
    except UnicodeDecodeError as error:
        raise ScenarioError(
            f"{source}: {error.reason} at byte {error.start}; accepted: a text file in UTF-8"
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


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
    """
    scenario = parse(scenario_text(source), str(source))
    warn_of_unused_fields(scenario.floor, scenario.air)
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
