"""(b) of Fig. 17: the knurled edge stops the slip along it and keeps that across it."""

import numpy as np

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, dot, solve, subtract


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse that stops the slip along the edge: v_Aτ' = 0, v_Aν' = v_Aν."""
    tau, v_A = A.tau, A.velocity
    nu = (-tau[1], tau[0], 0.0)
    across = dot(v_A, nu)
    S = solve(A.delassus, subtract((across * nu[0], across * nu[1], -A.restitution * v_A[2]), v_A))
    return S, True


def missed(impacts: Recorded) -> Array:
    """Return what is left of the slip along the edge, or has changed of that across it."""
    return np.maximum(impacts.left(impacts.tau), impacts.changed(impacts.nu))


LAW = Law(impulse, missed)
