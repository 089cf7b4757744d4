"""The decorators of functions that are compiled when they are first called; their code is kept on disk.

They keep a function's signature. docs/COMPILING.md says what happens behind them.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import os
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import numba

from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.fork import TESTED

P = ParamSpec("P")
R = TypeVar("R")

_asked = os.environ.get("COINTOSS_COMPILER", "")
if _asked not in ("", "plain"):
    raise ImportError(f"COINTOSS_COMPILER = {_asked!r}: accepted: plain, or unset")


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
    """Compile by numba's private members where they are known, else by what numba makes public."""
    if numba.config.DISABLE_JIT:
        return function
    compiling.declared[function.__module__] += 1
    is_tested = numba.__version__.rpartition(".")[0] in TESTED
    if is_tested and not _asked:
        from cointoss.models.kernel.fork.functions import CompiledFunction

        return CompiledFunction(function, inlined=inlined)
    from cointoss.models.kernel.plain import plain_function

    return plain_function(function, inlined=inlined)
