"""Functions that are compiled apart: compiled code calls them at an address, and depends on nothing else.

Code that is kept on disk holds no address: it is given one, as it is given a number.
"""

# numba describes few types, and is imported where something is compiled.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import ctypes
import math
from collections.abc import Callable
from typing import Any

from cointoss.models.kernel.compiled import ForCompiledCode
from cointoss.models.kernel.vectors import Matrix, Vector

Function = Callable[[Matrix, Vector, Vector, float, float], Vector]
"""What can be called so: a function of a matrix, two vectors and two numbers that returns a vector."""
_SIZE = 9 + 3 + 3 + 2
_ENTRY = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
"""A function of its numbers, one after the other, and of room for its answer."""
_placed: dict[int, tuple[Function, Any]] = {}
"""What Python calls, and its code, by the code's address; kept for good, as a thread may still run it."""


class NotCompiledError(ValueError):
    """A function that numba cannot compile, or that does not return a vector; the message says why."""


def place(function: Function) -> int:
    """Compile a function and return the address of its code; an error in it gives numbers that are none.

    Raises:
        NotCompiledError: in one line.
    """
    code = _compiled(function)
    entry = _ENTRY(code.address)

    def from_python(*arguments: Any) -> Vector:
        M, a, b, s, t = arguments
        numbers = (ctypes.c_double * _SIZE)(*M[0], *M[1], *M[2], *a, *b, s, t)
        answer = (ctypes.c_double * 3)()
        entry(numbers, answer)
        return answer[0], answer[1], answer[2]

    _placed[code.address] = from_python, code
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


def _made() -> Any:
    """Return numba's intrinsic that calls a function at its address."""
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    row = types.UniTuple(types.float64, 3)
    kinds = types.int64, types.UniTuple(row, 3), row, row, types.float64, types.float64

    def codegen(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, *values = arguments
        given = ir.LiteralStructType([value.type for value in values])
        back = context.get_value_type(signature.return_type)
        with builder.goto_entry_block():
            numbers, answer = builder.alloca(given), builder.alloca(back)
        for i, value in enumerate(values):
            slot = builder.gep(numbers, [ir.IntType(32)(0), ir.IntType(32)(i)], inbounds=True)
            builder.store(value, slot)
        kind = ir.FunctionType(ir.VoidType(), [numbers.type, answer.type])
        builder.call(builder.inttoptr(address, kind.as_pointer()), [numbers, answer])
        return builder.load(answer)

    @intrinsic
    def at(typingctx: Any, address: Any, M: Any, a: Any, b: Any, s: Any, t: Any) -> Any:  # noqa: ARG001
        return row(*kinds), codegen

    return at


def _in_python(address: int, *arguments: Any) -> Vector:
    return _placed[address][0](*arguments)


call_at: Callable[[int, Matrix, Vector, Vector, float, float], Vector] = ForCompiledCode(_made, _in_python)
"""Calls the function at an address, which `place` has given, with its arguments."""
