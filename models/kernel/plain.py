"""Functions compiled by what numba makes public: for any version of it, to the same bits, in more time."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import os
import sys
from collections.abc import Callable
from contextlib import ExitStack
from functools import cache, partial
from typing import Any

import numba
from numba.core import event

from cointoss.models.kernel.code_cache import Locator, is_kept, kept_functions, turn
from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.fork import TESTED
from cointoss.models.kernel.sources import part_of

_LOCATOR = f"{Locator.__module__}.{Locator.__name__}"


@cache
def _say_once() -> None:
    """Say why it takes so long."""
    if os.environ.get("COINTOSS_COMPILER"):
        why = "as COINTOSS_COMPILER=plain asks; it takes longer"
    elif sys.platform == "win32":
        why = "as always on Windows; it takes longer"
    else:
        why = f"with numba {numba.__version__}; it takes longer than with numba {' or '.join(TESTED)}"
    print(f"cointoss: compiling in plain mode, {why}", file=sys.stderr)


class _OneAtATime(event.Listener):
    """Counts what is compiled, by one process at a time.

    numba numbers the files of code, and two processes that compile one function at once may give one number
    to code for different arguments.
    """

    def __init__(self) -> None:
        self._begun: dict[int, ExitStack] = {}

    def on_start(self, event: Any) -> None:
        """Begin to compile a function, perhaps within others."""
        module = event.data["dispatcher"].py_func.__module__
        if part_of(module):
            _say_once()
            begun = self._begun[id(event.data)] = ExitStack()
            if not compiling.now:
                begun.enter_context(turn("plain mode"))
            begun.enter_context(compiling.one(module, partial(kept_functions, "")))

    def on_end(self, event: Any) -> None:
        """End what began with the same data."""
        if begun := self._begun.pop(id(event.data), None):
            begun.close()


def plain_function(function: Callable[..., Any], *, inlined: bool) -> Any:
    """Compile `function` when it is first called; an `inlined` one goes into its compiled callers."""
    before, numba.config.CACHE_LOCATOR_CLASSES = numba.config.CACHE_LOCATOR_CLASSES, _LOCATOR
    try:
        return numba.njit(
            nogil=True, error_model="numpy", forceinline=inlined, cache=is_kept(function.__module__)
        )(function)
    finally:
        numba.config.CACHE_LOCATOR_CLASSES = before


event.register("numba:compile", _OneAtATime())
