"""Sliding: the rim point A slips on the floor, and friction acts against the slip."""

import math

from cointoss.analytic.contact.floor_force import sliding_force, slip_direction
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.kernel.compiled import compiled


@compiled
def force_and_margin(body, A, mu):
    """Return the floor's force at A, and how far sliding is from its end beside what ends every contact.

    It ends when slip is slow, or when friction would press a point down that free flight lifts (Painlevé).

    Args:
        body: the coin.
        A: the `RimContact`.
        mu: coefficient of friction μ, 0 on a floor that resists rolling or pivoting alone.

    Returns:
        The force, space frame, (3,) [N], and the margin, > 0 in it.
    """
    b, v = A.free_acceleration, A.velocity
    left = -b[2] / body.gravity
    F = sliding_force(A.mobility, b, mu, slip_direction(v, mu))
    if mu == 0:
        return F, left
    slip = math.hypot(v[0], v[1]) / (body.gravity * body.radius) ** 0.5
    return F, min(left, slip - SLOW / 2)


@compiled
def stopping_impulse(A, mu):
    """Return the impulse, with its friction, that stops v_Az, (3,) [N s]; see `force_and_margin`."""
    return sliding_force(A.mobility, A.velocity, mu, slip_direction(A.velocity, mu))
