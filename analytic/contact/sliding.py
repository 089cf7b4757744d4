"""Sliding: the rim point A slips on the floor, and friction acts against the slip."""

import math

from analytic.contact.floor_force import sliding_force, slip_direction
from analytic.numerics.tolerances import SLOW
from models.kernel.compiled import compiled


@compiled
def force(A, mu):
    """Return the floor's force at A, space frame, (3,) [N].

    Args:
        A: the `RimContact`.
        mu: coefficient of friction μ, 0 on a smooth floor.
    """
    return sliding_force(A.mobility, A.free_acceleration, mu, slip_direction(A.velocity, mu))


@compiled
def stopping_impulse(A, mu):
    """Return the impulse, with its friction, that stops v_Az, (3,) [N s]; for the arguments see `force`."""
    return sliding_force(A.mobility, A.velocity, mu, slip_direction(A.velocity, mu))


@compiled
def margin(body, A, mu):
    """Return how far sliding is from its end beside what ends every contact: > 0 in it.

    It ends when slip is slow, or when friction would press a point down that free flight lifts (Painlevé).
    """
    left = -A.free_acceleration[2] / body.gravity
    if mu == 0:
        return left
    slip = math.hypot(A.velocity[0], A.velocity[1]) / (body.gravity * body.radius) ** 0.5
    return min(left, slip - SLOW / 2)
