"""Sticking: the rim point A does not slip; the coin rolls or pivots on it."""

import math

from cointoss.analytic.contact.contact import Contact
from cointoss.analytic.contact.floor_force import friction_holds, holding_force
from cointoss.analytic.contact.one_rim import add_force, free_flow, put_on_floor
from cointoss.analytic.contact.rim_contact import RimContact, accelerate
from cointoss.analytic.numerics.tolerances import BORDER
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector
from cointoss.models.records import Array


@inlined
def flow(contact: Contact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`."""
    A = free_flow(contact, y, dy)
    F = holding_force(A.delassus, A.free_acceleration)
    return min(add_force(contact, A, F, dy), margin(contact.body, F, contact.friction.sliding))


@compiled
def project(contact: Contact, y: Array) -> None:
    """Bring A to the floor, and stop it by an impulse; see `automaton.project`."""
    A = put_on_floor(contact, y)
    accelerate(contact.body, A, holding_force(A.delassus, A.velocity), y)


@compiled
def margin(body: Body, F: Vector, mu: float) -> float:
    """Return how far sticking is from its end beside what ends every contact: > 0 in it.

    It ends when friction cannot hold A with the force F, space frame, (3,) [N].
    """
    return (mu * F[2] * (1 + BORDER) - math.hypot(F[0], F[1])) / (body.mass * body.gravity)


@compiled
def begins(contact: Contact, A: RimContact) -> bool:
    """Return whether a contact whose slip is slow, or stopped, goes on by sticking: friction holds A."""
    return friction_holds(contact.friction.sliding, holding_force(A.delassus, A.free_acceleration))
