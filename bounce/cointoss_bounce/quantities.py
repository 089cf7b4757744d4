"""Options that are numbers, with units, and how they were typed."""

import re
from collections.abc import Callable
from typing import Any, NamedTuple

import click

_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(.*)")
_LENGTHS = {"m": 1.0, "km": 1e3, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
UNITS = {
    "": {"%": 0.01},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6, "ns": 1e-9},
    "kg": {"kg": 1.0, "g": 1e-3, "mg": 1e-6, "t": 1e3, "lb": 0.45359237, "oz": 0.028349523125},
    "m/s^2": {f"{name}/s^2": length for name, length in _LENGTHS.items()},
}
"""The units that are read, in SI, by the unit in SI."""
EXAMPLES = {"": "60 %", "s": "500 ms", "kg": "2 g", "m/s^2": "1.62 m/s^2"}


class Given(NamedTuple):
    """What was typed, as it was typed and as it is read."""

    text: str
    value: Any


def in_si(text: str, unit: str) -> float:
    """Return a number that is typed in SI, or with a unit as in "2 ms" or "1.62 m/s^2".

    Args:
        text: what was typed.
        unit: of the number, in SI; "" for a pure one.

    Raises:
        ValueError: with what is accepted.
    """
    try:
        return float(text)
    except ValueError:
        number, typed = found.groups() if (found := _NUMBER_AND_UNIT.fullmatch(text)) else ("", "")
        factor = UNITS[unit].get("".join(typed.split()).replace("**", "^").replace("²", "^2"))
        if factor is not None:
            return float(number) * factor
        accepted = f"number in {unit}, or a string with a unit" if unit else "number, or a string"
        raise ValueError(f'a {accepted} like "{EXAMPLES[unit]}"') from None


def quantity(unit: str) -> Callable[[str], Given]:
    """Return what reads an option that is a number of a unit; see `in_si`."""

    def quantity(text: str) -> Given:
        try:
            return Given(text, in_si(text, unit))
        except ValueError as error:
            raise click.BadParameter(f"{text}; accepted: {error}") from None

    return quantity


def numbers(text: str) -> Given:
    """Read an option that is several numbers; none where one of its words is no number."""
    try:
        return Given(text, tuple(float(word) for word in text.split()))
    except ValueError:
        return Given(text, ())
