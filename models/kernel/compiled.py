"""The decorators of functions of which the engines' libraries are made; from Python they run as written.

They keep a function's signature. numba is imported only where something is compiled.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

from collections.abc import Callable
from functools import cached_property, update_wrapper
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Mark a function as one that compiled functions call."""
    return _Compiled(function, inlined=False)


def inlined(function: Callable[P, R]) -> Callable[P, R]:
    """Mark a function as one that goes into each of its compiled callers, without a call.

    For what is called many times over with many numbers, which a call would pass through memory.
    """
    return _Compiled(function, inlined=True)


def by_numba(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function as Python runs it by `numba.njit`: for studies and tests of parts of an engine.

    It is compiled when it is first called, with the functions of the system's C library; its code is kept.
    """
    is_compiled = isinstance(function, _Compiled)
    return _Compiled(
        function.py_func if is_compiled else function,
        inlined=is_compiled and function.inlined,
        by_numba=True,
    )


class _Compiled:
    """A function for compiled code and for Python."""

    dispatched: "Callable[[_Compiled], Any] | None" = None
    """Returns numba's dispatcher of a function; the build sets its own, else it is that of `numba.njit`."""

    def __init__(self, function: Callable[..., Any], *, inlined: bool, by_numba: bool = False) -> None:
        """Compile nothing yet."""
        update_wrapper(self, function)
        self.py_func, self.inlined, self._by_numba = function, inlined, by_numba

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Run the function as it is written, or by numba."""
        run = self.dispatcher if self._by_numba else self.py_func
        return run(*arguments, **named)

    @cached_property
    def dispatcher(self) -> Any:
        """The function as numba compiles it."""
        if _Compiled.dispatched is not None:
            return _Compiled.dispatched(self)
        from cointoss.models.kernel.by_numba import dispatcher_of

        return dispatcher_of(self.py_func, inlined=self.inlined, wrapped=self._by_numba)

    @property
    def _numba_type_(self) -> Any:
        """What numba takes this for where a compiled function calls it."""
        return self.dispatcher._numba_type_

    def __reduce__(self) -> str | tuple[Any, ...]:
        """Return the function by its name, or, where another has made it, by what it is made of."""
        name = self.py_func.__qualname__
        return (compiled, (self.py_func,)) if "<locals>" in name else name

    def __repr__(self) -> str:
        """Return what it is and of which function."""
        return f"compiled {self.py_func}"


class ForCompiledCode:
    """Something of numba's that compiled functions alone can use, made when the first of them is compiled."""

    def __init__(self, make: Callable[[], Any], in_python: Callable[..., Any] | None = None) -> None:
        """Make nothing yet.

        Args:
            make: imports numba, and returns an intrinsic or an external function.
            in_python: does the same where Python calls it, if it can.
        """
        self._make, self._in_python = make, in_python

    def __call__(self, *arguments: Any) -> Any:
        """Do the same in Python, or refuse it."""
        if self._in_python is None:
            raise TypeError(
                "only compiled code can call this: by an entry of the engine's library, or by_numba"
            )
        return self._in_python(*arguments)

    @cached_property
    def _numba_type_(self) -> Any:
        from numba.core.registry import cpu_target

        made = self._made = self._make()
        cpu_target.typing_context.refresh()
        return cpu_target.typing_context.resolve_value_type(made)
