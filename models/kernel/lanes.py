"""Four numbers side by side in one vector of the processor, for compiled functions that else take one.

To numba the vector is a number: its sums, products, quotients, roots and comparisons are those of each lane
by itself, so that a lane gets what its number would get alone, to the bit. A function that is to take either
chooses between two numbers by `where`, `min` and `max`, since the lanes may choose differently.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false, reportOptionalCall=false

import math
import operator
from functools import cache
from typing import Any

import numpy as np

from cointoss.models.kernel.compiled import ForCompiledCode

WIDTH = 4
Lanes = Any
"""A vector; where Python runs a function, an array of numpy's."""
# Where in memory a vector may lie: where a number may [B].
_ALIGNED = 8


@cache
def _lanes() -> Any:
    """Return numba's type of a vector, and let numba compute with it."""
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.core.datamodel import PrimitiveModel, register_default
    from numba.core.imputils import builtin_registry
    from numba.core.typeconv import Conversion
    from numba.core.typing.templates import ConcreteTemplate, infer_global, signature

    class Lanes(types.Type):
        """Four numbers, or four answers yes or no."""

        def can_convert_from(self, _: Any, other: Any) -> Any:
            """Return how a number becomes a vector, which has it in each lane."""
            return Conversion.safe if isinstance(other, types.Float | types.Integer) else None

    @register_default(Lanes)
    class _Model(PrimitiveModel):
        def __init__(self, models: Any, kind: Any) -> None:
            lane = ir.DoubleType() if kind is numbers else ir.IntType(1)
            super().__init__(models, kind, ir.VectorType(lane, WIDTH))

    numbers, answers = Lanes("numbers"), Lanes("answers")

    def known(function: Any, returned: Any, count: int, make: Any, *others: Any) -> None:
        given = [numbers] * count + list(others)
        infer_global(function)(type("_", (ConcreteTemplate,), {"cases": [signature(returned, *given)]}))
        builtin_registry.lower(function, *given)(lambda _, builder, __, vectors: make(builder, *vectors))

    def exact(builder: Any, name: str, a: Any) -> Any:
        kind = ir.FunctionType(a.type, [a.type])
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v4f64"), [a])

    for function, name in (
        (operator.add, "fadd"), (operator.iadd, "fadd"), (operator.sub, "fsub"),
        (operator.mul, "fmul"), (operator.imul, "fmul"),
        (operator.truediv, "fdiv"), (operator.itruediv, "fdiv"),
    ):  # fmt: skip
        known(function, numbers, 2, lambda builder, a, b, name=name: getattr(builder, name)(a, b))
    for function, sign in ((operator.lt, "<"), (operator.eq, "==")):
        known(function, answers, 2, lambda builder, a, b, sign=sign: builder.fcmp_ordered(sign, a, b))
    for function, sign in ((min, "<"), (max, ">")):
        known(
            function, numbers, 2,
            lambda builder, a, b, sign=sign: builder.select(builder.fcmp_ordered(sign, b, a), b, a),
        )  # fmt: skip
    for function, name in ((math.sqrt, "sqrt"), (abs, "fabs")):
        known(function, numbers, 1, lambda builder, a, name=name: exact(builder, name, a))
    known(operator.neg, numbers, 1, lambda builder, a: builder.fneg(a))
    known(operator.getitem, types.float64, 1, lambda builder, a, i: builder.extract_element(a, i), types.intp)

    def in_each(context: Any, builder: Any, given: Any, _: Any, number: Any) -> Any:
        number = context.cast(builder, number, given, types.float64)
        vector = cgutils.get_null_value(ir.VectorType(number.type, WIDTH))
        for lane in range(WIDTH):
            vector = builder.insert_element(vector, number, ir.IntType(32)(lane))
        return vector

    for given in (types.Float, types.Integer):
        builtin_registry.lower_cast(given, numbers)(in_each)
    return numbers


def _make_where() -> Any:
    from numba.core import types
    from numba.core.typing import signature
    from numba.extending import intrinsic

    @intrinsic
    def where(_: Any, condition: Any, a: Any, b: Any) -> Any:
        of = _lanes() if _lanes() in (a, b) else types.float64
        return signature(of, condition, of, of), lambda _, builder, __, given: builder.select(*given)

    return where


where = ForCompiledCode(_make_where, lambda condition, a, b: a if condition else b)
"""Return a where a condition holds, else b: of two numbers, or in each lane; (condition, a, b)."""


def _make_in_lanes() -> Any:
    from numba.core import types
    from numba.core.imputils import impl_ret_borrowed
    from numba.core.typing import signature
    from numba.extending import intrinsic
    from numba.np.arrayobj import make_array, populate_array

    @intrinsic
    def in_lanes(_: Any, table: Any) -> Any:
        of = types.Array(_lanes(), table.ndim - 1, "C", aligned=False)

        def seen(context: Any, builder: Any, _: Any, given: Any) -> Any:
            whole, view = make_array(table)(context, builder, given[0]), make_array(of)(context, builder)
            populate_array(
                view,
                data=builder.bitcast(whole.data, view.data.type),
                shape=[builder.extract_value(whole.shape, i) for i in range(of.ndim)],
                strides=[builder.extract_value(whole.strides, i) for i in range(of.ndim)],
                itemsize=builder.mul(whole.itemsize, whole.itemsize.type(WIDTH)),
                meminfo=whole.meminfo,
                parent=whole.parent,
            )
            return impl_ret_borrowed(context, builder, of, view._getvalue())

        return signature(of, table), seen

    return in_lanes


in_lanes = ForCompiledCode(_make_in_lanes)
"""Return an array whose last axis has four numbers as an array of vectors; (array)."""


@cache
def _of_vectors() -> tuple[Any, Any, Any]:
    """Return numba's `four`, `read_four` and `write_four`."""
    from llvmlite import ir
    from numba.core import cgutils, types
    from numba.core.typing import signature
    from numba.extending import intrinsic
    from numba.np.arrayobj import make_array

    vector = ir.VectorType(ir.DoubleType(), WIDTH)

    def place(context: Any, builder: Any, kind: Any, table: Any, row: Any, column: Any) -> Any:
        table = make_array(kind)(context, builder, table)
        first = cgutils.get_item_pointer(context, builder, kind, table, [row, column])
        return builder.bitcast(first, vector.as_pointer())

    @intrinsic
    def four(_: Any, _a: Any, _b: Any, _c: Any, _d: Any) -> Any:
        def side_by_side(__: Any, builder: Any, ___: Any, given: Any) -> Any:
            made = vector(ir.Undefined)
            for lane in range(WIDTH):
                made = builder.insert_element(made, given[lane], ir.IntType(32)(lane))
            return made

        return signature(_lanes(), *[types.float64] * WIDTH), side_by_side

    @intrinsic
    def read_four(_: Any, table: Any, _row: Any, _column: Any) -> Any:
        def read(context: Any, builder: Any, _: Any, given: Any) -> Any:
            return builder.load(place(context, builder, table, *given), align=_ALIGNED)

        return signature(_lanes(), table, types.intp, types.intp), read

    @intrinsic
    def write_four(_: Any, table: Any, _row: Any, _column: Any, _vector: Any) -> Any:
        def write(context: Any, builder: Any, _: Any, given: Any) -> Any:
            builder.store(given[3], place(context, builder, table, *given[:3]), align=_ALIGNED)
            return context.get_dummy_value()

        return signature(types.void, table, types.intp, types.intp, _lanes()), write

    return four, read_four, write_four


def _write(table: Any, row: int, column: int, a: Any) -> None:
    table[row, column : column + WIDTH] = a


four = ForCompiledCode(lambda: _of_vectors()[0], lambda *numbers: np.array(numbers))
"""Return a vector of four numbers."""
read_four = ForCompiledCode(lambda: _of_vectors()[1], lambda table, i, j: table[i, j : j + WIDTH].copy())
"""Return four numbers of a row of a table, from a column on, as a vector; (table, row, column)."""
write_four = ForCompiledCode(lambda: _of_vectors()[2], _write)
"""Set what `read_four` returns; (table, row, column, vector)."""
