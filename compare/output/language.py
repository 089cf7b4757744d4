"""The language of a message: the keywords of Python, or the options of the command line."""

import re
from collections.abc import Iterable, Mapping
from typing import TypeVar

Entry = TypeVar("Entry")
_KEYWORD = re.compile(r"`([a-z]+(?:_[a-z]+)*)`")


def listed(things: Iterable[object]) -> str:
    """Return things as a sentence lists them: "a", "a and b", "a, b and c"."""
    *first, last = map(str, things)
    return f"{', '.join(first)} and {last}" if first else last


def entry_of(found: Mapping[str, Entry], name: str) -> Entry:
    """Return what was found under a name.

    Raises:
        KeyError: for another name, with those that are accepted.
    """
    if name not in found:
        raise KeyError(f"{name}: accepted: {', '.join(found)}")
    return found[name]


def option_of(keyword: str) -> str:
    """Return the option of a keyword, as "--contact-steps" of "contact_steps"; "with_" is "--with"."""
    return f"--{keyword.rstrip('_').replace('_', '-')}"


def in_options(message: str) -> str:
    """Return a message whose keywords, in backticks, are the options of the command line."""
    return _KEYWORD.sub(lambda found: option_of(found[1]), message)
