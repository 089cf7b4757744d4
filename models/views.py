"""What shows records: records draw nothing themselves, and the package's front names here what does."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

HOMES: dict[str, str] = {}
"""By the name of each function that shows a record its module; `cointoss/__init__.py` fills this."""


def view(name: str) -> Callable[..., Any]:
    """Return a function that shows a record."""
    return getattr(import_module(HOMES[name]), name)
