"""Conditions on whether a field of a tuple is None, decided by its type before types are looked for.

numba leaves out what an argument that is None rules out, but not what a field of an argument does: it would
compile linear air's form for b > 0, and every function called only there.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

import operator
from typing import Any

from numba.core import ir, types
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.ir_utils import get_definition, guard

_CONDITIONS = {operator.is_: True, operator.is_not: False}
"""What a comparison gives where both sides are None."""


@register_pass(mutates_CFG=False, analysis_only=False)
class DecideNoneFields(FunctionPass):
    """Writes the answer in place of the comparison that asks for it; numba leaves out unused branches."""

    _name = "decide_none_fields"

    def __init__(self) -> None:
        """Hold nothing."""
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        """Return whether there was such a comparison."""
        decided = False
        for block in state.func_ir.blocks.values():
            for statement in block.find_insts(ir.Assign):
                answer = _answer(state, statement.value)
                if answer is not None:
                    known = ir.Const(answer, statement.loc)
                    state.func_ir._definitions[statement.target.name] = [known]
                    statement.value = known
                    decided = True
        return decided


def _answer(state: Any, expression: Any) -> bool | None:
    """Return what `field is None` or `field is not None` gives; None for any other expression."""
    if not (isinstance(expression, ir.Expr) and expression.op == "binop" and expression.fn in _CONDITIONS):
        return None
    other = guard(get_definition, state.func_ir, expression.rhs)
    if not (isinstance(other, ir.Const) and other.value is None):
        return None
    kind = _type_of_field(state, expression.lhs)
    if kind is None or isinstance(kind, types.Optional):
        return None
    return isinstance(kind, types.NoneType) == _CONDITIONS[expression.fn]


def _type_of_field(state: Any, variable: Any) -> Any:
    """Return the type of an argument or of a field within it; None where the variable is neither."""
    definition = guard(get_definition, state.func_ir, variable)
    if isinstance(definition, ir.Arg):
        return state.args[definition.index]
    if not (isinstance(definition, ir.Expr) and definition.op == "getattr"):
        return None
    whole = _type_of_field(state, definition.value)
    if not isinstance(whole, types.BaseNamedTuple):
        return None
    return whole.types[whole.fields.index(definition.attr)]
