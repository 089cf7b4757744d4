"""Enums whose members are words to a person, and small integers in arrays and compiled code."""

from enum import IntEnum
from typing import Any


class Word(IntEnum):
    """One word of a list.

    It prints as its word and equals it: `toss.outcome == "heads"`. Else it is its integer, as in compiled
    code and in arrays of codes; `array == Outcome.HEADS` holds of the word and of the code.
    `Outcome("heads")` and `Outcome(1)` make it of either.
    As a key and in a set it stands for its integer, not for its word, which `str(toss.outcome)` is.
    """

    @classmethod
    def _missing_(cls, value: object) -> "Word":
        for member in cls:
            if isinstance(value, str) and member == value:
                return member
        raise ValueError(f"{cls.__name__}: {value!r}, accepted: {', '.join(map(str, cls))}")

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
        return (str(self) if _is_text(other) else int(self)) == other

    def __ne__(self, other: Any) -> Any:
        """Return the opposite of `==`."""
        return (str(self) if _is_text(other) else int(self)) != other


def _is_text(value: Any) -> bool:
    """Return whether a value is a text, or an array of texts."""
    return isinstance(value, str) or getattr(getattr(value, "dtype", None), "kind", "") in ("U", "T")
