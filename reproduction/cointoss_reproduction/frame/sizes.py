"""Sizes of a run, as a command line gives them."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any


class SizeError(ValueError):
    """A size that a study does not take; the message names it, its value and what is accepted."""


def read_sizes(usual: Mapping[str, Any], settings: Sequence[str]) -> dict[str, Any]:
    """Return sizes by name: words where the usual one is a word, else whole numbers, such as 1e6.

    Args:
        usual: the sizes that may be given.
        settings: NAME=VALUE each.

    Raises:
        SizeError: for another name or value.
    """
    sizes: dict[str, Any] = {}
    for name, _, text in (setting.partition("=") for setting in settings):
        if name not in usual:
            raise SizeError(f"{name}: no such size, accepted: {', '.join(usual) or 'none'}")
        sizes[name] = text if isinstance(usual[name], str) else _whole(name, text)
    return sizes


def _whole(name: str, text: str) -> int:
    with suppress(ValueError):
        if (value := float(text)) >= 1 and value.is_integer():
            return int(value)
    raise SizeError(f"{name}: {text!r}, accepted: a whole number of 1 or more, such as 1e6")
