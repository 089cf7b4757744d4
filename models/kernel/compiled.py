"""Compile a function with numba and keep the machine code for the next process."""

import hashlib
import os
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numba
from numba.core import config

COMPILED_PACKAGES = {
    "models": ("models",),
    "analytic": ("models", "analytic"),
    "coin_mj": ("models", "coin_mj"),
}
"""Packages with compiled functions, each with those whose functions and records its own may use."""


@cache
def cache_folder(package: str) -> Path:
    """Return the folder of the machine code of one package, for exactly these sources.

    numba checks only the file of the function it compiles, so an edit in a function that this one calls would
    go unnoticed. The folder's name is a hash of every source that the package's functions may use: an edit in
    any of them starts a new folder.

    Args:
        package: one of `COMPILED_PACKAGES`.

    Returns:
        A folder below $NUMBA_CACHE_DIR, else below the user's cache, else below the temporary folder.
    """
    top = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for used in COMPILED_PACKAGES[package]:
        for source in sorted((top / used).rglob("*.py")):
            digest.update(f"{source.relative_to(top).as_posix()}\n".encode())
            digest.update(source.read_bytes())
    name = f"cointoss-{package}-{digest.hexdigest()[:16]}"
    for base in _cache_bases():
        folder = base / name
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return folder
    return Path(tempfile.mkdtemp(prefix="cointoss-"))


def _cache_bases() -> list[Path]:
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    user = Path(os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser())
    return [*([Path(chosen)] if chosen else []), user / "cointoss"]


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile `function` at its first call, without the GIL, and cache the machine code on disk.

    It must be defined in one of `COMPILED_PACKAGES`.
    """
    # numba has no argument for the folder: it reads this setting when the function is declared.
    settings = config.__dict__
    before = settings["CACHE_DIR"]
    settings["CACHE_DIR"] = str(cache_folder(function.__module__.partition(".")[0]))
    try:
        return numba.njit(cache=True, nogil=True, error_model="numpy")(function)
    finally:
        settings["CACHE_DIR"] = before
