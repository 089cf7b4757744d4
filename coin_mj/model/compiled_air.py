"""The air's force for b > 0 by its address: it is compiled where a coin has such air, and not for others."""

from functools import cache
from typing import Any

import numba
import numpy as np
from numba import types
from numba.np.numpy_support import carray

from cointoss.coin_mj.model.air import PowerLaw, air_force
from cointoss.coin_mj.model.library import call_at
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector

_NUMBERS = 17


@compiled
def air_force_at(address: int, body: Body, v: Vector, w: Vector) -> tuple[Vector, Vector]:
    """Return `air_force` on a coin, and its moment about B, by the function of `air_address`.

    Args:
        address: of that function.
        body: the coin.
        v: velocity of B, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
    """
    air = body.air
    given = (body.radius, body.thickness, air.normal, air.tangential, air.exponent or 0.0)
    numbers = np.zeros(_NUMBERS)
    for i in range(5):
        numbers[i] = given[i]
    for i in range(3):
        numbers[5 + i], numbers[8 + i] = v[i], w[i]
    call_at(address, numbers.ctypes)
    return (numbers[11], numbers[12], numbers[13]), (numbers[14], numbers[15], numbers[16])


def air_address(body: Body) -> int:
    """Return the address of the compiled force of the air on a coin; 0 in vacuum and in linear air."""
    return 0 if body.air.exponent is None else _compiled_air().address


@cache
def _compiled_air() -> Any:
    def air(numbers):
        n = carray(numbers, _NUMBERS)
        law = PowerLaw(n[2], n[3], n[4])
        f, m = air_force(n[0], n[1], law, (n[5], n[6], n[7]), (n[8], n[9], n[10]))
        for i in range(3):
            n[11 + i], n[14 + i] = f[i], m[i]

    signature: Any = types.void(types.CPointer(types.float64))
    return numba.cfunc(signature)(air)
