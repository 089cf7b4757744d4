"""The options of a command, made of the fields of the record that they fill, and the rules between them."""

import inspect
import types
import typing
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import MISSING, fields
from enum import StrEnum
from functools import wraps
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    get_args,
    get_origin,
    get_type_hints,
)

import click

from cointoss.compare.commands.common import (
    ChoiceType,
    CountType,
    ReadPlace,
    TextType,
    WrittenPlace,
)
from cointoss.compare.commands.names import completing
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.output.language import option_of
from cointoss.models.meanings import meanings

Typed = Mapping[str, Any]
"""The values of the options that were typed, by field."""


Rule = Callable[[Typed], str | None]
"""Returns what is wrong with the options that were typed, and what is accepted."""


def one_of(*names: str) -> Rule:
    """Return the rule that at most one of some options is given."""

    def rule(given: Typed) -> str | None:
        found = [name for name in names if name in given]
        return f"{' and '.join(map(option_of, found))}: accepted: one of them" if len(found) > 1 else None

    return rule


def only_with(name: str, *others: str) -> Rule:
    """Return the rule that an option is accepted only beside one of others.

    Args:
        name: of its field.
        others: each a field, or a field with its value, as "engine=mujoco".
    """

    def rule(given: Typed) -> str | None:
        if name not in given or any(_is_given(other, given) for other in others):
            return None
        return f"{_typed(name, given)}: accepted: only beside {' or '.join(map(_shown, others))}"

    return rule


def without(name: str, *others: str) -> Rule:
    """Return the rule that an option is accepted only without others; the arguments are as of `only_with`."""

    def rule(given: Typed) -> str | None:
        found = [_shown(other) for other in others if _is_given(other, given)]
        return (
            f"{_typed(name, given)}: accepted: only without {found[0]}" if name in given and found else None
        )

    return rule


def options_of(
    record: type, *rules: Rule, completed: Mapping[str, Callable[[], Iterable[str]]] | None = None
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return what gives a command an option for each field of a record, and the record as argument `asked`.

    A field's type is `bool` for a flag, a `Literal`, a `StrEnum` or `str`; an `int` is annotated with its
    bounds, `Annotated[int, Within(1, 9)]`, a text of a form with a `Form`, a path that is written with a
    `Written`, and a value of another kind, a path that is read too, with a type of click. A tuple of any
    length may be given several times. A field without a default is required; the text below a field is its
    help. Those of a record that it extends come last.

    Args:
        record: a frozen dataclass.
        rules: between its options; what breaks one is refused.
        completed: the names with which a shell completes an option, by field.
    """
    options = {one.name: _option(one, (completed or {}).get(one.name)) for one in _fields(record)}

    def with_options(command: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(command)
        def called(*arguments: Any, **values: Any) -> Any:
            asked = {name: values.pop(name) for name in options}
            source = click.get_current_context().get_parameter_source
            default = click.core.ParameterSource.DEFAULT
            given = {name: value for name, value in asked.items() if source(name) is not default}
            for rule in rules:
                if fault := rule(given):
                    raise click.UsageError(fault)
            return command(*arguments, asked=record(**asked), **values)

        for option in reversed(options.values()):
            called = option(called)
        return called

    return with_options


def words_of(asked: Any) -> list[str]:
    """Return the words of the command line that fill a record, without those of its defaults."""
    words: list[str] = []
    for one in _fields(type(asked)):
        value = getattr(asked, one.name)
        for each in value if one.is_many else [] if value == one.default else [value]:
            words += [option_of(one.name)] if each is True else [option_of(one.name), str(each)]
    return words


class _Field(NamedTuple):
    """A field of a record that an option fills."""

    name: str
    kind: Any
    """Its type, without None and without `tuple` where it has any length."""
    is_many: bool
    marks: tuple[Any, ...]
    default: Any
    """`MISSING` for none."""
    record: type
    """Whose field it is."""


def _fields(record: type) -> Iterator[_Field]:
    hints = get_type_hints(record, include_extras=True)
    defaults = {each.name: each.default for each in fields(record)}
    places = [(name, owner) for owner in record.__mro__ for name in vars(owner).get("__annotations__", ())]
    for name, owner in places:
        hint = hints[name]
        kind, *marks = get_args(hint) if get_origin(hint) is Annotated else (hint,)
        if get_origin(kind) in (typing.Union, types.UnionType):
            (kind,) = (one for one in get_args(kind) if one is not types.NoneType)
        is_many = get_origin(kind) is tuple and get_args(kind)[1:] == (Ellipsis,)
        kind = get_args(kind)[0] if is_many else kind
        yield _Field(name, kind, is_many, tuple(marks), defaults[name], owner)


def _option(one: _Field, names: Callable[[], Iterable[str]] | None) -> Callable[..., Any]:
    """Return the option of a field."""
    more: dict[str, Any] = {} if names is None else completing(names)
    if one.kind is bool:
        more |= {"is_flag": True}
    else:
        kind = _type(one)
        metavar = next((mark.shown for mark in one.marks if isinstance(mark, Form)), None)
        more |= {
            "type": kind,
            "metavar": metavar,
            "multiple": one.is_many,
            "is_eager": isinstance(kind, ReadPlace),
        }
    if _is_worded(one.kind):
        more |= {"callback": lambda _ctx, _parameter, word: None if word is None else one.kind(word)}
    if one.default is MISSING:
        more |= {"required": True}
    elif not one.is_many:
        default = str(one.default) if isinstance(one.default, StrEnum) else one.default
        more |= {"default": default, "show_default": one.default not in (None, False, "")}
    return click.option(
        option_of(one.name), one.name, help=" ".join(meanings(one.record)[one.name].split()), **more
    )


def _is_worded(kind: Any) -> bool:
    return inspect.isclass(kind) and issubclass(kind, StrEnum)


def _type(one: _Field) -> click.ParamType:
    """Return what click reads a field with."""
    for mark in one.marks:
        match mark:
            case click.ParamType():
                return mark
            case Within(least, most):
                return CountType(least, most)
            case Written():
                return WrittenPlace(mark)
            case Form(shown, read) if read is not None:
                return TextType(shown, read)
    if get_origin(one.kind) is Literal:
        return ChoiceType(get_args(one.kind))
    if _is_worded(one.kind):
        return ChoiceType([str(member) for member in one.kind])
    return {str: click.STRING}[one.kind]


def _is_given(condition: str, given: Typed) -> bool:
    """Return whether an option is given, with its value where the condition has one."""
    name, equals, value = condition.partition("=")
    return name in given and (not equals or str(given[name]) == value)


def _shown(condition: str) -> str:
    """Return a condition as it is typed, as "--engine mujoco" of "engine=mujoco"."""
    name, _, value = condition.partition("=")
    return f"{option_of(name)} {value}".rstrip()


def _typed(name: str, given: Typed) -> str:
    """Return an option as it was typed."""
    return option_of(name) if given[name] is True else f"{option_of(name)} {given[name]}"
