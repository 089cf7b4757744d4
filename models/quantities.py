"""The kinds of a scenario's fields: numbers with units, bounds, words and lists, and what they are called."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field, PlainSerializer

from cointoss.models.making import AT_REST
from cointoss.models.units import in_si
from cointoss.models.words import Word


def named(kind: type[Word]) -> Callable[[Any], Any]:
    """Return what reads a word of a kind, and refuses others."""

    def member(value: Any) -> Any:
        for item in kind:
            if isinstance(value, str | kind) and str(value) == str(item):
                return item
        raise ValueError("one of " + ", ".join(f'"{item}"' for item in kind))

    return member


@dataclass(frozen=True)
class Label:
    """What people call a field that is a number, or each component of one that is a list of them."""

    word: str = ""
    each: Mapping[str, str] = field(default_factory=dict)
    """Of a list: the components by their names, and their words."""
    unit: str = ""
    """SI unit, in pint's spelling, where the field's `Quantity` does not say it."""


def each_of(what: str = "", **words: str) -> Label:
    """Return the label of a list: `what`, if anything, and the word of each component by its name."""
    return Label(each={name: f"{what} {word}".strip() for name, word in words.items()})


@dataclass(frozen=True)
class Quantity(BeforeValidator):
    """Reads a string, such as "1 cm/s", in an SI unit."""

    unit: str = ""
    """In pint's spelling."""


def quantity(unit: str) -> Quantity:
    """Return what reads a number of a unit, or a string with another."""
    return Quantity(lambda value: in_si(value, unit) if isinstance(value, str) else value, unit=unit)


def time_or_rest() -> Quantity:
    """Return what reads a time, or "rest" as `AT_REST`."""

    def as_time(value: Any) -> Any:
        if not isinstance(value, str):
            return value
        if value == "rest":
            return AT_REST
        try:
            return in_si(value, "s")
        except ValueError as error:
            raise ValueError(f'{error}, or "rest"') from error

    return Quantity(as_time, unit="s")


def list_of(count: int, accepted: str) -> BeforeValidator:
    """Return what reads a list of `count` entries, and says what is accepted."""

    def as_tuple(value: Any) -> Any:
        entries = value.tolist() if isinstance(value, np.ndarray) else value
        if not isinstance(entries, list | tuple) or len(entries) != count:
            raise ValueError(f"a list of {count} {accepted}")
        return tuple(entries)

    return BeforeValidator(as_tuple)


# Sizes beyond all coins, within which products of powers stay far from the range of floating-point numbers.
LARGEST, SMALLEST = 1e9, 1e-9
# In an angle beyond it the digits that tell one attitude from another are gone [rad].
LARGEST_ANGLE = 1e6
WITHIN = Field(ge=-LARGEST, le=LARGEST)
SIZE = Field(ge=SMALLEST, le=LARGEST)
NOT_NEGATIVE = Field(ge=0, le=LARGEST)

Number = Annotated[float, quantity("")]
Mass = Annotated[float, quantity("kg")]
Length = Annotated[float, quantity("m"), WITHIN]
Speed = Annotated[float, quantity("m/s"), WITHIN]
Angle = Annotated[float, quantity("rad"), Field(ge=-LARGEST_ANGLE, le=LARGEST_ANGLE)]
Spin = Annotated[float, quantity("rad/s")]
Gravity = Annotated[float, quantity("m/s**2"), SIZE, Label("gravity g")]
Inertia = Annotated[float, quantity("kg*m**2"), WITHIN]
_Lengths = tuple[Length, Length, Length]
Offset = Annotated[_Lengths, list_of(3, 'lengths, such as [0, 0, "0.1 mm"]')]
Position = Annotated[_Lengths, list_of(3, "lengths, such as [0, 0, 0.4]")]
Speeds = Annotated[tuple[Speed, Speed, Speed], list_of(3, 'speeds, such as [0, 0, "2 m/s"]')]
Angles = Annotated[tuple[Angle, Angle, Angle], list_of(3, 'angles, such as [0, "7 deg", 0]')]
Spins = Annotated[tuple[Spin, Spin, Spin], list_of(3, 'spins, such as [0, "40 rad/s", 0]')]
EulerParameters = Annotated[
    tuple[Number, Number, Number, Number], list_of(4, "numbers of norm 1, such as [1, 0, 0, 0]")
]
_Row = Annotated[tuple[Inertia, Inertia, Inertia], list_of(3, "moments of inertia, such as [8e-8, 0, 0]")]
InertiaRows = Annotated[
    tuple[_Row, _Row, _Row],
    list_of(3, "lists of 3 moments of inertia, such as [[8e-8, 0, 0], [0, 8e-8, 0], [0, 0, 1.6e-7]]"),
]
AS_WORD = PlainSerializer(str, when_used="json")
