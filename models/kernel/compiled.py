"""The decorators of functions that are compiled when they are first called; their code is kept on disk.

They keep a function's signature. docs/COMPILING.md says what happens behind them.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import os
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.fork import TESTED, numba_version
from cointoss.models.kernel.libm import check_libm

P = ParamSpec("P")
R = TypeVar("R")

_asked = os.environ.get("COINTOSS_COMPILER", "")
if _asked not in ("", "plain"):
    raise ImportError(f"COINTOSS_COMPILER = {_asked!r}: accepted: plain, or unset")
check_libm()


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile `function` when it is first called, without the GIL, and keep the code on disk.

    Code of functions outside this project is not kept.
    """
    return _compiled(function, inlined=False)


def inlined(function: Callable[P, R]) -> Callable[P, R]:
    """Compile `function` as `compiled` does, into each of its compiled callers.

    For what is called many times over with many numbers, which a call would pass through memory.
    """
    return _compiled(function, inlined=True)


def _compiled(function: Callable[..., Any], *, inlined: bool) -> Any:
    """Compile by numba's private members where they were tried, else by what numba makes public."""
    if compiles_nothing():
        _refuse_musl("unset NUMBA_DISABLE_JIT: nothing is compiled")
        return function
    compiling.declared[function.__module__] += 1
    if _is_tested():
        from cointoss.models.kernel.fork.function import CompiledFunction

        return CompiledFunction(function, inlined=inlined)
    _refuse_musl(f"needs numba {' or '.join(TESTED)}, COINTOSS_COMPILER unset, and no Windows")
    from cointoss.models.kernel.plain import plain_function

    return plain_function(function, inlined=inlined)


def _refuse_musl(needed: str) -> None:
    """Raise where musl's functions are asked for, but this way of compiling calls those of the system."""
    if os.environ.get("COINTOSS_LIBM"):
        raise ImportError(f"COINTOSS_LIBM = 'musl': {needed}")


@cache
def _is_tested() -> bool:
    return numba_version().rpartition(".")[0] in TESTED and sys.platform != "win32" and not _asked


@cache
def compiles_nothing() -> bool:
    """Return whether numba is told to compile nothing; it is asked where it may have been."""
    is_told = "NUMBA_DISABLE_JIT" in os.environ or Path(".numba_config.yaml").exists()
    if "numba" not in sys.modules and not is_told:
        return False
    import numba

    return bool(numba.config.DISABLE_JIT)
