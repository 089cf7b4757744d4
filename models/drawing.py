"""The modules that show records, each found by its name when it is asked for, as pandas finds its own."""

from importlib import import_module
from typing import Any


def plots() -> Any:
    """Return the module that draws records, and imports Matplotlib."""
    return import_module("cointoss.compare.output.plots")


def player() -> Any:
    """Return the module that makes the page of a toss."""
    return import_module("cointoss.compare.web.play.frame")


def explorer() -> Any:
    """Return the module that makes the page of a map."""
    return import_module("cointoss.compare.explorer.static")
