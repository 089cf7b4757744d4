"""A compiled function: called from Python it runs kept machine code, and needs no numba for that."""

import hashlib
import pickle
from collections.abc import Callable
from contextlib import nullcontext, suppress
from functools import update_wrapper
from inspect import signature
from pathlib import Path
from typing import Any, cast

from cointoss.models.kernel.code_cache import cache_folder, is_kept, turn
from cointoss.models.kernel.fork import numba_version
from cointoss.models.kernel.fork.machine_code import Kept, MachineCode, processor
from cointoss.models.kernel.fork.values import Passed, passed
from cointoss.models.kernel.kept_file import read_object, write_kept
from cointoss.models.kernel.sources import source_hash


class CompiledFunction:
    """A function compiled for its compiled callers; called from Python, it is made into machine code.

    See `cointoss.models.kernel.fork.callee_code`.
    """

    def __init__(self, function: Callable[..., Any], *, inlined: bool = False) -> None:
        """Compile nothing yet; an `inlined` function goes into its compiled callers, without a call."""
        update_wrapper(self, function)
        self.py_func = function
        self.made, self.read = 0, 0
        """How many times machine code was made for Python, and read from disk."""
        self._inlined, self._count = inlined, function.__code__.co_argcount
        self._dispatcher: Any = None
        self._codes: dict[str, MachineCode | None] = {}

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Run the machine code."""
        if named or len(arguments) != self._count:
            arguments = self._in_order(arguments, named)
        given = passed(arguments)
        if given is None:
            return self.dispatcher.from_python(*arguments)
        if given.key not in self._codes:
            self._codes[given.key] = self._code(given, arguments)
        code = self._codes[given.key]
        return self.dispatcher.from_python(*arguments) if code is None else code(given.numbers, arguments)

    def _in_order(self, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[Any, ...]:
        bound = signature(self.py_func).bind(*arguments, **named)
        bound.apply_defaults()
        return bound.args

    @property
    def dispatcher(self) -> Any:
        """The function as numba compiles it."""
        if self._dispatcher is None:
            from cointoss.models.kernel.fork.dispatcher import CallerDispatcher

            with CallerDispatcher.lock:
                self._dispatcher = self._dispatcher or CallerDispatcher(self, inlined=self._inlined)
        return self._dispatcher

    @property
    def _numba_type_(self) -> Any:
        """What numba takes this for where a compiled function calls it."""
        return self.dispatcher._numba_type_

    def __reduce__(self) -> str:
        """Return the function by its name."""
        return self.py_func.__qualname__

    def __repr__(self) -> str:
        """Return what it is and of which function."""
        return f"{type(self).__name__}({self.py_func})"

    def _code(self, given: Passed, arguments: tuple[Any, ...]) -> MachineCode | None:
        """Return the machine code, or None where numba calls it."""
        file = self._file(given.key)
        kept = None if file is None else _read(file)
        if kept is not None:
            self.read += 1
            return MachineCode(kept)
        with self.dispatcher.lock:
            if given.key in self._codes:  # another thread has made it
                return self._codes[given.key]
            with nullcontext(False) if file is None else turn(str(file)) as was_waited_for:
                kept = _read(file) if was_waited_for and file is not None else None
                if kept is not None:
                    self.read += 1
                else:
                    kept = self._made(given, arguments, file)
            self._codes[given.key] = None if kept is None else MachineCode(kept)
            return self._codes[given.key]

    def _made(self, given: Passed, arguments: tuple[Any, ...], file: Path | None) -> Kept | None:
        kept = cast("Kept | None", self.dispatcher.machine_code(given, arguments))
        if kept is not None:
            self.made += 1
            if file is not None:
                with suppress(OSError):
                    file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
                    write_kept(file, file.name, pickle.dumps(kept))
        return kept

    def _file(self, key: str) -> Path | None:
        """Return the file of the machine code for arguments of some types, None where it is not kept.

        All that the code depends on is in its name: these types, the sources, numba, and the processor.
        """
        module = self.py_func.__module__
        if "<locals>" in self.py_func.__qualname__ or not is_kept(module):
            return None
        code = self.py_func.__code__  # of two functions of one name
        made_of = f"{key}\n{source_hash(module)} {code.co_firstlineno} numba {numba_version()} {processor()}"
        digest = hashlib.sha256(made_of.encode() + code.co_code).hexdigest()
        return cache_folder(module) / f"{self.py_func.__qualname__}-{digest}.code"


def _read(file: Path) -> Kept | None:
    """Return what a file keeps, or None where it is missing, damaged, another's, or of other sources."""
    kept = cast("Kept | None", read_object(file, file.name))
    return kept if kept is not None and kept.can_be_loaded else None
