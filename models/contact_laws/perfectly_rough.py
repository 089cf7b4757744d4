"""(c) of Fig. 17: the perfectly rough floor stops all slip."""

import numpy as np

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, solve, subtract


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse that stops all slip: v_Aτ' = v_Aν' = 0, eqs (91)-(92)."""
    v_A = A.velocity
    return solve(A.delassus, subtract((0.0, 0.0, -A.restitution * v_A[2]), v_A)), True


def missed(impacts: Recorded) -> Array:
    """Return what is left of the slip."""
    return np.hypot(*map(impacts.left, np.eye(3)[:2]))


LAW = Law(impulse, missed, is_rough=True, is_followed=True, hardly_adds_energy=True, is_in_mujoco=True)
