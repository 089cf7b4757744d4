"""What a module declares in the TOML file of its name, filled in with what a run of it finds."""

import sys
from collections import ChainMap
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from inspect import signature
from itertools import groupby
from string import Formatter
from types import MappingProxyType, SimpleNamespace
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from cointoss.study import Estimate, in_words, percent
from cointoss_reproduction.frame.claim import Claim, Criterion
from cointoss_reproduction.frame.files import said_by
from cointoss_reproduction.frame.result import Reproduction, Result

if TYPE_CHECKING:  # names are listed without it
    from matplotlib.figure import Figure

Data = dict[str, NDArray[Any]]
"""The data of pictures: arrays by name."""
OPEN = "open"
"""The verdict that a declaration expects of a claim which cannot be tested."""
UNITS = {"cm": 1e2, "mm": 1e3, "µm": 1e6, "ms": 1e3, "µs": 1e6}
"""Units by name: how many of them make an SI unit."""
SELECTING = ("claim", "measure", "table", "picture")
"""What a declaration says of its results."""
_WORDS = ("claim", "headline", "analytic", "mujoco", "missing")


class Findings(SimpleNamespace):
    """What a run finds: numbers, estimates and words, by the names that the declared claims use."""

    data: Any
    """What the pictures show, as `Result` has it."""
    tables: str = ""
    """Tables in Markdown, as `Result` has them."""


def declared(
    module: str,
    make: Callable[..., Findings],
    *,
    draw: "Mapping[str, Callable[[Any], Figure]]",
    **others: Any,
) -> Reproduction:
    """Return what can be reproduced, as the TOML file beside a module declares it.

    The file has the fields of `Reproduction` that are words or numbers, the sizes of the `quick` run, and
    each `claim`, whose fields are found among what was found, the sizes of the run and the constants of the
    module; see `filled`.

    Args:
        module: its full name.
        make: measures, from a `Progress` and the sizes of the run.
        draw: the pictures, by name, each drawn from the data.
        others: further fields of `Reproduction`.
    """
    said = {name: one for name, one in said_by(module).items() if name not in SELECTING}
    quick = said.pop("quick", {}) | dict(others.pop("quick", {}))
    said["assumed"] = _in_words(said.get("assumed", ""), _constants(module))

    def run(*arguments: Any, **given: Any) -> Result:
        sizes = signature(make).bind(*arguments, **given)
        sizes.apply_defaults()
        return result(module, make(*sizes.args, **sizes.kwargs), sizes.arguments)

    run.__module__ = module  # whose sources are its own
    return Reproduction(make=run, quick=partial(run, **quick) if quick else None, draw=draw, **said, **others)


def result(module: str, found: Findings, sizes: Mapping[str, Any] = MappingProxyType({})) -> Result:
    """Return what a run found, with the claims that a module declares.

    Args:
        module: its full name.
        found: by the run.
        sizes: of the run.
    """
    names = ChainMap(vars(found), dict(sizes), _constants(module))
    claims = tuple(filled(said_by(module)["claim"], names))
    return Result(claims=claims, data=found.data, tables=found.tables)


def _constants(module: str) -> dict[str, Any]:
    return {name: value for name, value in vars(sys.modules[module]).items() if name.isupper()}


def filled(claims: Sequence[Mapping[str, Any]], names: ChainMap[str, Any]) -> Iterator[Claim]:
    """Yield declared claims with their numbers.

    Their words name numbers as format strings do, as in `{swing[0]:.2g}`. An index is a number, a name or a
    key; a method is called; behind its format a number may have one of `UNITS`. A criterion is the quantity,
    the name of its measure, the relation, the threshold or its name, and the reason; a measure of several
    entries makes as many criteria, which may name their `{key}`. Claims that follow each other with the same
    `each` are made for each of its entries, whose names come first.

    Args:
        claims: as read from TOML.
        names: of what was found.
    """
    for each, group in groupby(claims, key=lambda claim: claim.get("each")):
        together = list(group)
        entries = {None: {}} if each is None else value_of(each, names)
        for key, entry in entries.items():
            yield from (_claim(claim, names.new_child({"key": key, **entry})) for claim in together)


def value_of(field: str, names: Mapping[str, Any]) -> Any:
    """Return what a field names, as in `flat[0].value` or `shares[AIR, key].max`."""
    root, *steps = field.replace("[", ".[").split(".")
    value: Any = names[root]
    for step in steps:
        if step.startswith("["):
            value = value[_index(step[1:-1], value, names)]
        else:
            value = getattr(value, step)
            value = value() if callable(value) else value
    return value


def _index(text: str, of: Any, names: Mapping[str, Any]) -> Any:
    if isinstance(of, Mapping) and text in of:
        return text
    key, *more = (int(key) if key.lstrip("-").isdigit() else names.get(key, key) for key in text.split(", "))
    return (key, *more) if more else key


def _in_words(text: str, names: Mapping[str, Any]) -> str:
    words: list[str] = []
    for literal, field, form, _ in Formatter().parse(text):
        words.append(literal)
        if field is not None:
            value, (spec, _, unit) = value_of(field, names), (form or "").partition(" ")
            words.append(f"{UNITS[unit] * value:{spec}} {unit}" if unit else _worded(value, spec))
    return "".join(words)


def _worded(value: Any, spec: str) -> str:
    """Return a value by its format, an estimate's "%" being per cent; several values are named."""
    if isinstance(value, Mapping):
        return "; ".join(f"{_worded(one, spec)} ({name})" for name, one in value.items())
    if isinstance(value, Estimate):
        return percent(value) if spec == "%" else in_words(value, spec)
    return format(value, spec)


def _claim(claim: Mapping[str, Any], names: ChainMap[str, Any]) -> Claim:
    words = {field: _in_words(claim[field], names) for field in _WORDS if field in claim}
    expected = claim.get("expected", True)
    if isinstance(expected, str):
        expected = None if expected == OPEN else value_of(expected, names)
    criteria = [one for row in claim.get("criteria", ()) for one in _criteria(row, names)]
    return Claim(criteria=criteria, expected=expected, regression=claim.get("regression", False), **words)


def _criteria(row: Sequence[Any], names: ChainMap[str, Any]) -> Iterator[Criterion]:
    quantity, measure, relation, threshold, reason = row
    measured = value_of(measure, names)
    limit = value_of(threshold, names) if isinstance(threshold, str) else threshold
    for key, one in measured.items() if isinstance(measured, Mapping) else [(names["key"], measured)]:
        of_key = names.new_child({"key": key})
        own = limit[key] if isinstance(limit, Mapping) else limit
        yield Criterion(_in_words(quantity, of_key), one, relation, own, _in_words(reason, of_key))
