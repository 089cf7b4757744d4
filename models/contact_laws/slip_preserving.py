"""(d) of Fig. 17: the impact keeps all slip."""

import numpy as np

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, solve


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse that keeps all slip: v_Aτ' = v_Aτ, v_Aν' = v_Aν."""
    return solve(A.delassus, (0.0, 0.0, -(1 + A.restitution) * A.velocity[2])), True


def missed(impacts: Recorded) -> Array:
    """Return the change of the slip."""
    return np.hypot(*map(impacts.changed, np.eye(3)[:2]))


LAW = Law(impulse, missed, spares_spin=True)
