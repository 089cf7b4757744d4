"""What is refused, and what is warned of."""

from typing import Any


class FieldError(ValueError):
    """A value that can't be used."""

    def __init__(self, field: str, value: Any, accepted: str) -> None:
        """Keep what is wrong, its value, and what is accepted."""
        shown = f'"{value}"' if isinstance(value, str) else str(value)
        super().__init__(f"{field} = {shown}: accepted: {accepted}")
        self.field, self.value, self.accepted = field, value, accepted


class DeepContactWarning(UserWarning):
    """A contact is so deep that a floor may let the body through."""
