"""The folder of this user alone in which what was built is kept from one process to the next."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path


class EngineMissingError(ImportError):
    """There is no library of an engine for this system, and it can't be built; the message says why."""


@cache
def base_folder() -> Path:
    """Return a folder of the user alone: $COINTOSS_CACHE, else in the user's cache, else a temporary one.

    Raises:
        EngineMissingError: where $COINTOSS_CACHE can't be one.
        OSError: where none can be made.
    """
    chosen = os.environ.get("COINTOSS_CACHE")
    for base in [Path(chosen)] if chosen else _bases():
        try:
            base.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError:
            continue
        # In another user's folder there may be another's code, and none of ours.
        if os.access(base, os.W_OK) and is_private(base.stat()):
            return base
    if chosen:
        raise EngineMissingError(
            f"COINTOSS_CACHE = {chosen!r}: accepted: a folder in which this user alone can write"
        )
    return Path(tempfile.mkdtemp(prefix="cointoss-"))


def is_private(described: os.stat_result) -> bool:
    """Return whether a file or a folder is this user's, and no other can write there.

    Windows keeps others out of a user's folders, and says nothing of it by these numbers.
    """
    if not hasattr(os, "geteuid"):
        return True
    return described.st_uid == os.geteuid() and not described.st_mode & 0o022


def write_whole(file: Path, content: bytes) -> None:
    """Write a file aside, then rename it: no process ever sees half of it."""
    aside = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        with os.fdopen(os.open(aside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as opened:
            opened.write(content)
        aside.replace(file)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise


def _bases() -> Iterator[Path]:
    """Yield where it may lie, the first choice first."""
    if caches := os.environ.get("XDG_CACHE_HOME"):
        yield Path(caches, "cointoss")
    if caches := os.environ.get("LOCALAPPDATA"):  # Windows
        yield Path(caches, "cointoss")
    with suppress(RuntimeError):  # a user without a home
        yield Path("~/.cache/cointoss").expanduser()
    if hasattr(os, "geteuid"):
        yield Path(tempfile.gettempdir(), f"cointoss-{os.geteuid()}")
