"""Functions that are compiled apart: compiled code calls them at an address, and depends on nothing else.

Code that is kept on disk holds no address: it is given one, as it is given a number.
"""

# numba describes few types, and is imported where something is compiled.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import ctypes
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import ForCompiledCode, compiled
from cointoss.models.kernel.vectors import Matrix, Vector

Function = Callable[[Matrix, Vector, Vector, float, float], Vector]
"""What can be called so: a function of a matrix, two vectors and two numbers that returns a vector."""
_GIVEN = 9 + 3 + 3 + 2
"""How many numbers it is given."""
_placed: dict[int, Any] = {}
"""Code by its address; kept for good, as a thread may still run it."""


class NotCompiledError(ValueError):
    """A function that numba cannot compile, or that does not return a vector; the message says why."""


def place(function: Function) -> int:
    """Compile a function and return the address of its code; an error in it gives numbers that are none.

    Raises:
        NotCompiledError: in one line.
    """
    code = _compiled(function)
    _placed[code.address] = code
    return code.address


def _compiled(function: Function) -> Any:
    """Return numba's C function of numbers and of room for the answer."""
    import numba
    from numba import types

    number = types.float64
    row = types.UniTuple(number, 3)
    kinds = types.UniTuple(row, 3), row, row, number, number
    inner = numba.njit(nogil=True, error_model="numpy")(function)
    try:
        inner.compile(kinds)
    except Exception as error:  # of numba's own, or as Python raises it where numba looks up a name
        raise NotCompiledError(f"numba cannot compile it: {_reason(error)}") from None
    (given,) = inner.nopython_signatures
    kind = given.return_type
    numbers = kind.types if isinstance(kind, types.BaseTuple) else ()
    if len(numbers) != 3 or not all(isinstance(one, types.Integer | types.Float) for one in numbers):
        raise NotCompiledError(f"returns {kind}")

    def through_memory(given: Any, answer: Any) -> None:
        answer[0] = (math.nan, math.nan, math.nan)
        try:
            x, y, z = inner(*given[0])
            answer[0] = (float(x), float(y), float(z))
        except Exception:  # the only kind that compiled code can catch; NaN is then refused as not finite
            return

    form = types.void(types.CPointer(types.Tuple(kinds)), types.CPointer(row))
    return numba.cfunc(form)(through_memory)


def _reason(error: Exception) -> str:
    """Return the line of one of numba's messages that says most."""
    lines = [line.strip() for line in str(error).splitlines()]
    return next((line for line in lines if line and not line.startswith(_NO_REASON)), type(error).__name__)


_NO_REASON = ("Failed in", "- Resolution", "During:", "File ", "There are")


def _make_call() -> Any:
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def call(_context, _function, arguments):
        def code(context: Any, builder: Any, _signature: Any, given: Any) -> Any:
            address, packed = given
            values = [builder.extract_value(packed, i) for i in range(len(arguments))]
            kind = ir.FunctionType(ir.VoidType(), [value.type for value in values])
            builder.call(builder.inttoptr(address, kind.as_pointer()), values)
            return context.get_dummy_value()

        return types.void(types.int64, arguments), code

    return call


def _call_in_python(address: int, arguments: tuple[int, ...]) -> None:
    ctypes.CFUNCTYPE(None, *[ctypes.c_int64] * len(arguments))(address)(*arguments)


call_c: Any = ForCompiledCode(_make_call, _call_in_python)
"""Calls the C function at an address, which returns nothing, with a tuple of integers: also addresses."""


@compiled
def call_at(address: int, M: Matrix, a: Vector, b: Vector, s: float, t: float) -> Vector:
    """Return what the function at an address, which `place` has given, returns for its arguments."""
    numbers = np.empty(_GIVEN + 3)
    copy_into(numbers[:_GIVEN], M[0] + M[1] + M[2] + a + b + (s, t))
    start = numbers.ctypes.data
    call_c(address, (start, start + _GIVEN * numbers.itemsize))
    return float(numbers[_GIVEN]), float(numbers[_GIVEN + 1]), float(numbers[_GIVEN + 2])
