"""Keep compiled code on disk, for exactly the sources that it was made of."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

import fcntl
import hashlib
import os
import pickle
import re
import shutil
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

from numba.core import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile, _CacheLocator
from numba.core.runtime import rtsys

from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.sources import part_of, source_hash

UNUSED = 3 * 24 * 3600.0
"""Folders not used for so long are removed when another is made [s]."""
PATIENCE = 600.0
"""How long to wait at most while another process compiles the same function [s]."""
CALLEE = "callee-"
"""How the names of files begin that keep code for compiled callers."""
_DIGEST = hashlib.sha256().digest_size
_FOLDER = re.compile(r"cointoss\.[\w.]+-[0-9a-f]{16}")


@cache
def cache_folder(module: str) -> Path:
    """Return the folder of the compiled code of one module, for exactly these sources.

    numba checks only the file of the function it compiles, so an edit in a function that this one calls would
    go unnoticed. The folder's name is a hash of the module's source and of all that it imports, directly or
    not, from this project: an edit in any of them starts a new folder, an edit elsewhere does not.

    Args:
        module: its full name, in this project.

    Returns:
        A folder below $NUMBA_CACHE_DIR, else below the user's cache, else below the temporary folder.
    """
    folder = _base() / f"{module}-{source_hash(module)}"
    try:
        # What is used is kept: see `remove_unused`.
        os.utime(folder)
    except OSError:
        remove_unused(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)
    return folder


@cache
def _base() -> Path:
    for base in _bases():
        try:
            base.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError:
            continue
        # In another user's folder there may be another's code, and none of ours.
        if os.access(base, os.W_OK) and base.stat().st_uid == os.geteuid():
            return base
    return Path(tempfile.mkdtemp(prefix="cointoss-"))


@cache
def _turns() -> int:
    """Return the file whose bytes stand for functions that are compiled; closed, it would lose all locks."""
    return os.open(_base() / "compiling.lock", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)


@contextmanager
def turn(name: str) -> Iterator[bool]:
    """Wait while another process is within this for the same name; return whether one was.

    Where nothing can be locked, or the other takes longer than `PATIENCE`, nothing more is waited for. The
    system lets go of the lock of a process that ends, however it ends.
    """
    place = int(hashlib.sha256(name.encode()).hexdigest()[:15], 16)
    is_busy = not _locked(place)
    if is_busy:
        deadline = time.monotonic() + PATIENCE
        with compiling.waiting():
            while not _locked(place) and time.monotonic() < deadline:
                time.sleep(0.05)
    try:
        yield is_busy
    finally:
        with suppress(OSError):
            fcntl.lockf(_turns(), fcntl.LOCK_UN, 1, place)


def _locked(place: int) -> bool:
    """Lock a byte; return whether no other process has it."""
    try:
        fcntl.lockf(_turns(), fcntl.LOCK_EX | fcntl.LOCK_NB, 1, place)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:  # a file system without locks
        return True
    return True


def kept_functions(module: str) -> int:
    """Return how many functions of a module are kept for compiled callers."""
    if not part_of(module):
        return 0
    try:
        return len(list(cache_folder(module).glob(f"{CALLEE}*.nbi")))
    except OSError:  # no folder can be made, as on a full disk
        return 0


def _bases() -> Iterator[Path]:
    """Return where code may be kept, the first choice first."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(chosen)
    if caches := os.environ.get("XDG_CACHE_HOME"):
        yield Path(caches, "cointoss")
    with suppress(RuntimeError):  # a user without a home
        yield Path("~/.cache/cointoss").expanduser()


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


class _Locator(_CacheLocator):
    """Where the code of a function is kept."""

    def __init__(self, module: str, py_file: str) -> None:
        self._module, self._py_file = module, py_file

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> "_Locator":
        return cls(py_func.__module__, py_file)

    def ensure_cache_path(self) -> None:
        Path(self.get_cache_path()).mkdir(mode=0o700, parents=True, exist_ok=True)

    def get_cache_path(self) -> str:
        return str(cache_folder(self._module))

    def get_source_stamp(self) -> str:
        return source_hash(self._module)

    def get_disambiguator(self) -> str:
        return self._module


class LocatedImpl(CompileResultCacheImpl):
    """How a function compiled for Python is kept: as numba does, in the folder of its module."""

    _locator_classes: ClassVar = [_Locator]


class CodeFiles(IndexDataCacheFile):
    """The files of one function: an index, and the code for each kind of arguments.

    numba numbers the code's files, and two processes that compile at once may give one number to code for
    different arguments; then a third would run the one for the other.

    Machine code is run as it is read. A file begins with a digest, so that one whose bits have changed is as
    if it were missing, and so is one that another user could have written.
    """

    def load(self, key: Any) -> Any:
        """Return what is kept for these kinds of arguments, or None."""
        name = self._load_index().get(key)
        return None if name is None else self._load(name)

    def _load_index(self) -> dict[Any, str]:
        """Return the names of the code's files by kinds of arguments."""
        return self._load(self._index_name) or {}

    def _load(self, name: str) -> Any:
        """Return what a file keeps, or None where it is missing, damaged, or another's.

        A function need not import the types of its arguments, so that its folder outlives them: what names a
        type that has gone is of other sources, and pickle may raise any error.
        """
        try:
            with Path(self._cache_path, name).open("rb") as file:
                kept, about = file.read(), os.fstat(file.fileno())
            if about.st_uid != os.geteuid() or about.st_mode & 0o022:
                return None
            digest, data = kept[:_DIGEST], kept[_DIGEST:]
            return pickle.loads(data) if digest == self._digest(name, data) else None
        except Exception:
            return None

    def _digest(self, name: str, data: bytes) -> bytes:
        """Return the digest of what a file keeps, for one name, one version of numba and one source."""
        about = f"{name} {self._version} {self._source_stamp}\n"
        return hashlib.sha256(about.encode() + data).digest()

    def save(self, key: Any, data: Any) -> None:
        """Keep code in a new file, and after that say so in the index."""
        name = f"{Path(self._index_path).stem}.{uuid.uuid4().hex}.nbc"
        self._save_data(name, data)
        overloads = self._load_index()
        former = overloads.get(key)
        self._save_index({**overloads, key: name})
        if former is not None:
            Path(self._cache_path, former).unlink(missing_ok=True)

    def _save_index(self, overloads: dict[Any, str]) -> None:
        self._write(self._index_name, overloads)

    def _save_data(self, name: str, data: Any) -> None:
        self._write(name, data)

    def _write(self, name: str, data: Any) -> None:
        kept = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            os.fchmod(file.fileno(), 0o600)
            file.write(self._digest(name, kept) + kept)


class CodeCache(FunctionCache):
    """Keeps what is compiled of one function."""

    _impl_class: type[CompileResultCacheImpl] = LocatedImpl

    def __init__(self, py_func: Any) -> None:
        """Find the function's files."""
        super().__init__(py_func)
        self._cache_file = CodeFiles(
            self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
        )

    def turn(self) -> AbstractContextManager[bool]:
        """Let one process at a time compile this function; see `turn`."""
        return turn(str(Path(self._cache_path, self._impl.filename_base)))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return what is kept for these types of arguments, or None.

        To read it numba would import all that it can compile, which takes longer than most tosses.
        """
        rtsys.initialize(target_context)
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled; where nothing can be written, the next process compiles anew."""
        with suppress(OSError):
            super().save_overload(sig, data)

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        # To numba two named tuples of one name and of the same types are one type.
        return *super()._index_key(sig, codegen), tuple(map(_fields, sig))


def _fields(kind: Any) -> Any:
    """Return the names of the fields of a type, if it is a tuple with or of named ones."""
    parts = tuple(map(_fields, kind.types)) if isinstance(kind, types.BaseTuple) else ()
    return getattr(kind, "fields", ()) if isinstance(kind, types.BaseNamedTuple) else (), parts
