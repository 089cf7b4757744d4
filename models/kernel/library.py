"""An engine's library: the machine code of its entries, which was built once, and how Python calls it."""

import ctypes
import json
import os
import platform
import stat
import struct
import sys
import threading
from collections.abc import Callable
from functools import cached_property, update_wrapper
from inspect import Signature, signature
from pathlib import Path
from typing import Any, Generic, NamedTuple, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.base_folder import EngineMissingError, base_folder, is_private
from cointoss.models.kernel.digests import HOME, digest_of
from cointoss.models.kernel.kinds import ValueKind, kinds_of, may_lack, read, write

P = ParamSpec("P")
R = TypeVar("R")

CARRIED = Path(__file__).with_name("engines")
"""The folder in which a wheel carries the libraries."""
SYSTEM = f"{sys.platform}-{platform.machine()}".lower()
"""This system and processor."""
CUDA = "cuda"
"""In its place, NVIDIA's cards: their library is one file of code in PTX and for some of their kinds."""
BROWSER = "wasm32"
"""Or a browser: its library has the entries that a page calls alone, and gets what a page has to know."""
SUFFIX = ".so"
"""The suffix of a library, on every system."""
MANIFEST = f"{SUFFIX}.json"
"""Suffix of the file beside a library that says what it was made of."""
LACKS = ".lacks"
"""Ends the symbol of an entry for arguments of which a number is None."""
AVX2 = ".avx2"
"""Ends the symbols for processors with vectors of four numbers: the same bits, sooner."""
RELEASE = "release"
"""The symbol of what gives back the memory of an array that an entry has returned."""
HAS_AVX2 = "has_avx2"
"""The symbol of what says whether this is one of these processors."""
_ENTRY = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)
"""A function of arguments, of room for what it returns, and of room for an error's address."""


class Library:
    """The library of an engine, loaded when one of its entries is first called."""

    def __init__(self, module: str, *, lacks_none: bool = False) -> None:
        """Load nothing yet.

        Args:
            module: the full name of the engine's table of entries.
            lacks_none: whether no number that may be None ever is, so that nothing is compiled for it.
        """
        self.module, self.lacks_none = module, lacks_none
        self._lock = threading.Lock()

    def entry(self, function: Callable[P, R], *elsewhere: str) -> "Entry[P, R]":
        """Return an entry: the function as Python calls it.

        Args:
            function: a compiled one.
            elsewhere: `CUDA` and `BROWSER`, where it is called there, too. What a card's threads call takes a
                table of rows, and that of their answers, first.
        """
        return Entry(self, function, elsewhere)

    @cached_property
    def loaded(self) -> ctypes.CDLL:
        """The library.

        Raises:
            EngineMissingError: where there is none.
        """
        with self._lock:
            try:
                return ctypes.CDLL(str(self._file))
            except OSError as error:
                raise EngineMissingError(f"{self._file}: can't be loaded: {error}") from None

    @cached_property
    def _file(self) -> Path:
        return library_file(self.module)

    @cached_property
    def _forms(self) -> dict[str, str]:
        return json.loads(Path(f"{self._file}.json").read_bytes())["forms"]

    def symbol(self, name: str, form: str) -> Any:
        """Return the code of a symbol, for this processor where there is some apart.

        Raises:
            EngineMissingError: where there is none, or it passes other numbers than here.
        """
        has_avx2 = getattr(self.loaded, HAS_AVX2, None)
        end = AVX2 if has_avx2 is not None and has_avx2() and hasattr(self.loaded, name + AVX2) else ""
        if self._forms.get(name) != form:
            raise EngineMissingError(
                f"{self._file}: {name} is of another version; install cointoss-dynamics again"
            )
        if not hasattr(self.loaded, name + end):
            raise EngineMissingError(f"{self._file}: was built for another processor; remove it")
        return _ENTRY((name + end, self.loaded))

    @cached_property
    def release(self) -> Callable[[int], object]:
        """Gives back the memory of an array that an entry has returned."""
        function = self.loaded[RELEASE]
        function.argtypes, function.restype = [ctypes.c_void_p], None
        return function


class Entry(Generic[P, R]):
    """A compiled function as Python calls it: its annotations are the kinds of its rows of numbers."""

    def __init__(self, library: Library, function: Callable[P, R], elsewhere: tuple[str, ...] = ()) -> None:
        """Load nothing yet; see `Library.entry`."""
        update_wrapper(self, function)
        self.library, self.function, self.elsewhere = library, function, elsewhere
        self.symbol: str = function.__name__.lstrip("_")
        self._code: dict[bool, Any] = {}

    @cached_property
    def kinds(self) -> tuple[tuple[ValueKind, ...], ValueKind]:
        """The kinds of its arguments, and that of what it returns."""
        function: Any = self.function
        return kinds_of(function.py_func)

    @cached_property
    def _signature(self) -> Signature:
        return signature(self.function)

    @property
    def variants(self) -> tuple[bool, ...]:
        """Whether a number that may be None is, for each of its symbols."""
        both = any(map(may_lack, self.kinds[0])) and not self.library.lacks_none
        return (False, True) if both else (False,)

    @property
    def form(self) -> str:
        """The form of its numbers and of those that it returns."""
        given, returned = self.kinds
        return f"{''.join(kind.form for kind in given)} {returned.form}"

    def symbol_of(self, lacks: bool) -> str:
        """Return the symbol for arguments of which a number is None, or none is."""
        return self.symbol + LACKS * lacks

    def numbers_of(self, *arguments: P.args, **named: P.kwargs) -> NDArray[np.int64]:
        """Return the 8-byte numbers that the function is given.

        Raises:
            TypeError: for an array of another kind.
        """
        form, numbers, _ = self._written(arguments, named)
        return np.frombuffer(struct.pack(form, *numbers), dtype=np.int64)

    def _written(self, arguments: Any, named: Any) -> tuple[str, list[Any], bool]:
        """Return the form of the arguments, their numbers, and whether one of these is None."""
        values = self._signature.bind(*arguments, **named).args if named else arguments
        form: list[str] = ["="]
        numbers: list[Any] = []
        lacks = False
        for kind, value in zip(self.kinds[0], values, strict=True):
            lacks = write(kind, value, form, numbers) or lacks
        return "".join(form), numbers, lacks

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> R:
        """Run the machine code, without Python's lock.

        Raises:
            EngineMissingError: where there is no library.
            TypeError: for an array of another kind.
            FloatingPointError, ValueError, MemoryError: as the function raises them.
        """
        _, returned = self.kinds
        form, numbers, lacks = self._written(arguments, named)
        if lacks not in self._code:
            self._code[lacks] = self.library.symbol(self.symbol_of(lacks), self.form)
        answer, error = (ctypes.c_int64 * len(returned.form))(), ctypes.c_void_p()
        if self._code[lacks](struct.pack(form, *numbers), answer, ctypes.byref(error)) != 0:
            raise _raised(error)
        found = struct.unpack(f"={returned.form}", answer)
        return read(returned, iter(found), self.library.release)


class _Error(ctypes.Structure):
    """What numba's code knows of an error: the pickled class, arguments and place."""

    _fields_ = (("pickled", ctypes.c_void_p), ("size", ctypes.c_int32))


def _raised(address: ctypes.c_void_p) -> Exception:
    import pickle  # of the library's own bytes

    if not address:
        return MemoryError("the engine has no memory left")
    error = ctypes.cast(address, ctypes.POINTER(_Error)).contents
    kind, arguments, _ = pickle.loads(ctypes.string_at(error.pickled, error.size))
    return kind(*arguments)


class Made(NamedTuple):
    """What a library was made of, as its manifest says."""

    module: str
    system: str
    digest: str
    """The digest of the library."""
    sources: dict[str, str]
    """The digests of the project's files that the build has read, by their paths."""
    forms: dict[str, str]
    """The form of each symbol, see `Entry.form`."""

    @classmethod
    def read(cls, file: Path, *, is_carried: bool = False) -> "Made | None":
        """Return what a manifest says, or None where it is none, or another user could have written it.

        Args:
            file: the manifest.
            is_carried: whether it is a wheel's, which whoever installs it may write.
        """
        try:
            described = file.stat()
            if not stat.S_ISREG(described.st_mode) or not (is_carried or is_private(described)):
                return None
            made = cls(**json.loads(file.read_bytes()))
        except (OSError, ValueError, TypeError, RecursionError):
            return None
        is_known = isinstance(made.sources, dict) and isinstance(made.forms, dict)
        return made if is_known and (is_carried or made.sources) else None

    def is_current(self, home: Path = HOME) -> bool:
        """Return whether the sources are those that lie here."""
        return all(digest_of(home / name) == digest for name, digest in self.sources.items())


def library_file(module: str, system: str | None = None) -> Path:
    """Return the file of an engine's library: that which a wheel carries, or the one of the sources here.

    The library of sources that have none yet is built.

    Args:
        module: the full name of the engine's table of entries.
        system: for which it is; by default this one.

    Raises:
        EngineMissingError: in one line.
    """
    system = system or SYSTEM
    name = module.split(".")[-2]
    if CARRIED.is_dir():
        manifest = CARRIED / f"{name}-{system}{MANIFEST}"
        made = Made.read(manifest, is_carried=True)
        if made is None and not manifest.exists():
            others = CARRIED.glob(f"{name}-*{MANIFEST}")
            there = sorted(each.name.removesuffix(MANIFEST).partition("-")[2] for each in others)
            raise EngineMissingError(
                f"{CARRIED}: no {name} engine for {system}; there is: {', '.join(there) or 'none'}"
            )
        file = manifest.with_suffix("")
        if made is None or digest_of(file) != made.digest:
            raise EngineMissingError(f"{file}: is damaged; install cointoss-dynamics again")
        return file
    folder = base_folder() / "engines"
    if (found := current(folder, name, system)) is not None:
        return found
    from cointoss.models.kernel.building import build_once

    build_once(module, folder, [system])
    if (found := current(folder, name, system)) is not None:
        return found
    raise EngineMissingError(f"{folder}: the {name} engine was built, but of other sources; start again")


def current(folder: Path, name: str, system: str = SYSTEM) -> Path | None:
    """Return a library in a folder that is whole, this user's, and made of the sources that lie here."""
    for manifest in folder.glob(f"{name}-{system}-*{MANIFEST}"):
        made, library = Made.read(manifest), manifest.with_suffix("")
        if made is None or not made.is_current() or digest_of(library) != made.digest:
            continue
        if is_private(library.stat()):
            os.utime(manifest)  # what is used is kept
            return library
    return None
