"""(a) of Fig. 17: the sharp edge stops the slip across it and keeps that along it."""

import numpy as np

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, dot, solve, subtract


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse that stops the slip across the edge: v_Aν' = 0, v_Aτ' = v_Aτ."""
    tau, v_A = A.tau, A.velocity
    along = dot(v_A, tau)
    S = solve(A.delassus, subtract((along * tau[0], along * tau[1], -A.restitution * v_A[2]), v_A))
    return S, True


def missed(impacts: Recorded) -> Array:
    """Return what is left of the slip across the edge, or has changed of that along it."""
    return np.maximum(impacts.left(impacts.nu), impacts.changed(impacts.tau))


LAW = Law(impulse, missed, spares_spin=True)
