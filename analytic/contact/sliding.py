"""Sliding: the rim point A slips on the floor, and friction acts against the slip."""

import math

import numpy as np

from cointoss.analytic.contact import smooth
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_force import horizontal_size, slip_direction
from cointoss.analytic.contact.one_rim import put_on_floor, strike
from cointoss.analytic.contact.resistance import FRICTIONLESS, is_smooth
from cointoss.analytic.contact.rim_contact import (
    RimContact,
    RimMotion,
    contact_margin,
    flight_over_floor,
    horizontal,
    rim_motion,
    rim_point,
    spin_gained_at,
    write_held_rate,
)
from cointoss.analytic.flight.state_vector import spin_of, state_of, velocity_of
from cointoss.analytic.numerics.tolerances import BORDER, SLOW
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.lanes import where
from cointoss.models.kernel.vectors import Vector, add, apply_transposed, cross, dot, norm, scale, subtract
from cointoss.models.records import Array

# A square below it may have an infinite inverse.
_LEAST_SQUARE = 1e-300


@inlined
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`.

    Beside what ends every contact, sliding ends when slip is slow, or when friction would press a point down
    that free flight lifts (Painlevé).
    """
    if is_smooth(contact.friction):
        return smooth.flow(contact, y, dy)
    return flow_with_friction(contact, y, dy)


@inlined
def flow_with_friction(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return what `flow` does, for any μ; it is 0 on a floor that has resistance alone."""
    body, friction, mu = contact.body, contact.friction, contact.friction.sliding
    flight = flight_over_floor(body, friction, y)
    A = rim_motion(body, friction, flight, contact.rim)
    b_z, along = dot(A.up, A.free_acceleration), normal_with_friction(A, mu)
    spin = spin_gained_at(body, friction, A, along)
    N = -b_z / rise_gained(body, A, along, spin)
    write_held_rate(body, flight, scale(N, along), scale(N, spin), dy)
    left = min(contact_margin(body, A.up, N, contact.rim), -b_z / body.gravity)
    if mu == 0:
        return left
    speed = norm(horizontal(A.up, A.velocity))
    return min(left, speed / (body.gravity * body.radius) ** 0.5 - SLOW / 2)


@inlined
def normal_with_friction(A: RimMotion, mu: float) -> Vector:
    """Return a unit normal force at A with its friction against the slip, body frame, (3,)."""
    if mu == 0:
        return A.up
    slip = horizontal(A.up, A.velocity)
    squared = dot(slip, slip)
    # The division and the root go on side by side.
    per_slip = mu * math.sqrt(squared) * (1 / max(squared, _LEAST_SQUARE))
    return subtract(A.up, scale(where(squared < _LEAST_SQUARE, 0.0, per_slip), slip))


@inlined
def rise_gained(body: Body, A: RimMotion, F: Vector, spin: Vector) -> float:
    """Return the upward acceleration of A by a force there [m/s²].

    Args:
        body: the coin.
        A: the rim point.
        F: the force, (3,) [N].
        spin: `spin_gained_at` A by it, (3,) [rad/s²].
    """
    return dot(A.up, F) / body.mass + dot(A.up, cross(spin, A.arm))


@compiled
def slip_time(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return the time in which A's slip would stop or double as it changes now [s].

    Args:
        contact: the contact, sliding.
        y: state, (13,).
        dy: its rate of change, (13,).
    """
    state = state_of(y)
    up, R = state.R[2], state.R
    a, turn, turn_rate = rim_point(contact.body, up, state.spin, contact.rim)
    v = add(apply_transposed(R, state.velocity), turn)
    v_rate = add(apply_transposed(R, velocity_of(dy)), add(cross(spin_of(dy), a), turn_rate))
    rate = norm(horizontal(up, v_rate))
    return norm(horizontal(up, v)) / rate if rate > 0 else np.inf


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Bring A to the floor, and stop v_Az by an impulse with its friction; see `automaton.project`."""
    if is_smooth(contact.friction):
        smooth.project(contact, y)
    else:
        project_with_friction(contact, y)


@compiled
def project_with_friction(contact: SustainedContact, y: Array) -> None:
    """Do what `project` does, for any coefficient of friction."""
    body, A = contact.body, put_on_floor(contact, y)
    along = normal_with_friction(A, contact.friction.sliding)
    rise = rise_gained(body, A, along, spin_gained_at(body, FRICTIONLESS, A, along))
    strike(contact, A, scale(-dot(A.up, A.velocity) / rise, along), y)


@compiled
def begins(contact: SustainedContact, A: RimContact, is_sliding: bool) -> bool:
    """Return whether a contact goes on by sliding: A `slips`, and does not jam; or the floor is smooth."""
    return contact.friction.sliding == 0 or (slips(contact, A, is_sliding) and not jams(contact, A))


@compiled
def slips(contact: SustainedContact, A: RimContact, is_sliding: bool) -> bool:
    """Return whether A slips faster than `SLOW`; or faster than half of it, where it was sliding so far."""
    slow = SLOW * (contact.body.gravity * contact.body.radius) ** 0.5
    # A mode that ends at its bound must not go on for rounding.
    least = (1 + BORDER) * slow / 2 if is_sliding else (1 - BORDER) * slow
    return horizontal_size(A.velocity) > least


@compiled
def jams(contact: SustainedContact, A: RimContact) -> bool:
    """Return whether sliding presses the coin into the floor, however large the force (Painlevé)."""
    mu = contact.friction.sliding
    s = slip_direction(A.velocity, mu)
    return not dot(A.delassus[2], (-mu * s[0], -mu * s[1], 1.0)) > 0
