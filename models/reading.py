"""Read a scenario file (TOML), and say precisely what is wrong with one."""

import difflib
import tomllib
from importlib import resources
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from models.scenario import FieldError, Scenario


class ScenarioError(ValueError):
    """A scenario that can't be used; the message names file, field, value and what is accepted."""


def named_scenarios() -> list[str]:
    """Give the names of the scenarios that come with the package."""
    folder = resources.files("models") / "scenarios"
    return sorted(
        entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml")
    )


def scenario_text(source: str) -> str:
    """Give the text of a scenario file, or of a scenario of the package by its name.

    Raises:
        ScenarioError: if there is no such file or it can't be read as text.
    """
    names = named_scenarios()
    path = Path(source)
    try:
        if source in names and not path.exists():
            return (resources.files("models") / "scenarios" / f"{source}.toml").read_text(encoding="utf-8")
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise ScenarioError(
            f"{source}: {error.reason} at byte {error.start}; accepted: a text file in UTF-8"
        ) from None
    except OSError as error:
        wrong = (
            "no such file" if isinstance(error, FileNotFoundError) else f"can't be read ({error.strerror})"
        )
        raise ScenarioError(
            f"{source or '(no name)'}: {wrong}; accepted: a TOML file, or one of: {', '.join(names)}"
        ) from None


def load(source: str) -> Scenario:
    """Read a scenario from a file, or one of the package by its name.

    Args:
        source: path of a TOML file, or a name from `named_scenarios`.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
    """
    return parse(scenario_text(source), source)


def parse(text: str, source: str) -> Scenario:
    """Read a scenario from TOML.

    Args:
        text: the TOML text.
        source: what to call it in messages.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
    """
    try:
        return Scenario.model_validate(tomllib.loads(text))
    except ValidationError as error:
        raise ScenarioError(f"{source}: {describe(error)}") from None
    except RecursionError:
        raise ScenarioError(f"{source}: nested too deeply; accepted: tables of numbers and lists") from None
    except tomllib.TOMLDecodeError as error:
        raise ScenarioError(f"{source}: not TOML: {error}") from None
    except ValueError:  # the one that tomllib lets through
        raise ScenarioError(f"{source}: an integer of too many digits; accepted: at most 4300") from None


def describe(error: ValidationError) -> str:
    """Say what is wrong in one line: the first field, its value, what is accepted, and which others fail."""
    # A misspelt key comes first: it explains the key that is missing.
    details = sorted(error.errors(include_url=False), key=lambda detail: detail["type"] != "extra_forbidden")
    others = [_field(detail) for detail in details[1:]]
    more = f" (also wrong: {', '.join(dict.fromkeys(others))})" if others else ""
    return _line(details[0]) + more


def _field(detail: ErrorDetails) -> str:
    names: list[str] = []
    for step in detail["loc"]:
        if isinstance(step, int):
            names[-1] += f"[{step}]"
        else:
            names.append(step)
    cause = _cause(detail)
    return ".".join([*names, cause.field] if isinstance(cause, FieldError) else names)


def _cause(detail: ErrorDetails) -> Exception | None:
    return detail.get("ctx", {}).get("error")


def _line(detail: ErrorDetails) -> str:
    field, value = _field(detail), _shown(detail["input"])
    match detail["type"], _cause(detail):
        case "missing", _:
            return f"{field}: missing; accepted: {_accepted(detail)}"
        case "extra_forbidden", _:
            return f"{field} = {value}: unknown key; accepted: {_known(detail)}"
        case _, FieldError() as cause:
            return f"{field} = {_shown(cause.value)}: accepted: {cause.accepted}"
        case _:
            return f"{field} = {value}: accepted: {_accepted(detail)}"


def _shown(value: Any) -> str:
    if isinstance(value, BaseModel):
        value = value.model_dump(exclude_none=True)
    if isinstance(value, tuple):
        value = list(value)
    try:
        text = f'"{value}"' if isinstance(value, str) else str(value)
    except (ValueError, RecursionError):  # an integer of too many digits, a table nested too deeply
        return "(too long to show)"
    return text if len(text) <= 80 else text[:77] + "..."


def _accepted(detail: ErrorDetails) -> str:
    ctx = detail.get("ctx", {})
    match detail["type"]:
        case "value_error":
            return str(ctx["error"])
        case "greater_than" | "greater_than_equal" | "less_than_equal":
            return f"a number {_range(detail)}"
        case "finite_number":
            return "a finite number"
        case "float_type":
            return 'a number, or a string with a number and a unit like "2 m"'
        case "int_type":
            return "a whole number"
        case "tuple_type":
            return "a list"
        case "too_long":
            return f"a list of {ctx['max_length']}"
        case "missing":
            return "one more entry of the list" if isinstance(detail["loc"][-1], int) else _meaning(detail)
        case "model_type":
            return f"a table [{_field(detail)}]"
        case _:
            return detail["msg"]


def _meaning(detail: ErrorDetails) -> str:
    model = _model_at(detail["loc"][:-1])
    field = model.model_fields[cast("str", detail["loc"][-1])]
    annotation = field.annotation
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return f"a table [{detail['loc'][-1]}] with {', '.join(annotation.model_fields)}"
    return str(field.description)


def _range(detail: ErrorDetails) -> str:
    signs = {"gt": ">", "ge": ">=", "le": "<="}
    name = detail["loc"][-1]
    if isinstance(name, int):  # an entry of a list: pydantic tells the bound that is broken
        rules: list[Any] = [SimpleNamespace(**detail.get("ctx", {}))]
    else:
        rules = _model_at(detail["loc"][:-1]).model_fields[name].metadata
    bounds = [
        f"{sign} {getattr(rule, key):g}"
        for key, sign in signs.items()
        for rule in rules
        if hasattr(rule, key)
    ]
    return " and ".join(bounds)


def _known(detail: ErrorDetails) -> str:
    known = list(_model_at(detail["loc"][:-1]).model_fields)
    near = difflib.get_close_matches(str(detail["loc"][-1]), known, n=1)
    hint = f" (did you mean {near[0]}?)" if near else ""
    return ", ".join(known) + hint


def _model_at(loc: tuple[int | str, ...]) -> type[BaseModel]:
    model: type[BaseModel] = Scenario
    for step in loc:
        model = cast("type[BaseModel]", model.model_fields[str(step)].annotation)
    return model
