"""(f) of Fig. 17: developed friction, in the direction of the slip at touch-down for the whole impact."""

import numpy as np

from cointoss.models.contact_laws.law import NO_IMPULSE, Impact, Law, Recorded
from cointoss.models.contact_laws.smooth import impulse as impulse_without_friction
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, dot, scale


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse of developed friction, S_τν = -μ S_z v_Aτν/|v_Aτν|, and whether there is one.

    Without slip it has no direction, and the floor acts as a smooth one. There is none where no S_z > 0
    fulfils Newton's law (Painlevé's case).
    """
    v_A, mu = A.velocity, A.friction
    slip = (v_A[0] * v_A[0] + v_A[1] * v_A[1]) ** 0.5
    if slip == 0:
        return impulse_without_friction(A)
    direction = (-mu * v_A[0] / slip, -mu * v_A[1] / slip, 1.0)
    gained = dot(A.delassus[2], direction)
    if gained <= 0:
        return NO_IMPULSE, False
    return scale(-(1 + A.restitution) * v_A[2] / gained, direction), True


def missed(impacts: Recorded) -> Array:
    """Return |S_xy + μ S_z u|, u the direction of the slip before."""
    v_A, S = impacts.before, impacts.impulse
    slip = np.hypot(v_A[:, 0], v_A[:, 1])
    u = v_A[:, :2] / np.where(slip > 0, slip, 1)[:, None]
    return np.linalg.norm(S[:, :2] + impacts.friction * S[:, 2:] * u, axis=1) / impacts.size


LAW = Law(impulse, missed, uses_friction=True, jumps_without_slip=True)
