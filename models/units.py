"""A number with its unit, written as a string, in SI."""

import math
import re
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pint import UnitRegistry

LONGEST = 200
"""Characters of a quantity."""
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
# Pint computes what it is given, and the power of a power could take for ever. So a name has one small power.
_SIZE = r"[+-]?[0-9]{1,2}(?:\.[0-9]+)?"
_POWER = rf"\s*(?:\*\*|\^)\s*(?:{_SIZE}|\({_SIZE}(?:/[0-9]{{1,2}})?\))|⁻?[¹²³⁴-⁹]{{1,2}}"
_NAME = r"(?!sq(?:uared?)?\b|cub(?:ic|ed)\b)[^\W\d_][^\W⁰-⁹¹²³]*|[%‰°]|1(?=\s*/)"
_TERM = rf"\(?(?:{_NAME})(?:{_POWER})?\)?"
_UNIT = rf"{_TERM}(?:(?:\s*[*/·]\s*|\s+){_TERM})*"
_NUMBER_AND_UNIT = re.compile(rf"\s*({_NUMBER})\s*((?:{_UNIT})?)\s*")

COMMON = {
    "": {"%": 0.01},
    "kg": {"kg": 1.0, "g": 0.001},
    "m": {"m": 1.0, "cm": 0.01, "mm": 0.001},
    "s": {"s": 1.0, "ms": 0.001},
    "m/s": {"m/s": 1.0, "cm/s": 0.01, "mm/s": 0.001},
    "rad": {"rad": 1.0, "deg": 0.017453292519943295},
    "rad/s": {"rad/s": 1.0, "deg/s": 0.017453292519943295, "rpm": 0.10471975511965978},
}
"""Pint's factors of the units that are written often: reading them takes no half a second to import pint."""


def in_si(text: str, unit: str) -> float:
    """Read a quantity such as "1.25 cm" or "7 deg" as a number of `unit`.

    Args:
        text: one number and one unit; a pure number needs none.
        unit: the SI unit of the answer, in pint's spelling; "" for a pure number.

    Raises:
        ValueError: if the text is no quantity, or not one of the dimension of `unit`.
    """
    parts = _NUMBER_AND_UNIT.fullmatch(text) if len(text) <= LONGEST else None
    if parts is None or (unit and not parts[2]) or not math.isfinite(float(parts[1])):
        raise ValueError(_accepted(unit))
    factor = COMMON.get(unit, {}).get(parts[2])
    if factor is not None:
        return float(parts[1]) * factor
    try:
        registry = pint_registry()
        given = registry.parse_units(parts[2])
        # Pint counts radians as numbers: it would take 40 Hz for 40 rad/s, and 7 % for an angle.
        if registry.get_root_units(given)[1] != registry.get_root_units(registry.parse_units(unit))[1]:
            raise ValueError
        factor = registry.Quantity(Decimal(1), given).to(unit or "dimensionless").magnitude
        return float(parts[1]) * float(factor)
    except Exception as error:  # pint lets the errors of its tokenizer and of its arithmetic through
        raise ValueError(_accepted(unit)) from error


def _accepted(unit: str) -> str:
    if not unit:
        return 'a number, or a string like "60 %"'
    examples = {"m": '"2 cm"', "rad": '"7 deg"', "kg": '"2 g"', "s": '"500 ms"'}
    examples["rad/s"] = '"40 rad/s", "40 deg/s" or "40 rpm"'
    return f"a number in {unit}, or a string with a unit like " + examples.get(unit, f'"2 {unit}"')


@cache
def pint_registry() -> "UnitRegistry":
    """Return pint's units, which take long to import; powers of decimals need no C library."""
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)  # pyright: ignore[reportArgumentType]


def lambda_unit(exponent: float) -> str:
    """Return the SI unit of λ_n and λ_τ, in pint's spelling.

    Args:
        exponent: b.
    """
    return f"kg*m**{-2 - exponent:.15g}*s**{exponent - 1:.15g}"


_RAISED = str.maketrans("-.0123456789", "⁻·⁰¹²³⁴⁵⁶⁷⁸⁹")


def printed_unit(unit: str) -> str:
    """Return a unit as a person writes it, such as "kg m⁻² s⁻¹".

    Args:
        unit: in pint's spelling.
    """
    raised = re.sub(r"\*\*(-?[0-9.]+)", lambda power: power[1].translate(_RAISED), unit)
    return raised.replace("*", " ")
