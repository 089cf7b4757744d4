"""Incipient slip: A slips slower than `SLOW`, and the force that would hold it is outside the friction cone.

Friction turns such a slip at once into the direction in which it grows: see `starting_slip`.
"""

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_force import (
    growing_slip,
    holding_force,
    horizontal_size,
    sliding_force,
    starting_slip,
)
from cointoss.analytic.contact.one_rim import add_force, contact_in_flight, free_flow, put_on_floor, strike
from cointoss.analytic.contact.resistance import FRICTIONLESS
from cointoss.analytic.contact.rim_contact import RimContact, delassus_matrix
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import apply_transposed, subtract
from cointoss.models.records import Array


@inlined
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`."""
    A, mu = free_flow(contact, y, dy), contact.friction.sliding
    K, b = A.delassus, A.free_acceleration
    F = sliding_force(K, b, mu, growing_slip(K, b, mu, A.velocity))
    return min(add_force(contact, A, F, dy), margin(contact.body, A, mu))


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Leave A slip only in the direction in which it grows; see `automaton.project`."""
    body, A = contact.body, put_on_floor(contact, y)
    B = contact_in_flight(contact, y)
    s, v_A = starting_slip(B.delassus, B.free_acceleration, contact.friction.sliding), B.velocity
    speed = horizontal_size(v_A) if v_A[0] * s[0] + v_A[1] * s[1] > 0 else 0.0
    kept = apply_transposed(B.R, (speed * s[0], speed * s[1], 0.0))
    S = holding_force(delassus_matrix(body, FRICTIONLESS, A), subtract(A.velocity, kept))
    strike(contact, A, S, y)


@compiled
def margin(body: Body, A: RimContact, mu: float) -> float:
    """Return how far incipient slip is from its end beside what ends every contact: > 0 in it.

    It ends when friction holds A, when slip is no longer slow, or when friction would press a point down that
    free flight lifts (Painlevé).
    """
    slip = horizontal_size(A.velocity) / (body.gravity * body.radius) ** 0.5
    left = min(-A.free_acceleration[2] / body.gravity, SLOW - slip)
    F = holding_force(A.delassus, A.free_acceleration)
    if not F[2] > 0:
        return left
    return min(left, (horizontal_size(F) - mu * F[2]) / (body.mass * body.gravity))
