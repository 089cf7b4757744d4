"""The folder below which all is kept from one process to the next."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path


@cache
def base_folder() -> Path:
    """Return a folder of the user alone: $NUMBA_CACHE_DIR, else the user's cache, else a temporary one."""
    for base in _bases():
        try:
            base.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError:
            continue
        # In another user's folder there may be another's code, and none of ours.
        if os.access(base, os.W_OK) and is_own(base.stat()):
            return base
    return Path(tempfile.mkdtemp(prefix="cointoss-"))


def is_own(described: os.stat_result) -> bool:
    """Return whether a file or a folder is this user's; Windows keeps others out of a user's folders."""
    return not hasattr(os, "geteuid") or described.st_uid == os.geteuid()


def can_others_write(described: os.stat_result) -> bool:
    """Return whether other users can write to a file; the bits say nothing of that on Windows."""
    return hasattr(os, "geteuid") and bool(described.st_mode & 0o022)


def _bases() -> Iterator[Path]:
    """Return where code may be kept, the first choice first."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(chosen)
    if caches := os.environ.get("XDG_CACHE_HOME"):
        yield Path(caches, "cointoss")
    if caches := os.environ.get("LOCALAPPDATA"):  # Windows
        yield Path(caches, "cointoss")
    with suppress(RuntimeError):  # a user without a home
        yield Path("~/.cache/cointoss").expanduser()
