"""Where MuJoCo keeps the numbers of a model and its data."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
from functools import cache
from typing import Any

import mujoco
from mujoco.introspect import ast_nodes
from mujoco.introspect.structs import STRUCTS

from cointoss.coin_mj.model.mujoco_coin import JointAddresses
from cointoss.models.records import UnusableEngineError

_SCALARS: dict[str, Any] = {
    "int": ctypes.c_int32,
    "float": ctypes.c_float,
    "mjtNum": ctypes.c_double,
    "mjtSize": ctypes.c_int64,
    "mjtBool": ctypes.c_bool,
    "mjtByte": ctypes.c_uint8,
    "uint64_t": ctypes.c_uint64,
    "size_t": ctypes.c_size_t,
    "uintptr_t": ctypes.c_size_t,
}
OF_ROWS = ("efc_J", "efc_pos", "efc_D", "efc_R", "efc_aref")
"""Arrays of the rows of constraints, which move from step to step. Other arrays stay."""
# A callback in Python refuses the step that MuJoCo's compiler makes, see `scene`.
_BALL = """<mujoco><option><flag spring="disable" damper="disable" actuation="disable"/></option>
<worldbody><geom type="plane" size="0 0 1"/><body pos="0 0 0.9"><freejoint/><geom size="1"/></body>
</worldbody></mujoco>"""


class LayoutError(UnusableEngineError):
    """MuJoCo's memory is not laid out as MuJoCo describes it."""


def _misplaced(struct: str, field: str) -> LayoutError:
    return LayoutError(
        f"MuJoCo {mujoco.__version__}: {struct}.{field} does not lie where mujoco.introspect says; "
        'accepted: a MuJoCo in which it does, such as pip install "mujoco-core>=4.0,<4.1" installs'
    )


def offset_of(struct: str, field: str) -> int:
    """Return where a field lies in one of MuJoCo's structs, as MuJoCo describes it [bytes].

    Args:
        struct: mjModel or mjData.
        field: its name; with dots, as in opt.timestep, that of a struct in it.

    Raises:
        LayoutError: if there is no such field, or a field of a type that is not known.
    """
    offset, kind = 0, layout_of(struct)
    for name in field.split("."):
        kinds = dict(kind._fields_)
        if name not in kinds:
            raise _misplaced(struct, field)
        offset, kind = offset + getattr(kind, name).offset, kinds[name]
    return offset


def require_layout(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Compare what lies where MuJoCo describes its fields with what its Python binding shows.

    All that are used are compared. The last field of either struct is its signature, so the size of all
    before it counts.

    Args:
        model: MuJoCo's.
        data: in contact, so that the rows of constraints have places.

    Raises:
        LayoutError: naming a field that lies elsewhere.
    """
    numbers = [
        (model, "mjModel", "opt.timestep", ctypes.c_double(model.opt.timestep)),
        (model, "mjModel", "signature", ctypes.c_uint64(model.signature)),
        (data, "mjData", "time", ctypes.c_double(data.time)),
        (data, "mjData", "nefc", ctypes.c_int32(data.nefc)),
        (data, "mjData", "signature", ctypes.c_uint64(data.signature)),
    ]
    arrays = [
        (data, "mjData", name, ctypes.c_size_t(getattr(data, name).ctypes.data))
        for name in ("qpos", *OF_ROWS)
    ]
    for struct, name, field, shown in arrays + numbers:
        there = ctypes.string_at(struct._address + offset_of(name, field), ctypes.sizeof(shown))
        if there != bytes(shown):
            raise _misplaced(name, field)


@cache
def in_contact() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return the model and the data of a ball in the floor: each field that is used has a value."""
    model = mujoco.MjModel.from_xml_string(_BALL)
    model.opt.timestep = 0.123456789
    data = mujoco.MjData(model)
    data.time = 0.987654321
    mujoco.mj_fwdPosition(model, data)
    return model, data


@cache
def layout_of(struct: str) -> Any:
    """Return the ctypes structure of one of `STRUCTS`."""
    return _structure(struct, STRUCTS[struct].fields)


def _structure(struct: str, fields: Any) -> Any:
    """Return a ctypes structure with these fields."""
    kinds = [(field.name, _kind(struct, field.name, field.type)) for field in fields]
    return type(struct, (ctypes.Structure,), {"_fields_": kinds})


def _kind(struct: str, field: str, described: Any) -> Any:
    """Return the ctypes type of a field from MuJoCo's description of it."""
    if isinstance(described, ast_nodes.PointerType):
        return ctypes.c_void_p
    if isinstance(described, ast_nodes.ArrayType):
        kind = _kind(struct, field, described.inner_type)
        for length in reversed(described.extents):
            kind = kind * length
        return kind
    if isinstance(described, ast_nodes.AnonymousStructDecl):
        return _structure(struct, described.fields)
    if described.name in STRUCTS:
        return layout_of(described.name)
    if described.name not in _SCALARS:
        raise _misplaced(struct, field)
    return _SCALARS[described.name]


def joint_addresses(data: mujoco.MjData) -> JointAddresses:
    """Return where the arrays of the free joint lie, as long as `data` lives."""
    return JointAddresses._make(getattr(data, name).ctypes.data for name in JointAddresses._fields)
