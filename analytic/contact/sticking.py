"""Sticking: the rim point A does not slip; the coin rolls or pivots on it."""

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_force import friction_holds, holding_force
from cointoss.analytic.contact.one_rim import put_on_floor, strike
from cointoss.analytic.contact.resistance import FRICTIONLESS
from cointoss.analytic.contact.rim_contact import (
    RimContact,
    contact_margin,
    delassus_matrix,
    flight_over_floor,
    horizontal,
    rim_motion,
    spin_gained_at,
    write_held_rate,
)
from cointoss.analytic.numerics.tolerances import BORDER
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector, dot, norm
from cointoss.models.records import Array


@inlined
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`."""
    body, friction = contact.body, contact.friction
    flight = flight_over_floor(body, friction, y)
    A = rim_motion(body, friction, flight, contact.rim)
    F = holding_force(delassus_matrix(body, friction, A), A.free_acceleration)
    write_held_rate(body, flight, F, spin_gained_at(body, friction, A, F), dy)
    left = contact_margin(body, A.up, dot(A.up, F), contact.rim)
    return min(left, margin(body, A.up, F, friction.sliding))


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Bring A to the floor, and stop it by an impulse; see `automaton.project`."""
    A = put_on_floor(contact, y)
    strike(contact, A, holding_force(delassus_matrix(contact.body, FRICTIONLESS, A), A.velocity), y)


@compiled
def margin(body: Body, up: Vector, F: Vector, mu: float) -> float:
    """Return how far sticking is from its end beside what ends every contact: > 0 in it.

    It ends when friction cannot hold A with the force F, (3,) [N], `up` the upward unit vector, in one frame.
    """
    held = mu * dot(up, F) * (1 + BORDER)
    return (held - norm(horizontal(up, F))) / (body.mass * body.gravity)


@compiled
def begins(contact: SustainedContact, A: RimContact) -> bool:
    """Return whether a contact whose slip is slow, or stopped, goes on by sticking: friction holds A."""
    return friction_holds(contact.friction.sliding, holding_force(A.delassus, A.free_acceleration))
