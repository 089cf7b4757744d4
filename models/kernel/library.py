"""An engine's library: the machine code of its entries, which was built once, and how Python calls it."""

import ctypes
import json
import struct
import threading
from collections.abc import Callable
from functools import cached_property, update_wrapper
from inspect import Signature, signature
from pathlib import Path
from typing import Any, Generic, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.kinds import ValueKind, kinds_of, may_lack, read, write

P = ParamSpec("P")
R = TypeVar("R")

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
        from cointoss.models.kernel.building import library_file  # a wheel's library, too, is found there

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
