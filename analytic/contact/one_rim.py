"""Contact at one rim point A: the functions that sliding, incipient slip and sticking share."""

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.resistance import FRICTIONLESS
from cointoss.analytic.contact.rim_contact import (
    RimContact,
    RimMotion,
    accelerate,
    add_quotient,
    contact_margin,
    flight_over_floor,
    rim_contact_in_flight,
    rim_motion,
    spin_gained_at,
)
from cointoss.analytic.flight.equations_of_motion import Flight, write_rate
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    set_height,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
    velocity_of,
)
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, dot
from cointoss.models.records import Array


@inlined
def free_flow(contact: SustainedContact, y: Array, dy: Array) -> RimContact:
    """Write the rate of change of the state y in free flight into dy, both (13,), and return A there."""
    flight = flight_over_floor(contact.body, contact.friction, y)
    write_rate(contact.body, flight, dy)
    return rim_contact_in_flight(contact.body, contact.friction, flight, contact.rim)


@inlined
def add_force(contact: SustainedContact, A: RimContact, F: Vector, dy: Array) -> float:
    """Add what the floor's force F at A gives to dy, (13,), and return the `contact_margin`."""
    accelerate(contact.body, A, F, dy)
    return contact_margin(contact.body, A.R[2], F[2], contact.rim)


@compiled
def contact_in_flight(contact: SustainedContact, y: Array) -> RimContact:
    """Return A in the state y, (13,), with the floor's resistance."""
    flight = flight_over_floor(contact.body, contact.friction, y)
    return rim_contact_in_flight(contact.body, contact.friction, flight, contact.rim)


@inlined
def put_on_floor(contact: SustainedContact, y: Array) -> RimMotion:
    """Bring A to the floor, and return it without resistance, in the body frame; y: state, (13,)."""
    # No force acts in no time: air would be computed for nothing.
    state, none = state_of(y), (0.0, 0.0, 0.0)
    moving = Flight(state, apply_transposed(state.R, state.velocity), none, none)
    A = rim_motion(contact.body, FRICTIONLESS, moving, contact.rim)
    set_height(y, -dot(A.up, A.arm))
    return A


@inlined
def strike(contact: SustainedContact, A: RimMotion, S: Vector, y: Array) -> None:
    """Let an impulse S act at A, without resistance, body frame, (3,) [N s]; y: state, (13,); changed."""
    gained = apply(rotation_matrix(attitude_of(y)), S)
    set_velocity(y, add_quotient(velocity_of(y), gained, contact.body.mass))
    set_spin(y, add(spin_of(y), spin_gained_at(contact.body, FRICTIONLESS, A, S)))
