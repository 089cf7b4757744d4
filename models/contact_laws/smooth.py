"""(e) of Fig. 17: the smooth floor has no friction."""

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the vertical impulse of a floor without friction, S = S_z ẑ; of the ideal coin eqs (93)-(97)."""
    return (0.0, 0.0, -(1 + A.restitution) * A.velocity[2] / A.delassus[2][2]), True


def missed(impacts: Recorded) -> Array:
    """Return the horizontal part of the impulse."""
    return impacts.horizontal / impacts.size


LAW = Law(
    impulse,
    missed,
    is_smooth=True,
    spares_spin=True,
    is_followed=True,
    never_adds_energy=True,
    is_in_mujoco=True,
)
