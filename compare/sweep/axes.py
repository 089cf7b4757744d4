"""A span of a field of the scenario, and an axis of a map: such a span and its values."""

import difflib
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cointoss.compare.sweep.errors import SweepError
from cointoss.models.errors import MOST_NAMED, ScenarioError
from cointoss.models.fields import UNITS, WORDS, lambda_unit, printed_unit
from cointoss.models.hand import QUANTITIES
from cointoss.models.parts import LARGEST
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.units import in_si

MOST_VALUES = 1_000_000
"""On one axis: a map of more than 1e12 pixels fits no disk."""
HAND = {f"hand.{name}": unit for name, (_, unit) in QUANTITIES.items()}
"""The SI units of a hand's numbers, by field."""
_WORDS = {**WORDS, **{f"hand.{name}": word for name, (word, _) in QUANTITIES.items()}}
FORM = "FIELD=START:STOP:N, such as release.position.z=0.2:0.6:400"
SPAN_FORM = "FIELD=START:STOP, such as release.position.z=0.2:0.6"


@dataclass(frozen=True, kw_only=True)
class Span:
    """A field that may have any value from `start` to `stop`."""

    field: str
    unit: str
    """SI, in pint's spelling."""
    start: float
    stop: float

    @property
    def is_of_release(self) -> bool:
        """Whether its field is of the release, which may differ between the tosses of one coin."""
        return self.field.startswith("release.")

    @property
    def word(self) -> str:
        """What a person calls its field."""
        return _WORDS.get(self.field, self.field)

    @property
    def printed_unit(self) -> str:
        """Its unit as a person writes it."""
        return printed_unit(self.unit)


@dataclass(frozen=True, kw_only=True)
class Axis(Span):
    """A field that varies along one side of a map, evenly from `start` to `stop`, both included."""

    count: int

    @property
    def values(self) -> Array:
        """The field's values, (count,) [unit]."""
        return np.linspace(self.start, self.stop, self.count)

    @property
    def texts(self) -> list[str]:
        """The values in few digits, but so many that no two are alike."""
        written = ([f"{value:.{digits}g}" for value in self.values.tolist()] for digits in range(6, 18))
        return next(texts for texts in written if len(set(texts)) == self.count)


def parse_axis(text: str, scenario: Scenario, units: Mapping[str, str] = UNITS) -> Axis:
    """Read an axis from FIELD=START:STOP:N; numbers are SI, or carry a unit: "coin.mass=2 g:5 g:100".

    Args:
        text: the axis.
        scenario: whose field it is.
        units: of the fields that are accepted, SI in pint's spelling.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    field, parts = split_span(text, 3, FORM)
    span = span_of(field, parts[0], parts[1], unit_of(field, scenario, units))
    try:
        count = int(parts[2])
    except ValueError:
        count = 0
    if not 2 <= count <= MOST_VALUES:
        raise SweepError(f"{text}: N = {parts[2]}; accepted: a whole number from 2 to {MOST_VALUES}")
    axis = Axis(**vars(span), count=count)
    if len(np.unique(axis.values)) < count:
        raise SweepError(f"{text}: not {count} numbers between both; accepted: ends that are farther apart")
    if field == "ending.max_impacts" and not np.all(np.mod(axis.values, 1) == 0):
        raise SweepError(f"{text}: accepted: START, STOP and N that give whole numbers only, such as 1:9:9")
    return axis


def split_span(text: str, parts: int, form: str) -> tuple[str, list[str]]:
    """Return the field of FIELD=START:STOP and what follows it, in `parts` parts.

    Raises:
        SweepError: for another form, naming `form`.
    """
    field, equals, span = text.partition("=")
    found = span.split(":")
    if not equals or len(found) != parts:
        raise SweepError(f"{text}: accepted: {form}")
    return field.strip(), found


def span_of(field: str, start: str | float, stop: str | float, unit: str) -> Span:
    """Return the span of a field; numbers are in `unit`, texts are such numbers or carry a unit of theirs.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    ends = [_number(field, end, unit) for end in (start, stop)]
    if ends[0] == ends[1]:
        raise SweepError(f"{field}={start}:{stop}: START = STOP; accepted: two numbers that differ")
    return Span(field=field, unit=unit, start=ends[0], stop=ends[1])


def require_ends(span: Span, scenario: Scenario) -> None:
    """Check that a scenario accepts both ends of a span of its coin, air or floor.

    A release may be possible only with other values of other fields, and is not asked for.

    Raises:
        SweepError: naming the span, and what the scenario accepts.
    """
    for end in (span.start, span.stop) if not span.is_of_release else ():
        try:
            scenario.replace(span.field, end)
        except ScenarioError as error:
            raise SweepError(f"{span.field}={span.start:g}:{span.stop:g}: {error}") from None


def unit_of(field: str, scenario: Scenario, units: Mapping[str, str] = UNITS) -> str:
    """Return the SI unit of one of the fields that are accepted, in pint's spelling.

    Raises:
        SweepError: for another field.
    """
    if field not in units:
        what = "numeric field of a scenario" if field not in UNITS else "field that may vary here"
        raise SweepError(f"{field}: no {what}; accepted: {_accepted(field, list(units))}")
    return lambda_unit(scenario.air.exponent) if field in ("air.normal", "air.tangential") else units[field]


def _accepted(field: str, known: list[str]) -> str:
    """Return the fields that a wrong name may mean: those called so, its components, or its neighbours."""
    tables = list(dict.fromkeys(name.partition(".")[0] for name in known if "." in name))
    table = field.partition(".")[0]
    of_table = [name for name in known if table in tables and name.startswith(f"{table}.")]
    near = difflib.get_close_matches(field, of_table, n=1)
    named = [name for name in known if field in (name.rpartition(".")[2], _WORDS[name])]
    found = named or [name for name in known if name.startswith(f"{field}.")] or near
    others = of_table if 0 < len(of_table) <= MOST_NAMED else [f"numbers of {', '.join(tables)}, and gravity"]
    hint = f" (did you mean {near[0]}?)" if near and not named else ""
    return ", ".join(dict.fromkeys([*found, *others])) + hint


def _number(field: str, text: str | float, unit: str) -> float:
    try:
        number = float(text)
    except (ValueError, TypeError):
        try:
            number = in_si(str(text), unit)
        except ValueError as error:
            raise SweepError(f"{field} = {text}: accepted: {error}") from None
    if not abs(number) <= LARGEST:
        raise SweepError(f"{field} = {text}: accepted: a finite number within {LARGEST:g}")
    return number
