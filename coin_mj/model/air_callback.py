"""Air with b > 0 for MuJoCo: a compiled `mjcb_passive` that takes its numbers from the model at hand."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import mujoco
import numba
import numpy as np
from numba import types

from cointoss.coin_mj.model.air import PowerLaw, air_force
from cointoss.coin_mj.model.library import pointer_to
from cointoss.coin_mj.model.memory import offset_of
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.vectors import apply, apply_transposed
from cointoss.models.scenario import Scenario

NUMERIC = "air"
"""Name of the model's custom numbers: r, h, λ_n, λ_τ and b."""
NUMBERS = 5
_WORD = ctypes.sizeof(ctypes.c_int64)


def describe_air(spec: mujoco.MjSpec, scenario: Scenario) -> None:
    """Write the numbers of air with b > 0 into a model's description."""
    coin, air = scenario.coin, scenario.air
    data = (coin.radius, coin.thickness, air.normal, air.tangential, air.exponent)
    spec.add_numeric(name=NUMERIC, data=data, size=NUMBERS)


class _Users:
    """How many are inside `air_of`, and what was set before the first of them."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.count = 0
        self.before: Any = None


_users = _Users()


@contextmanager
def air_of(model: mujoco.MjModel) -> Iterator[None]:
    """Add the air of `model`, where it has any with b > 0, to the forces in MuJoCo's functions called within.

    MuJoCo has one passive callback per process. It is set here alone: by the first who enters, on whatever
    thread, and what was set before is put back by the last who leaves. It acts on models with the numbers of
    `describe_air` alone.
    """
    if model.nnumeric == 0:
        yield
        return
    callback = _callback()
    with _users.lock:
        if _users.count == 0:
            _users.before = mujoco.get_mjcb_passive()
            mujoco.set_mjcb_passive(callback)
        _users.count += 1
    try:
        yield
    finally:
        with _users.lock:
            _users.count -= 1
            if _users.count == 0:
                mujoco.set_mjcb_passive(_users.before)
                _users.before = None


@cache
def _callback() -> Any:
    """Return the compiled callback as a pointer that MuJoCo takes.

    The places of the fields of mjModel and mjData are written into the machine code; so it holds for this
    MuJoCo alone, and is not kept on disk.
    """
    count_at, numbers_at = _word("mjModel", "nnumericdata"), _word("mjModel", "numeric_data")
    qpos_at, qvel_at = _word("mjData", "qpos"), _word("mjData", "qvel")
    passive_at = _word("mjData", "qfrc_passive")

    def callback(model, data):
        model = numba.carray(model, max(count_at, numbers_at) + 1, np.int64)
        data = numba.carray(data, max(qpos_at, qvel_at, passive_at) + 1, np.int64)
        if model[count_at] != NUMBERS:
            return
        numbers = numba.carray(pointer_to(model[numbers_at], np.float64), NUMBERS)
        qpos = numba.carray(pointer_to(data[qpos_at], np.float64), 7)
        qvel = numba.carray(pointer_to(data[qvel_at], np.float64), 6)
        passive = numba.carray(pointer_to(data[passive_at], np.float64), 6)
        R = rotation_matrix((qpos[3], qpos[4], qpos[5], qpos[6]))
        v, w = apply_transposed(R, (qvel[0], qvel[1], qvel[2])), (qvel[3], qvel[4], qvel[5])
        law = PowerLaw(numbers[2], numbers[3], numbers[4])
        f, m = air_force(numbers[0], numbers[1], law, v, w)
        f = apply(R, f)
        for i in range(3):
            passive[i] += f[i]
            passive[3 + i] += m[i]

    signature: Any = types.void(types.voidptr, types.voidptr)
    compiled: Any = numba.cfunc(signature)(callback)
    return compiled.ctypes


def _word(struct: str, field: str) -> int:
    """Return which word of a struct is a field."""
    return offset_of(struct, field) // _WORD
