"""numba's type of four numbers in one vector, and what compiled functions do with it; see `lanes`.

It is imported where something is compiled, or where numba reads code that it kept.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false, reportOptionalCall=false

import math
import operator
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import PrimitiveModel, register_default
from numba.core.imputils import builtin_registry, impl_ret_borrowed
from numba.core.typeconv import Conversion
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic
from numba.np.arrayobj import make_array, populate_array

from cointoss.models.kernel.lanes import WIDTH

# Alignment of a vector in memory: that of one number [B].
_ALIGNED = 8
_NUMBER, _INDEX = ir.DoubleType(), ir.IntType(32)
_VECTOR = ir.VectorType(_NUMBER, WIDTH)


class Vectors(types.Type):
    """Four numbers, or four answers yes or no."""

    def can_convert_from(self, _: Any, other: Any) -> Any:
        """Return how a number becomes a vector, which has it in each lane."""
        return Conversion.safe if isinstance(other, types.Float | types.Integer) else None


NUMBERS, _ANSWERS = Vectors("numbers"), Vectors("answers")


@register_default(Vectors)
class _Model(PrimitiveModel):
    def __init__(self, models: Any, kind: Any) -> None:
        made_of = _VECTOR if kind == NUMBERS else ir.VectorType(ir.IntType(1), WIDTH)
        super().__init__(models, kind, made_of)


def _known(function: Any, returned: Any, count: int, make: Any, *others: Any) -> None:
    given = [NUMBERS] * count + list(others)
    infer_global(function)(type("_", (ConcreteTemplate,), {"cases": [signature(returned, *given)]}))
    builtin_registry.lower(function, *given)(lambda _, builder, __, vectors: make(builder, *vectors))


def _exact(builder: Any, name: str, a: Any) -> Any:
    kind = ir.FunctionType(a.type, [a.type])
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v4f64"), [a])


for _function, _name in (
    (operator.add, "fadd"), (operator.iadd, "fadd"), (operator.sub, "fsub"),
    (operator.mul, "fmul"), (operator.imul, "fmul"),
    (operator.truediv, "fdiv"), (operator.itruediv, "fdiv"),
):  # fmt: skip
    _known(_function, NUMBERS, 2, lambda builder, a, b, name=_name: getattr(builder, name)(a, b))
for _function, _sign in ((operator.lt, "<"), (operator.eq, "==")):
    _known(_function, _ANSWERS, 2, lambda builder, a, b, sign=_sign: builder.fcmp_ordered(sign, a, b))
for _function, _sign in ((min, "<"), (max, ">")):
    _known(
        _function, NUMBERS, 2,
        lambda builder, a, b, sign=_sign: builder.select(builder.fcmp_ordered(sign, b, a), b, a),
    )  # fmt: skip
for _function, _name in ((math.sqrt, "sqrt"), (abs, "fabs")):
    _known(_function, NUMBERS, 1, lambda builder, a, name=_name: _exact(builder, name, a))
_known(operator.neg, NUMBERS, 1, lambda builder, a: builder.fneg(a))
_known(operator.getitem, types.float64, 1, lambda builder, a, i: builder.extract_element(a, i), types.intp)


def _side_by_side(builder: Any, numbers: Any) -> Any:
    vector = _VECTOR(ir.Undefined)
    for lane in range(WIDTH):
        vector = builder.insert_element(vector, numbers[lane], _INDEX(lane))
    return vector


def _in_each(context: Any, builder: Any, given: Any, _: Any, number: Any) -> Any:
    return _side_by_side(builder, [context.cast(builder, number, given, types.float64)] * WIDTH)


for _given in (types.Float, types.Integer):
    builtin_registry.lower_cast(_given, NUMBERS)(_in_each)


@intrinsic
def where(_: Any, condition: Any, a: Any, b: Any) -> Any:
    """See `lanes.where`."""
    of = NUMBERS if NUMBERS in (a, b) else types.float64
    return signature(of, condition, of, of), lambda _, builder, __, given: builder.select(*given)


@intrinsic
def in_lanes(_: Any, table: Any) -> Any:
    """See `lanes.in_lanes`."""
    of = types.Array(NUMBERS, table.ndim - 1, "C", aligned=False)

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


@intrinsic
def four(_: Any, _a: Any, _b: Any, _c: Any, _d: Any) -> Any:
    """See `lanes.four`."""
    given = [types.float64] * WIDTH
    return signature(NUMBERS, *given), lambda _, builder, __, numbers: _side_by_side(builder, numbers)


@intrinsic
def read_four(_: Any, table: Any, _row: Any, _column: Any) -> Any:
    """See `lanes.read_four`."""

    def read(context: Any, builder: Any, _: Any, given: Any) -> Any:
        return builder.load(_place(context, builder, table, *given), align=_ALIGNED)

    return signature(NUMBERS, table, types.intp, types.intp), read


@intrinsic
def write_four(_: Any, table: Any, _row: Any, _column: Any, _vector: Any) -> Any:
    """See `lanes.write_four`."""

    def write(context: Any, builder: Any, _: Any, given: Any) -> Any:
        builder.store(given[3], _place(context, builder, table, *given[:3]), align=_ALIGNED)
        return context.get_dummy_value()

    return signature(types.void, table, types.intp, types.intp, NUMBERS), write


def _place(context: Any, builder: Any, kind: Any, table: Any, row: Any, column: Any) -> Any:
    table = make_array(kind)(context, builder, table)
    first = cgutils.get_item_pointer(context, builder, kind, table, [row, column])
    return builder.bitcast(first, _VECTOR.as_pointer())
