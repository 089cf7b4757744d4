"""What an option of a command accepts, written as an annotation of the field that it fills."""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple


class Within(NamedTuple):
    """A whole number between two bounds."""

    least: int
    most: int
    """The largest number accepted; both bounds are included."""


class Written(NamedTuple):
    """A place that is written."""

    suffixes: tuple[str, ...] = ()
    """What its name ends in: one of them, or anything where there is none."""
    kind: Literal["file", "text", "map", "folder"] = "file"
    """A text may go to a pipe or a device, too; of a map the name and the folder alone are checked."""


class Form(NamedTuple):
    """A text of a certain form."""

    shown: str
    """The form as help shows it, such as WIDTHxHEIGHT."""
    read: Callable[[str], Any] | None = None
    """Returns the value of a text, or raises ValueError with what is accepted; None for the text itself.

    The value's `str` is a text that it reads.
    """
