"""The error of what was seen."""


class ObservationError(ValueError):
    """What was seen and can't be used; the message names file, column, value and what is accepted."""
