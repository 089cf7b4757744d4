"""The files of a study: what it says of itself, and what a run leaves of it."""

import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

FOLDER = "reproduction"
"""Holds the folders of all that was reproduced."""
CLAIMS = "claims.json"
"""The claims of a run, with their verdicts."""
TABLE = "cells.csv"
"""The table of a run, where it makes one."""
PROVENANCE = "provenance.json"
"""What a run was made of; earlier runs have no such file."""
MOST_BYTES = 1 << 26
"""The most bytes of each of these files."""
PAGE = "index.md"
"""The page of a figure of the paper."""
SHEETS = tuple(f"table-{number}.csv" for number in range(1, 20))
"""Long tables that a page shows."""


def folder_of(name: str, out: Path) -> Path:
    """Return the folder of what a run of a study writes below `out`."""
    return out / FOLDER / name


def said_by(module: str) -> dict[str, Any]:
    """Return what the TOML file beside a module says; the module is not imported.

    Args:
        module: its full name.
    """
    package, _, name = module.rpartition(".")
    return tomllib.loads((resources.files(package) / f"{name}.toml").read_text(encoding="utf-8"))
