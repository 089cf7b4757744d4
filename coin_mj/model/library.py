"""MuJoCo's own functions for compiled code."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

from pathlib import Path
from typing import Any

import llvmlite.binding
import mujoco
from llvmlite import ir
from numba import config, types
from numba.extending import intrinsic

from cointoss.models.records import UnusableEngineError

# The library that the bindings have loaded already: compiled code finds its functions by their names.
PATH = str(next(Path(mujoco.__file__).parent.glob("*mujoco.*")))
llvmlite.binding.load_library_permanently(PATH)

_model_and_data = (types.intp, types.intp)
mj_reset: Any = types.ExternalFunction("mj_resetData", types.void(*_model_and_data))
"""Takes the addresses of an mjModel and an mjData."""
mj_euler: Any = types.ExternalFunction("mj_Euler", types.void(*_model_and_data))
"""Takes the addresses of an mjModel and an mjData."""
mj_kinematics: Any = types.ExternalFunction("mj_kinematics", types.void(*_model_and_data))
mj_center: Any = types.ExternalFunction("mj_comPos", types.void(*_model_and_data))
mj_make_mass: Any = types.ExternalFunction("mj_makeM", types.void(*_model_and_data))
mj_factor_mass: Any = types.ExternalFunction("mj_factorM", types.void(*_model_and_data))
mj_collision: Any = types.ExternalFunction("mj_collision", types.void(*_model_and_data))
mj_make_constraint: Any = types.ExternalFunction("mj_makeConstraint", types.void(*_model_and_data))
mj_project_constraint: Any = types.ExternalFunction("mj_projectConstraint", types.void(*_model_and_data))
mj_center_velocity: Any = types.ExternalFunction("mj_comVel", types.void(*_model_and_data))
mj_reference_constraint: Any = types.ExternalFunction("mj_referenceConstraint", types.void(*_model_and_data))
mj_acceleration: Any = types.ExternalFunction("mj_fwdAcceleration", types.void(*_model_and_data))
mj_constraint: Any = types.ExternalFunction("mj_fwdConstraint", types.void(*_model_and_data))
"""The parts of `mj_forward` that a lone free body needs; each takes addresses as `mj_forward` does."""
_numbers_type = types.CPointer(types.float64)
mj_bias: Any = types.ExternalFunction("mj_rne", types.void(*_model_and_data, types.intc, _numbers_type))
"""Newton-Euler's forces; takes the addresses of an mjModel and an mjData, whether with accelerations, and
where the forces go, (nv,)."""
mj_solve_mass: Any = types.ExternalFunction(
    "mj_solveM", types.void(*_model_and_data, _numbers_type, _numbers_type, types.intc)
)
"""Solves M x = y for several y; takes the addresses of an mjModel and an mjData, x, y, and their number."""


@intrinsic
def _pointer_to(_context, _address, kind):
    target = types.CPointer(kind.instance_type)

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], context.get_value_type(signature.return_type))

    return target(types.int64, kind), code


pointer_to: Any = _pointer_to
"""Takes an address and a type, in compiled code: gives the address as a pointer to values of the type."""


@intrinsic
def _call_at(_context, _address, _numbers):
    def code(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(ir.VoidType(), [arguments[1].type])
        builder.call(builder.inttoptr(arguments[0], kind.as_pointer()), [arguments[1]])
        return context.get_dummy_value()

    return types.void(types.int64, _numbers_type), code


call_at: Any = _call_at
"""Takes the address of a compiled function, in compiled code, and calls it with an address of numbers."""


def require_compiled_code() -> None:
    """Raise UnusableEngineError where nothing is compiled: Python cannot call these functions."""
    if config.DISABLE_JIT:
        raise UnusableEngineError(
            "NUMBA_DISABLE_JIT is set, but MuJoCo's functions are called by compiled code alone; "
            "unset it, or toss by --engine analytic"
        )


def require_no_contact_filter() -> None:
    """Raise UnusableEngineError where MuJoCo's user filters contacts: the coin's would be, too."""
    if mujoco.get_mjcb_contactfilter() is not None:
        raise UnusableEngineError(
            "mjcb_contactfilter is set, and MuJoCo asks it about the coin's contacts as well; "
            "accepted: mujoco.set_mjcb_contactfilter(None) before a toss, or --engine analytic"
        )
