"""The errors of a sweep and of its map."""

from numbers import Integral
from typing import Any

MOST_SEED = 2**32


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""


class MapError(SweepError):
    """A map that can't be read; the message names its path, says why, and what is accepted."""


def is_whole(number: object) -> bool:
    """Return whether a number is whole, and none that stands for a truth."""
    return isinstance(number, Integral) and not isinstance(number, bool)


def require_whole(name: str, value: Any, least: int, most: int) -> None:
    """Refuse an argument that is no whole number from `least` to `most`.

    Raises:
        SweepError: naming the argument, its value and what is accepted.
    """
    if not (is_whole(value) and least <= value <= most):
        raise SweepError(f"{name}: {value!r}, accepted: a whole number from {least} to {most}")
