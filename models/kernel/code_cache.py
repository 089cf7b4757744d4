"""The folders of compiled code, one for exactly the sources that it was made of, and who may compile."""

import hashlib
import os
import re
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cointoss.models.kernel.base_folder import base_folder
from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.fork import numba_version
from cointoss.models.kernel.libm import libm_digest
from cointoss.models.kernel.sources import is_as_imported, part_of, source_hash

if TYPE_CHECKING:
    from filelock import FileLock

UNUSED = 3 * 24 * 3600.0
"""Folders not used for so long are removed when another is made [s]."""
PATIENCE = 600.0
"""How long to wait at most while another process compiles the same function [s]."""
_FOLDER = re.compile(r"cointoss\.[\w.]+(-[0-9a-f]{16}){1,2}")


@cache
def cache_folder(module: str) -> Path:
    """Return the folder of the compiled code of one module, for exactly these sources.

    numba checks only the file of the function it compiles, so an edit in a function that this one calls would
    go unnoticed. The folder's name is a hash of the module's source and of all that it imports, directly or
    not, from this project: an edit in any of them starts a new folder, an edit elsewhere does not. Code that
    calls musl's functions has a folder of its own.

    Args:
        module: its full name, in this project.

    Returns:
        A folder below $NUMBA_CACHE_DIR, else below the user's cache, else below the temporary folder.
    """
    folder = base_folder() / "-".join(filter(None, (module, source_hash(module), libm_digest())))
    try:
        # What is used is kept: see `remove_unused`.
        os.utime(folder)
    except OSError:
        remove_unused(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)
    return folder


@contextmanager
def turn(name: str) -> Iterator[bool]:
    """Wait while another process is within this for the same name; return whether one was.

    Where nothing can be locked, or the other takes longer than `PATIENCE`, nothing more is waited for. The
    system lets go of the lock of a process that ends, however it ends.
    """
    from filelock import FileLock  # nothing is compiled by most processes

    file = base_folder() / f"{hashlib.sha256(name.encode()).hexdigest()[:16]}.lock"
    lock = FileLock(file, blocking=False)
    is_busy = not _locked(lock)
    if is_busy:
        deadline = time.monotonic() + PATIENCE
        with compiling.waiting():
            while not _locked(lock) and time.monotonic() < deadline:
                time.sleep(0.05)
    try:
        yield is_busy
    finally:
        with suppress(OSError):
            if lock.is_locked:
                file.unlink()  # while it is held: on Windows it goes when it is let go of
        with suppress(OSError):
            lock.release()


def _locked(lock: "FileLock") -> bool:
    """Lock a file; return whether no other process has it."""
    from filelock import Timeout

    try:
        lock.acquire()
    except Timeout:
        return False
    except OSError:  # a file system without locks
        return True
    return True


def is_kept(module: str) -> bool:
    """Return whether code of a module is kept: it is ours, of sources as they are, and can be written."""
    try:
        return bool(part_of(module)) and is_as_imported(module) and cache_folder(module).is_dir()
    except OSError:  # no folder can be made, as on a full disk
        return False


def kept_functions(prefix: str, module: str) -> int:
    """Return how many functions of a module are kept, in files whose names begin so."""
    stem = module.rpartition(".")[2]
    return len(list(cache_folder(module).glob(f"{prefix}{stem}.*.nbi"))) if is_kept(module) else 0


def remove_unused(base: Path) -> None:
    """Remove our folders below `base` that no process has begun to use for long.

    A process that still uses one compiles anew what it has not read yet.
    """
    for folder in base.glob("cointoss.*"):
        try:
            unused = time.time() - folder.stat().st_mtime
        except OSError:
            continue
        if unused > UNUSED and _FOLDER.fullmatch(folder.name):
            shutil.rmtree(folder, ignore_errors=True)


class Locator:
    """Where the code of a function is kept, as numba asks for it."""

    def __init__(self, function: Callable[..., Any], file: str) -> None:
        """Locate the code of one function."""
        self._module, self._py_file = function.__module__, file

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> "Locator":
        """Return the locator of a function's code."""
        return cls(function, file)

    def ensure_cache_path(self) -> None:
        """Make the folder, where another process has removed it."""
        Path(self.get_cache_path()).mkdir(mode=0o700, parents=True, exist_ok=True)

    def get_cache_path(self) -> str:
        """Return the folder."""
        return str(cache_folder(self._module))

    def get_source_stamp(self) -> str:
        """Return the hash of the function's module and of all it imports."""
        return source_hash(self._module)

    def get_disambiguator(self) -> str:
        """Return numba's version, for the names of the files: one version would make the other's anew."""
        return numba_version()
