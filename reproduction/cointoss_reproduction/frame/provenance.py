"""What a run was made of: its sources, the versions and the machine; and what it wrote, by hash."""

import hashlib
import json
import platform
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from cointoss.study import code_digest, engine_digests, versions_of

PROVENANCE = "provenance.json"
"""Lies beside the claims of a run; earlier runs have none."""
PACKAGES = ("mujoco", "numpy", "scipy")
"""Those whose numbers a result is made of."""
_OUTPUTS = ("claims.json", "numbers.json", "cells.csv")
_BOOK = Path(__file__).parents[1]


def provenance(folder: Path, *, quick: bool) -> dict[str, Any]:
    """Return what a run was made of, and the hashes of what it wrote.

    Args:
        folder: that was written.
        quick: whether it was the smaller size.
    """
    written = {name: folder / name for name in _OUTPUTS if (folder / name).exists()}
    return {
        "sources": sources(),
        "engines": engine_digests(),
        "quick": quick,
        "versions": {"python": platform.python_version(), **versions_of(PACKAGES)},
        "machine": machine(),
        "sha256": {name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in written.items()},
    }


@cache
def sources() -> str:
    """Return the digest of the sources of cointoss and of its studies."""
    digest = hashlib.sha256(code_digest().encode())
    for file in sorted(path for path in _BOOK.rglob("*") if path.suffix in (".py", ".toml")):
        digest.update(f"{file.relative_to(_BOOK)} ".encode() + file.read_bytes())
    return digest.hexdigest()[:16]


def older(folder: Path) -> str:
    """Return in words by which engines other than those here a run was made, empty where by none.

    Raises:
        ValueError: as `read_provenance`.
    """
    made_of = read_provenance(folder)
    if made_of is None or "engines" not in made_of:
        return "does not say by which engines it was made"
    if made_of["machine"] != machine():
        return f"was made on another system, {' '.join(made_of['machine'].values())}"
    other = [name for name, digest in engine_digests().items() if made_of["engines"].get(name) != digest]
    return f"is older than {' and '.join(other)}" if other else ""


def machine() -> dict[str, str]:
    """Return the kind of this machine, and the C library of what the engines do not compute."""
    return {
        "system": sys.platform,
        "architecture": platform.machine(),
        "libc": " ".join(filter(None, platform.libc_ver())),
    }


def read_provenance(folder: Path) -> dict[str, Any] | None:
    """Return what a run in a folder was made of, None where it did not say.

    Raises:
        ValueError: for a file that is not as `provenance` gives it.
    """
    path = folder / PROVENANCE
    if not path.exists():
        return None
    made_of = json.loads(path.read_text(encoding="utf-8"))
    kinds = {"sources": str, "quick": bool, "versions": dict, "machine": dict}
    if not (isinstance(made_of, dict) and all(isinstance(made_of.get(key), kinds[key]) for key in kinds)):
        raise ValueError(f"needs {', '.join(kinds)}")
    return made_of


def unlike(there: Mapping[str, Any] | None, here: Mapping[str, Any]) -> str:
    """Return, in words, by what two runs differ that may change their bits; empty where by nothing."""
    if there is None:
        return f"no {PROVENANCE} there"
    other = ["other sources"] if there["sources"] != here["sources"] else []
    for kind in ("versions", "machine"):
        other += [
            f"{name} {there[kind].get(name)} there, {value} here"
            for name, value in here[kind].items()
            if there[kind].get(name) != value
        ]
    return "; ".join(other)
