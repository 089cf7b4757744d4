"""What is wrong with a scenario, in one line that names the field, its value and what is accepted."""

from types import UnionType
from typing import Annotated, Any, Union, cast, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from cointoss.models.errors import FieldError, meant, shown

MOST_NAMED = 8
"""Fields that a message names beside the first."""


def describe(error: ValidationError, model: type[BaseModel]) -> str:
    """Return what is wrong in one line: the first field, its value, what is accepted, and which others fail.

    Args:
        error: of the validation.
        model: what was to be made.
    """
    # A misspelt key comes first: it explains the key that is missing.
    details = sorted(error.errors(include_url=False), key=lambda detail: detail["type"] != "extra_forbidden")
    others = list(dict.fromkeys(_field(detail) for detail in details[1:]))
    named = [*others[:MOST_NAMED], *([f"and {len(others) - MOST_NAMED} more"] if others[MOST_NAMED:] else [])]
    more = f" (also wrong: {', '.join(named)})" if others else ""
    return _line(details[0], model) + more


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


def _line(detail: ErrorDetails, model: type[BaseModel]) -> str:
    field, value = _field(detail), shown(detail["input"])
    match detail["type"], _cause(detail):
        case "missing", _:
            return f"{field}: missing; accepted: {_accepted(detail, model)}"
        case "extra_forbidden", _:
            return f"{field} = {value}: unknown key; {_known(detail, model)}"
        case _, FieldError() as cause:
            given = detail["input"] if isinstance(detail["input"], dict) else {}
            wrong = f"{field} = {shown(given.get(cause.field, cause.value))}"
            return f"{cause.asked}{wrong}: accepted: {cause.accepted}"
        case _:
            return f"{field} = {value}: accepted: {_accepted(detail, model)}"


def _accepted(detail: ErrorDetails, model: type[BaseModel]) -> str:
    loc = detail["loc"]
    match detail["type"]:
        case "value_error":
            return str(_cause(detail))
        case "missing" | "model_type" if issubclass(kind := _described(loc, model)[0], BaseModel):
            return f"a table [{_field(detail)}] with {', '.join(kind.model_fields)}"
        case "missing" as problem:
            return accepted(loc, model, problem)
        case "greater_than" | "greater_than_equal" | "less_than_equal":
            return accepted(loc, model, "bounds")
        case "finite_number":
            return accepted(loc, model, "finite")
        case "float_type" | "int_type":
            return accepted(loc, model, "type")
        case "bool_type":
            return "true or false"
        case _:
            return detail["msg"]


def accepted(loc: tuple[int | str, ...], model: type[BaseModel], problem: str) -> str:
    """Return what a field that is a number, a word or a list of them accepts.

    Args:
        loc: its names, and its place in a list.
        model: of which it is a field.
        problem: "missing"; "type", where it is something else; "finite"; or "bounds", beyond them.
    """
    kind, rules = _described(loc, model)
    form, bounds = _form(rules), _bounds(rules)
    if problem == "finite":
        return "a finite number"
    if kind is int:
        return f"a whole number{bounds}"
    if problem == "bounds":
        form = form.partition(",")[0]
    return form if problem == "type" else form.replace("a number", f"a number{bounds}", 1)


def ends_of(loc: tuple[int | str, ...], model: type[BaseModel]) -> dict[str, float]:
    """Return the ends of the range of a field that is a number: its lowest as "ge", its highest as "le"."""
    return {key: bound for key, bound in _ends(_described(loc, model)[1]) if key in ("ge", "le")}


def _described(loc: tuple[int | str, ...], model: type[BaseModel]) -> tuple[type, list[Any]]:
    """Return the type of a field, or of an entry of a list, and its rules."""
    kind, rules = cast("Any", model), []
    for step in loc:
        if isinstance(step, int):
            kind, rules = get_args(kind)[step], []
        elif step in kind.model_fields:
            kind, rules = kind.model_fields[step].annotation, list(kind.model_fields[step].metadata)
        while get_origin(kind) in (Annotated, Union, UnionType):
            kind, *more = get_args(kind)
            rules += more
    return get_origin(kind) or kind, rules


def _form(rules: list[Any]) -> str:
    """Return what a value may be, as the rule for it says of an empty text."""
    for rule in rules:
        if isinstance(rule, BeforeValidator):
            try:
                cast("Any", rule.func)("")
            except ValueError as error:
                return str(error)
    return "a number"


def _bounds(rules: list[Any]) -> str:
    """Return the bounds of a number, with a space before."""
    signs = {"gt": ">", "ge": ">=", "le": "<="}
    bounds = [
        f"{signs[key]} {bound if isinstance(bound, int) else f'{bound:g}'}" for key, bound in _ends(rules)
    ]
    return " " * bool(bounds) + " and ".join(bounds)


def _ends(rules: list[Any]) -> list[tuple[str, float]]:
    """Return the bounds of a number, each with its kind."""
    flat = [one for rule in rules for one in (rule.metadata if isinstance(rule, FieldInfo) else [rule])]
    return [(key, getattr(rule, key)) for key in ("gt", "ge", "le") for rule in flat if hasattr(rule, key)]


def _known(detail: ErrorDetails, model: type[BaseModel]) -> str:
    """Return the key that a wrong one may mean, and those that its table has."""
    part: Any = _described(detail["loc"][:-1], model)[0]
    known = list(part.model_fields)
    hint = meant(str(detail["loc"][-1]), [*known, *getattr(part, "instead", ())])
    return f"{hint}accepted: {', '.join(known)}"
