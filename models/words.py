"""Enums whose members are words to a person, and small integers in arrays and compiled code."""

from enum import IntEnum
from typing import Any


class Word(IntEnum):
    """One word of a list.

    It prints as its word and equals it, also as a key and in a set: `toss.outcome == "heads"`. In an array
    and in compiled code it is its integer: `outcomes.outcome == Outcome.HEADS`. `Outcome("heads")` and
    `Outcome(1)` make it of either. It equals a plain integer too, but a set or dictionary of integers does
    not find it.
    """

    @classmethod
    def _missing_(cls, value: object) -> "Word":
        for member in cls:
            if isinstance(value, str) and member == value:
                return member
        raise ValueError(f"{cls.__name__}: {value!r}, accepted: {', '.join(map(str, cls))}")

    def __str__(self) -> str:
        """Return the word."""
        return self.name.lower()

    def __repr__(self) -> str:
        """Return the member as it is written in Python."""
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, format_spec: str) -> str:
        """Return the word, formatted as text."""
        return format(str(self), format_spec)

    # Equal things must have one hash, which a word and an integer can't both share with the member: the word
    # does, for `{"heads": ..., "tails": ...}[toss.outcome]` is what people write.
    def __hash__(self) -> int:
        """Return the hash of the word."""
        return hash(str(self))

    def __eq__(self, other: Any) -> Any:
        """Return whether the other is this word, or a number equal to its integer; of an array, for each."""
        return str(self) == str(other) if isinstance(other, str | Word) else int(self) == other

    def __ne__(self, other: Any) -> Any:
        """Return the opposite of `==`."""
        return str(self) != str(other) if isinstance(other, str | Word) else int(self) != other
