"""The module that draws records, found by its name when a plot is asked for, as pandas finds its own."""

from importlib import import_module
from typing import Any

DRAWS = "cointoss.compare.output.plots"


def plots() -> Any:
    """Return the module that draws records, and imports Matplotlib."""
    return import_module(DRAWS)
