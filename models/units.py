"""A number with its unit, written as a string, in SI."""

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pint import UnitRegistry


def in_si(text: str, unit: str) -> float:
    """Read a quantity such as "1.25 cm" or "7 deg" as a number of `unit`.

    Args:
        text: a number and a unit.
        unit: the SI unit of the answer, in pint's spelling; "" for a pure number.

    Raises:
        ValueError: if the text is no quantity, or not one of the dimension of `unit`.
    """
    import pint

    try:
        quantity = _registry().Quantity(text)
        return float(quantity.to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError as error:
        raise ValueError(f"a quantity in units of {unit or '1'}") from error
    except Exception as error:  # pint lets the errors of its tokenizer and of its arithmetic through
        raise ValueError(f"a number, or a string with a unit such as {_example(unit)}") from error


def _example(unit: str) -> str:
    examples = {"m": '"1.25 cm"', "rad": '"7 deg"', "kg": '"2 g"', "s": '"500 ms"', "": '"60 %"'}
    return examples.get(unit, f'"1 {unit}"')


@cache
def _registry() -> "UnitRegistry":
    import pint

    return pint.UnitRegistry()
