"""Sizes of a run, as a command line gives them."""

from collections.abc import Sequence
from contextlib import suppress


class SizeError(ValueError):
    """A size that a study does not take; the message names it, its value and what is accepted."""


def read_sizes(settable: Sequence[str], settings: Sequence[str]) -> dict[str, int]:
    """Return sizes by name, whole numbers such as 1e6.

    Args:
        settable: the sizes that may be given.
        settings: NAME=VALUE each.

    Raises:
        SizeError: for another name or value.
    """
    sizes: dict[str, int] = {}
    for name, _, text in (setting.partition("=") for setting in settings):
        if name not in settable:
            raise SizeError(f"{name}: no such size, accepted: {', '.join(settable) or 'none'}")
        sizes[name] = _whole(name, text)
    return sizes


def _whole(name: str, text: str) -> int:
    with suppress(ValueError):
        if (value := float(text)) >= 1 and value.is_integer():
            return int(value)
    raise SizeError(f"{name}: {text!r}, accepted: a whole number of 1 or more, such as 1e6")
