"""Contact at one rim point A: what sliding, incipient slip and sticking have in common."""

from cointoss.analytic.contact.contact import Contact
from cointoss.analytic.contact.rim_contact import (
    RimContact,
    accelerate,
    contact_margin,
    rim_contact,
    rim_contact_in_flight,
)
from cointoss.analytic.flight.equations_of_motion import flight_of, write_rate
from cointoss.analytic.flight.state_vector import set_height
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector
from cointoss.models.records import Array


@inlined
def free_flow(contact: Contact, y: Array, dy: Array) -> RimContact:
    """Write the rate of change of the state y in free flight into dy, both (13,), and return A there."""
    flight = flight_of(contact.body, y)
    write_rate(contact.body, flight, dy)
    return rim_contact_in_flight(contact.body, contact.friction, flight, contact.rim)


@inlined
def add_force(contact: Contact, A: RimContact, F: Vector, dy: Array) -> float:
    """Add what the floor's force F at A gives to dy, (13,), and return the `contact_margin`."""
    accelerate(contact.body, A, F, dy)
    return contact_margin(contact.body, A.R[2], F[2], contact.rim)


@compiled
def contact_in_flight(contact: Contact, y: Array) -> RimContact:
    """Return A in the state y, (13,), with the floor's resistance."""
    return rim_contact_in_flight(contact.body, contact.friction, flight_of(contact.body, y), contact.rim)


@compiled
def put_on_floor(contact: Contact, y: Array) -> RimContact:
    """Bring A to the floor, and return it without resistance; y: state, (13,)."""
    A = rim_contact(contact.body, y, contact.rim)
    set_height(y, -A.arm[2])
    return A
