"""Enums whose members are words to a person, and small integers in arrays and compiled code."""

import operator
import warnings
from collections.abc import Callable
from enum import IntEnum
from typing import Any

from cointoss.models.errors import meant


class Word(IntEnum):
    """One word of a list.

    It prints as its word and equals it: `toss.outcome == "heads"`. Else it is its integer, as in compiled
    code and in arrays of codes; `array == Outcome.HEADS` holds of the word and of the code.
    `Outcome("heads")` and `Outcome(1)` make it of either.
    As a key and in a set it stands for its integer, not for its word, which `str(toss.outcome)` is; a contact
    law stands for its word.
    A comparison with a text that is nearly a word of the list, such as "Heads", is False with a warning.
    """

    @classmethod
    def _missing_(cls, value: object) -> "Word":
        for member in cls:
            if isinstance(value, str) and value == str(member):
                return member
        near = meant(str(value).lower(), map(str, cls))
        raise ValueError(f"{cls.__name__}: {value!r}, {near}accepted: {', '.join(map(str, cls))}")

    @classmethod
    def by_value(cls) -> dict[int, str]:
        """Return the words by their integers."""
        return {member.value: str(member) for member in cls}

    def __str__(self) -> str:
        """Return the word."""
        return self.name.lower()

    def __repr__(self) -> str:
        """Return the member as it is written in Python."""
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, format_spec: str) -> str:
        """Return the word, formatted as text."""
        return format(str(self), format_spec)

    # Things that are equal should have one hash, and a word and an integer have two. The integer's is kept:
    # codes from arrays are looked up among members.
    __hash__ = IntEnum.__hash__

    # NumPy leaves the comparison of an array with a word to the word.
    __array_ufunc__ = None

    def __eq__(self, other: Any) -> Any:
        """Return whether the other is this word, or equals its integer; of an array, for each."""
        return self._compared(operator.eq, other)

    def __ne__(self, other: Any) -> Any:
        """Return the opposite of `==`."""
        return self._compared(operator.ne, other)

    def _compared(self, how: Callable[[Any, Any], Any], other: Any) -> Any:
        """Return a comparison's result; warn of a text that is no word of the list, but nearly one."""
        if isinstance(other, str) and other and other not in (words := [*map(str, type(self))]):
            begun = [word for word in words if word.startswith(other.lower())]  # as H for heads
            if near := meant(begun[0] if begun else other.lower(), words):
                warnings.warn(f"{type(self).__name__} == {other!r}: {near.rstrip()}", stacklevel=3)
        is_array_of_texts = getattr(getattr(other, "dtype", None), "kind", "") in ("U", "T")
        return how(str(self) if isinstance(other, str) or is_array_of_texts else int(self), other)
