"""The errors of a sweep and of its map."""


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""


class MapError(SweepError):
    """A map that can't be read; the message names its path, says why, and what is accepted."""
