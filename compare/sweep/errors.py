"""The errors of a sweep and of its map."""

from typing import Any

import numpy as np

MOST_SEED = 2**32


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""


class MapError(SweepError):
    """A map that can't be read; the message names its path, says why, and what is accepted."""


def require_whole(name: str, value: Any, least: int, most: int) -> None:
    """Refuse an argument that is no whole number from `least` to `most`.

    Raises:
        SweepError: naming the argument, its value and what is accepted.
    """
    is_whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not (is_whole and least <= value <= most):
        raise SweepError(f"{name}: {value!r}, accepted: a whole number from {least} to {most}")
