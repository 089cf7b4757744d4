"""The errors of bad input, and how a message shows a value and a name that may be meant."""

import difflib
from collections.abc import Iterable
from typing import Any


class ScenarioError(ValueError):
    """A scenario that can't be used; the message names file, field, value and what is accepted."""


class FieldError(ValueError):
    """A value that only its neighbours show to be wrong: it names its field itself."""

    def __init__(self, field: str, value: Any, accepted: str, asked: str = "") -> None:
        """Keep the field's dotted path below the part that refuses it, its value, and what is accepted.

        Before it stands what is asked, of numbers that were probably meant in another unit.
        """
        super().__init__(f"{asked}{field} = {shown(value)}: accepted: {accepted}")
        self.field, self.value, self.accepted, self.asked = field, value, accepted, asked


def require_type(name: str, value: object, kind: type, accepted: str) -> None:
    """Refuse an argument of another type.

    Raises:
        TypeError: naming the argument, its type and what is accepted.
    """
    if not isinstance(value, kind):
        raise TypeError(f"{name}: of type {type(value).__name__}, accepted: {accepted}")


def shown(value: Any) -> str:
    """Return a value as a message shows it, cut where it is long."""
    if isinstance(value, type):
        return value.__name__
    if hasattr(value, "model_dump"):  # a part of a scenario; pydantic and numpy are not imported for it
        value = value.model_dump(exclude_none=True)
    if isinstance(value, tuple):
        value = list(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    try:
        text = f'"{value}"' if isinstance(value, str) else str(value)
    except (ValueError, RecursionError):  # an integer of too many digits, a table nested too deeply
        return "(too long to show)"
    return text if len(text) <= 80 else text[:77] + "..."


def meant(name: str, known: Iterable[str]) -> str:
    """Return "did you mean KNOWN? " of the known name that is most like a wrong one, "" where none is."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {near[0]}? " if near else ""
