"""Creeping: the rim point A hardly slips and friction cannot hold it; slip goes where it grows."""

import math

from cointoss.analytic.contact.floor_force import holding_force, sliding_force, starting_slip
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import subtract


@compiled
def force(A, mu):
    """Return the floor's force at A, space frame, (3,) [N].

    Args:
        A: the `RimContact`.
        mu: coefficient of friction μ.
    """
    K, b = A.mobility, A.free_acceleration
    return sliding_force(K, b, mu, starting_slip(K, b, mu))


@compiled
def stopping_impulse(A, s):
    """Return the impulse that leaves A slip only in the direction s in which it grows, (3,) [N s]."""
    v_A = A.velocity
    speed = math.hypot(v_A[0], v_A[1]) if v_A[0] * s[0] + v_A[1] * s[1] > 0 else 0.0
    return holding_force(A.mobility, subtract(v_A, (speed * s[0], speed * s[1], 0.0)))


@compiled
def margin(body, A, mu):
    """Return how far creeping is from its end beside what ends every contact: > 0 in it.

    It ends when friction holds A, when slip is no longer slow, or when friction would press a point down that
    free flight lifts (Painlevé).
    """
    slip = math.hypot(A.velocity[0], A.velocity[1]) / (body.gravity * body.radius) ** 0.5
    left = min(-A.free_acceleration[2] / body.gravity, SLOW - slip)
    F = holding_force(A.mobility, A.free_acceleration)
    if not F[2] > 0:
        return left
    return min(left, (math.hypot(F[0], F[1]) - mu * F[2]) / (body.mass * body.gravity))
