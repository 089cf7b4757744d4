"""The errors of a sweep and of its map."""

import numpy as np

MOST_SEED = 2**32


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""


class MapError(SweepError):
    """A map that can't be read; the message names its path, says why, and what is accepted."""


def require_whole(name: str, value: object, least: int, most: int) -> None:
    """Refuse an argument that is no whole number from `least` to `most`.

    Raises:
        SweepError: naming the argument, its value and what is accepted.
    """
    whole = None if isinstance(value, bool) or not isinstance(value, int | np.integer) else int(value)
    if whole is None or not least <= whole <= most:
        raise SweepError(f"{name}: {value!r}, accepted: a whole number from {least} to {most}")
