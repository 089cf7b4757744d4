"""What is wrong with a scenario, in one line that names the field, its value and what is accepted."""

import difflib
from types import SimpleNamespace
from typing import Any, cast

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from models.meanings import meanings


class ScenarioError(ValueError):
    """A scenario that can't be used; the message names file, field, value and what is accepted."""


class FieldError(ValueError):
    """A value that only its neighbours show to be wrong: it names its field itself."""

    def __init__(self, field: str, value: Any, accepted: str) -> None:
        """Keep the field's dotted path below the part that refuses it, its value, and what is accepted."""
        super().__init__(accepted)
        self.field, self.value, self.accepted = field, value, accepted


def require_type(name: str, value: object, kind: type, accepted: str) -> None:
    """Refuse an argument of another type.

    Raises:
        TypeError: naming the argument, its type and what is accepted.
    """
    if not isinstance(value, kind):
        raise TypeError(f"{name}: of type {type(value).__name__}, accepted: {accepted}")


def describe(error: ValidationError, model: type[BaseModel]) -> str:
    """Return what is wrong in one line: the first field, its value, what is accepted, and which others fail.

    Args:
        error: of the validation.
        model: what was to be made.
    """
    # A misspelt key comes first: it explains the key that is missing.
    details = sorted(error.errors(include_url=False), key=lambda detail: detail["type"] != "extra_forbidden")
    others = [_field(detail) for detail in details[1:]]
    more = f" (also wrong: {', '.join(dict.fromkeys(others))})" if others else ""
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
            return f"{field} = {value}: unknown key; accepted: {_known(detail, model)}"
        case _, FieldError() as cause:
            return f"{field} = {shown(cause.value)}: accepted: {cause.accepted}"
        case _:
            return f"{field} = {value}: accepted: {_accepted(detail, model)}"


def shown(value: Any) -> str:
    """Return a value as a message shows it, cut where it is long."""
    if isinstance(value, BaseModel):
        value = value.model_dump(exclude_none=True)
    if isinstance(value, tuple):
        value = list(value)
    try:
        text = f'"{value}"' if isinstance(value, str) else str(value)
    except (ValueError, RecursionError):  # an integer of too many digits, a table nested too deeply
        return "(too long to show)"
    return text if len(text) <= 80 else text[:77] + "..."


def _accepted(detail: ErrorDetails, model: type[BaseModel]) -> str:
    ctx = detail.get("ctx", {})
    match detail["type"]:
        case "value_error":
            return str(ctx["error"])
        case "greater_than" | "greater_than_equal" | "less_than_equal":
            return f"a number {_range(detail, model)}"
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
            return (
                "one more entry of the list"
                if isinstance(detail["loc"][-1], int)
                else _meaning(detail, model)
            )
        case "model_type":
            return f"a table [{_field(detail)}]"
        case _:
            return detail["msg"]


def _meaning(detail: ErrorDetails, model: type[BaseModel]) -> str:
    part, name = _model_at(detail["loc"][:-1], model), cast("str", detail["loc"][-1])
    annotation = part.model_fields[name].annotation
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return f"a table [{name}] with {', '.join(annotation.model_fields)}"
    return meanings(part)[name]


def _range(detail: ErrorDetails, model: type[BaseModel]) -> str:
    signs = {"gt": ">", "ge": ">=", "le": "<="}
    name = detail["loc"][-1]
    if isinstance(name, int):  # an entry of a list: pydantic tells the bound that is broken
        rules: list[Any] = [SimpleNamespace(**detail.get("ctx", {}))]
    else:
        rules = _model_at(detail["loc"][:-1], model).model_fields[name].metadata
    bounds = [
        f"{sign} {getattr(rule, key):g}"
        for key, sign in signs.items()
        for rule in rules
        if hasattr(rule, key)
    ]
    return " and ".join(bounds)


def _known(detail: ErrorDetails, model: type[BaseModel]) -> str:
    known = list(_model_at(detail["loc"][:-1], model).model_fields)
    near = difflib.get_close_matches(str(detail["loc"][-1]), known, n=1)
    hint = f" (did you mean {near[0]}?)" if near else ""
    return ", ".join(known) + hint


def _model_at(loc: tuple[int | str, ...], model: type[BaseModel]) -> type[BaseModel]:
    for step in loc:
        model = cast("type[BaseModel]", model.model_fields[str(step)].annotation)
    return model
