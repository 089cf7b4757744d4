"""Sliding: the rim point A slips on the floor, and friction acts against the slip."""

import math

from cointoss.analytic.contact import smooth
from cointoss.analytic.contact.contact import Contact
from cointoss.analytic.contact.floor_force import sliding_force, slip_direction
from cointoss.analytic.contact.one_rim import add_force, free_flow, put_on_floor
from cointoss.analytic.contact.resistance import is_smooth
from cointoss.analytic.contact.rim_contact import RimContact, accelerate
from cointoss.analytic.numerics.tolerances import BORDER, SLOW
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector, dot
from cointoss.models.records import Array


@inlined
def flow(contact: Contact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`.

    Beside what ends every contact, sliding ends when slip is slow, or when friction would press a point down
    that free flight lifts (Painlevé).
    """
    if is_smooth(contact.friction):
        return smooth.flow(contact, y, dy)
    return flow_with_friction(contact, y, dy)


@inlined
def flow_with_friction(contact: Contact, y: Array, dy: Array) -> float:
    """As `flow`, whatever μ; it is 0 on a floor that resists rolling or pivoting alone."""
    A, mu = free_flow(contact, y, dy), contact.friction.sliding
    F, left = force_and_margin(contact.body, A, mu)
    return min(add_force(contact, A, F, dy), left)


@compiled
def force_and_margin(body: Body, A: RimContact, mu: float) -> tuple[Vector, float]:
    """Return the floor's force at A, space frame, (3,) [N], and the margin of sliding; see `flow`."""
    b, v = A.free_acceleration, A.velocity
    left = -b[2] / body.gravity
    F = sliding_force(A.delassus, b, mu, slip_direction(v, mu))
    if mu == 0:
        return F, left
    slip = math.hypot(v[0], v[1]) / (body.gravity * body.radius) ** 0.5
    return F, min(left, slip - SLOW / 2)


@compiled
def project(contact: Contact, y: Array) -> None:
    """Bring A to the floor, and stop v_Az by an impulse with its friction; see `automaton.project`."""
    if is_smooth(contact.friction):
        smooth.project(contact, y)
    else:
        project_with_friction(contact, y)


@compiled
def project_with_friction(contact: Contact, y: Array) -> None:
    """As `project`, whatever the coefficient of friction."""
    A, mu = put_on_floor(contact, y), contact.friction.sliding
    S = sliding_force(A.delassus, A.velocity, mu, slip_direction(A.velocity, mu))
    accelerate(contact.body, A, S, y)


@compiled
def begins(contact: Contact, A: RimContact, is_sliding: bool) -> bool:
    """Return whether a contact goes on by sliding: A `slips`, and does not jam; or the floor is smooth."""
    return contact.friction.sliding == 0 or (slips(contact, A, is_sliding) and not jams(contact, A))


@compiled
def slips(contact: Contact, A: RimContact, is_sliding: bool) -> bool:
    """Return whether A slips faster than `SLOW`; or faster than half of it, where it was sliding so far."""
    slow = SLOW * (contact.body.gravity * contact.body.radius) ** 0.5
    # A mode that ends at its bound must not go on for rounding.
    least = (1 + BORDER) * slow / 2 if is_sliding else (1 - BORDER) * slow
    return math.hypot(A.velocity[0], A.velocity[1]) > least


@compiled
def jams(contact: Contact, A: RimContact) -> bool:
    """Return whether sliding presses the coin into the floor, however large the force (Painlevé)."""
    mu = contact.friction.sliding
    s = slip_direction(A.velocity, mu)
    return not dot(A.delassus[2], (-mu * s[0], -mu * s[1], 1.0)) > 0
