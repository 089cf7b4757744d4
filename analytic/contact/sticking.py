"""Sticking: the rim point A does not slip; the coin rolls or pivots on it."""

import math

from cointoss.analytic.contact.floor_force import holding_force
from cointoss.analytic.numerics.tolerances import BORDER
from cointoss.models.kernel.compiled import compiled


@compiled
def force(A):
    """Return the floor's force at the `RimContact` A, space frame, (3,) [N]."""
    return holding_force(A.mobility, A.free_acceleration)


@compiled
def stopping_impulse(A):
    """Return the impulse that stops A, (3,) [N s]."""
    return holding_force(A.mobility, A.velocity)


@compiled
def margin(body, F, mu):
    """Return how far sticking is from its end beside what ends every contact: > 0 in it.

    It ends when friction cannot hold A with the force F, space frame, (3,) [N].
    """
    return (mu * F[2] * (1 + BORDER) - math.hypot(F[0], F[1])) / (body.mass * body.gravity)
