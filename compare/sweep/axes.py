"""How a field varies: a span that it may lie in, and an axis, the values that it takes."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cointoss.compare.sweep.errors import SweepError
from cointoss.models.errors import ScenarioError, shown
from cointoss.models.fields import UNITS, WORDS
from cointoss.models.hand import QUANTITIES
from cointoss.models.names import SPIN, full_name
from cointoss.models.quantities import LARGEST
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.units import in_si, lambda_unit, printed_unit
from cointoss.models.unlikely import warn_of_unlikely_units

MOST_VALUES = 1_000_000
"""The most values on one axis: a map of more than 1e12 pixels fits no disk."""
HAND = {f"hand.{name}": unit for name, (_, unit) in QUANTITIES.items()}
"""The SI units of a hand's numbers, by field."""
NUMBERS = {**UNITS, SPIN: "rad/s"}
"""The SI units of all fields of a scenario that are numbers, in pint's spelling."""
_WORDS = {**WORDS, SPIN: "spin", **{f"hand.{name}": word for name, (word, _) in QUANTITIES.items()}}
FORM = "FIELD=START:STOP:N, such as release.position.z=0.2:0.6:400"


@dataclass(frozen=True, kw_only=True)
class Span:
    """A field that may have any value from `start` to `stop`."""

    field: str
    unit: str
    """SI, in pint's spelling."""
    start: float
    stop: float

    @property
    def word(self) -> str:
        """What a person calls its field."""
        return word_of(self.field)

    @property
    def printed_unit(self) -> str:
        """Its unit as a person writes it."""
        return printed_unit(self.unit)

    def ends_at(self, value: float) -> bool:
        """Return whether a value is nearer to one of its ends than a millionth of it."""
        return min(abs(value - self.start), abs(value - self.stop)) < 1e-6 * abs(self.stop - self.start)


@dataclass(frozen=True, kw_only=True)
class Axis(Span):
    """A field that varies along one side of a map, evenly from `start` to `stop`, both included."""

    count: int

    @property
    def values(self) -> Array:
        """The field's values, (count,) [unit]."""
        return np.linspace(self.start, self.stop, self.count)


def word_of(field: str) -> str:
    """Return what a person calls a field."""
    return _WORDS.get(field, field)


def parse_axis(text: str, scenario: Scenario) -> Axis:
    """Read an axis from FIELD=START:STOP:N; numbers are SI, or carry a unit: "coin.mass=2 g:5 g:100".

    Args:
        text: the axis.
        scenario: whose field it is.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    field, equals, span = text.partition("=")
    ends = span.split(":")
    if not equals or len(ends) != 3:
        raise SweepError(f"{text}: accepted: {FORM}")
    return axis_of(field.strip(), ends, scenario)


def axis_of(
    name: object, ends: Sequence[Any], scenario: Scenario, units: Mapping[str, str] = NUMBERS
) -> Axis:
    """Return an axis of a field, from START, STOP and N.

    Args:
        name: of the field.
        ends: the three, numbers in SI or texts, which may carry a unit.
        scenario: whose field it is.
        units: of the fields that are accepted, SI in pint's spelling.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    span = span_of(name, ends[:2], scenario, units)
    text = f"{span.field}={ends[0]}:{ends[1]}:{ends[2]}"
    try:
        count = int(ends[2])
    except (ValueError, TypeError):
        count = 0
    if not 2 <= count <= MOST_VALUES or str(ends[2]).strip() != str(count):
        raise SweepError(f"{text}: N = {ends[2]}; accepted: a whole number from 2 to {MOST_VALUES}")
    axis = Axis(**vars(span), count=count)
    if len(np.unique(axis.values)) < count:
        raise SweepError(f"{text}: not {count} numbers between both; accepted: ends that are farther apart")
    if span.field == "ending.max_impacts" and not np.all(np.mod(axis.values, 1) == 0):
        raise SweepError(f"{text}: accepted: START, STOP and N that give whole numbers only, such as 1:9:9")
    return axis


def ends_of(name: object, given: Any, parts: int, accepted: str) -> Sequence[Any]:
    """Return the parts of a range, as text START:STOP or START:STOP:N, or as a tuple or a list.

    Raises:
        SweepError: for anything else, naming what is accepted.
    """
    ends = given.split(":") if isinstance(given, str) else given
    if not isinstance(ends, list | tuple) or len(ends) != parts:
        raise SweepError(f"{name} = {shown(given)}: accepted: {accepted}")
    return ends


def axis_given(name: object, given: Any, scenario: Scenario, units: Mapping[str, str] = NUMBERS) -> Axis:
    """Return the axis of a range, START:STOP:N as text or tuple, or of evenly spaced values.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    form = "START:STOP:N, such as 0.2:0.8:7, as text or as a tuple, or two or more evenly spaced values"
    if isinstance(given, str | tuple):
        return axis_of(name, ends_of(name, given, 3, form), scenario, units)
    try:
        values = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.ndim != 1 or len(values) < 2:
        raise SweepError(f"{name} = {shown(given)}: accepted: {form}")
    axis = axis_of(name, (float(values[0]), float(values[-1]), len(values)), scenario, units)
    if not np.allclose(axis.values, values, rtol=1e-12, atol=0):
        raise SweepError(f"{name}: values that are not evenly spaced; accepted: {form}")
    return axis


def spans_of(
    vary: Any, scenario: Scenario, units: Mapping[str, str], example: str, *, free: Collection[str] = ()
) -> tuple[Span, ...]:
    """Return the spans of fields that vary, each once; a scenario accepts their ends.

    Args:
        vary: by field its first and its last value, numbers in SI or texts with a unit, or both as a text.
        scenario: whose fields these are.
        units: of the fields that are accepted, SI in pint's spelling.
        example: of what is accepted.
        free: fields that are none of the scenario.

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    if not isinstance(vary, Mapping) or not vary:
        given = "nothing" if isinstance(vary, Mapping) else shown(vary)
        raise SweepError(f"vary: {given}, accepted: a dict such as {example}")
    found: dict[str, Span] = {}
    for name, given in vary.items():
        ends = ends_of(name, given, 2, "its first and last value, as (START, STOP) or START:STOP")
        span = span_of(name, ends, scenario, units)
        if span.field in found:
            raise SweepError(f"{span.field}: twice; accepted: each field once")
        if span.field not in free:
            require_ends(span, scenario)
        found[span.field] = span
    return tuple(found.values())


def span_of(
    name: object, ends: Sequence[Any], scenario: Scenario, units: Mapping[str, str] = NUMBERS
) -> Span:
    """Return the span of a field between two ends: numbers in SI, or texts, which may carry a unit.

    Raises:
        SweepError: naming what is wrong and what is accepted.

    Warns:
        UnitWarning: for an end that was probably meant in another unit.
    """
    field = named(name, units)
    unit = unit_of(field, scenario, units)
    start, stop = (number(field, end, unit) for end in ends)
    if start == stop:
        raise SweepError(f"{field}={ends[0]}:{ends[1]}: START = STOP; accepted: two numbers that differ")
    end = {field: max(start, stop)}
    warn_of_unlikely_units(scenario.gravity, scenario.coin, scenario.release, scenario.ending, end)
    return Span(field=field, unit=unit, start=start, stop=stop)


def require_ends(span: Span, scenario: Scenario) -> None:
    """Check that a scenario accepts both ends of a span of its coin, air or floor.

    A release may be possible only with other values of other fields, and is not asked for.

    Raises:
        SweepError: naming the span, and what the scenario accepts.
    """
    for end in (span.start, span.stop) if not span.field.startswith("release.") else ():
        try:
            scenario.replace(span.field, end)
        except ScenarioError as error:
            raise SweepError(f"{span.field}={span.start:g}:{span.stop:g}: {error}") from None


def named(name: object, known: Collection[str]) -> str:
    """Return the field of a name, or of a part of it that no other field has, such as "restitution".

    Raises:
        SweepError: naming what is accepted, and what may be meant.
    """
    if not isinstance(name, str):
        raise SweepError(f"{shown(name)}: accepted: the name of a field, such as floor.restitution")
    try:
        return full_name(name, known)
    except LookupError as error:
        kind = "field" if "floor.contact" in known else "numeric field"
        what = "field that may vary here" if name in NUMBERS else f"{kind} of a scenario"
        raise SweepError(f"{name}: no {what}; {error.args[0]}") from None


def unit_of(field: str, scenario: Scenario, units: Mapping[str, str] = NUMBERS) -> str:
    """Return the SI unit of a field in pint's spelling; those of λ depend on the scenario's exponent."""
    return lambda_unit(scenario.air.exponent) if field in ("air.normal", "air.tangential") else units[field]


def number(field: str, given: object, unit: str) -> float:
    """Return a number in SI, or that of a text with a unit.

    Raises:
        SweepError: naming the field, what was given and what is accepted.
    """
    try:
        found = float("" if isinstance(given, bool) else given)  # pyright: ignore[reportArgumentType]
    except (ValueError, TypeError):
        try:
            found = in_si(str(given), unit)
        except ValueError as error:
            raise SweepError(f"{field} = {given}: accepted: {error}") from None
    if not abs(found) <= LARGEST:
        raise SweepError(f"{field} = {given}: accepted: a finite number within {LARGEST:g}")
    return found
