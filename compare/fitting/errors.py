"""The error of what was seen."""


class ObservationError(ValueError):
    """What was seen and can't be used; the message names file, column, value and what is accepted."""


class ValueRefusedError(ObservationError):
    """A number of an array of a record that no observation has."""

    def __init__(self, name: str, index: int, value: object, accepted: str, record: str = "Observed") -> None:
        """Keep which number of which array it is, its value, and what is accepted."""
        super().__init__(f"{record}.{name}: [{index}] is {value}, accepted: {accepted}")
        self.name, self.index, self.value, self.accepted = name, index, value, accepted
