"""Numbers at addresses, for compiled code."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

from importlib import import_module
from typing import Any

import numpy as np

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import ForCompiledCode, inlined


def _make_pointer() -> Any:
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def pointer(_context, _address, kind):
        def code(context: Any, builder: Any, signature: Any, given: Any) -> Any:
            return builder.inttoptr(given[0], context.get_value_type(signature.return_type))

        return types.CPointer(kind.instance_type)(types.int64, kind), code

    return pointer


_pointer_to: Any = ForCompiledCode(_make_pointer)
_array_of: Any = ForCompiledCode(lambda: import_module("numba").carray)


@inlined
def numbers_at(address: int, shape: tuple[int, int] | tuple[int]) -> Array:
    """Return the numbers at an address as an array of this shape, of float64."""
    return _array_of(_pointer_to(address, np.float64), shape)


@inlined
def address_at(address: int) -> int:
    """Return the address that lies at an address."""
    return _array_of(_pointer_to(address, np.int64), (1,))[0]


@inlined
def integer_at(address: int) -> int:
    """Return the C integer at an address."""
    return _array_of(_pointer_to(address, np.int32), (1,))[0]
