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
        if os.access(base, os.W_OK) and base.stat().st_uid == os.geteuid():
            return base
    return Path(tempfile.mkdtemp(prefix="cointoss-"))


def _bases() -> Iterator[Path]:
    """Return where code may be kept, the first choice first."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(chosen)
    if caches := os.environ.get("XDG_CACHE_HOME"):
        yield Path(caches, "cointoss")
    with suppress(RuntimeError):  # a user without a home
        yield Path("~/.cache/cointoss").expanduser()
