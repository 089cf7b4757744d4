"""The error of a sweep."""


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""
