"""Upright: a thick coin on its edge, in contact at both rims.

Rigid-body mechanics does not determine how two sticking points share the friction that holds both: here
friction on slow slip grows in proportion to it.
"""

from typing import NamedTuple

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_force import friction_holds, holding_force, horizontal_size
from cointoss.analytic.contact.resistance import FRICTIONLESS, FloorFriction, has_resistance
from cointoss.analytic.contact.rim_contact import (
    RimContact,
    accelerate,
    add_quotient,
    both_rims,
    flight_over_floor,
    rim_contact_in_flight,
)
from cointoss.analytic.flight.equations_of_motion import write_rate
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    normalise,
    set_attitude,
    set_height,
    set_spin,
    set_velocity,
    spin_of,
    velocity_of,
)
from cointoss.analytic.impact.laws import spin_gained
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, cross, dot, scale, subtract
from cointoss.models.records import Array


class RimForces(NamedTuple):
    """Forces, or impulses, of the floor on both rims, which take the vertical motion of both points."""

    normal: tuple[float, float]
    """The vertical parts, on tails' rim and on heads'."""
    total: Vector
    """The sum of both forces with their friction, space frame."""
    spin_gained: Vector
    """The rate of change, or the change, of the angular velocity, body frame."""


@inlined
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`.

    Friction acts on each rim against that rim's slip. The mode ends where the floor would have to pull.
    """
    body, friction = contact.body, contact.friction
    flight = flight_over_floor(body, friction, y)
    write_rate(body, flight, dy)
    tails = rim_contact_in_flight(body, friction, flight, -1.0)
    heads = rim_contact_in_flight(body, friction, flight, 1.0)
    fall = (tails.free_acceleration[2], heads.free_acceleration[2])
    held = _holding(body, friction, tails, heads, fall)
    set_velocity(dy, add_quotient(velocity_of(dy), held.total, body.mass))
    set_spin(dy, add(spin_of(dy), held.spin_gained))
    return min(held.normal[0], held.normal[1]) / (body.mass * body.gravity)


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Turn a coin near its edge onto it, and stop both rims on the floor; see `automaton.project`."""
    body = contact.body
    tilt(y, rotation_matrix(attitude_of(y))[2][2])
    tails, heads = both_rims(body, FRICTIONLESS, y)
    held = _holding(body, FRICTIONLESS, tails, heads, (tails.velocity[2], heads.velocity[2]))
    v = velocity_of(y)
    set_height(y, -tails.arm[2])
    set_velocity(y, (v[0], v[1], v[2] + held.total[2] / body.mass))
    set_spin(y, add(spin_of(y), held.spin_gained))


@compiled
def rim_forces(body: Body, friction: FloorFriction, y: Array) -> tuple[float, float]:
    """Return the floor's vertical forces on the lowest points of tails' and of heads' rim, (2,) [N].

    They hold both points on the floor; a negative one would have to pull.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        y: state of an upright coin, (13,).
    """
    tails, heads = both_rims(body, friction, y)
    fall = (tails.free_acceleration[2], heads.free_acceleration[2])
    return _holding(body, friction, tails, heads, fall).normal


@compiled
def margin(body: Body, friction: FloorFriction, y: Array) -> float:
    """Return the margin of an upright contact, > 0 in it; at its end the floor would have to pull."""
    return min(rim_forces(body, friction, y)) / (body.mass * body.gravity)


@compiled
def start_slow_slip(contact: SustainedContact, y: Array) -> None:
    """Set the rim that stuck before the other landed into the slow slip whose friction holds it there.

    Without it that rim would have no friction at first, and the other might lift at once. Where no friction
    can hold it, or the floor would have to pull, nothing is changed.

    Args:
        contact: on the rim that stuck.
        y: state of an upright coin, (13,).
    """
    body, mu = contact.body, contact.friction.sliding
    tails, heads = both_rims(body, contact.friction, y)
    held, other = (tails, heads) if contact.rim < 0 else (heads, tails)
    along = _with_friction(body, mu, other.velocity)
    F, N = _gripping(contact, held, other, along, held.free_acceleration, other.free_acceleration[2])
    if N < 0 or not friction_holds(mu, F):
        return
    slip = -_slow_slip(body, mu) / (mu * F[2])
    tails, heads = both_rims(body, FRICTIONLESS, y)
    held, other = (tails, heads) if contact.rim < 0 else (heads, tails)
    change = subtract(held.velocity, (slip * F[0], slip * F[1], 0.0))
    S, S_other = _gripping(contact, held, other, (0.0, 0.0, 1.0), change, other.velocity[2])
    accelerate(body, held, S, y)
    accelerate(body, other, (0.0, 0.0, S_other), y)


@compiled
def _gripping(
    contact: SustainedContact, held: RimContact, other: RimContact, along: Vector, motion: Vector, fall: float
) -> tuple[Vector, float]:
    """Return the forces that stop the lowest point of one rim, and the vertical motion of the other's.

    Args:
        contact: the contact.
        held: the rim whose motion is stopped.
        other: the other rim.
        along: a force at the other with the vertical part 1, (3,).
        motion: acceleration, or velocity, of the point of `held`, (3,).
        fall: vertical acceleration, or velocity, of the point of `other`.

    Returns:
        The force, or impulse, on `held`, space frame, (3,), and the vertical force on `other`.
    """
    body, friction, K = contact.body, contact.friction, held.delassus
    # The force on `held` for its own motion, and for each unit of the force on `other`.
    by_other = _velocity_gained(body, friction, other, along, held.arm)
    F, more = holding_force(K, motion), holding_force(K, by_other)
    rise = dot(other.delassus[2], along) + _velocity_gained(body, friction, held, more, other.arm)[2]
    N = -(fall + _velocity_gained(body, friction, held, F, other.arm)[2]) / rise
    return add(F, scale(N, more)), N


@compiled
def _holding(
    body: Body, friction: FloorFriction, tails: RimContact, heads: RimContact, fall: tuple[float, float]
) -> RimForces:
    """Return the `RimForces` that take the vertical motion `fall` of both points from them.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        tails: of tails' rim.
        heads: of heads'.
        fall: accelerations, or velocities, (2,).
    """
    R, mu = tails.R, friction.sliding
    along_tails, along_heads = (
        _with_friction(body, mu, tails.velocity),
        _with_friction(body, mu, heads.velocity),
    )
    by_tails = _spin_gained(body, friction, tails, along_tails)
    by_heads = _spin_gained(body, friction, heads, along_heads)
    # The vertical motion of the first point by a unit force at the second.
    tails_tails, heads_heads = dot(tails.delassus[2], along_tails), dot(heads.delassus[2], along_heads)
    tails_heads = 1 / body.mass + cross(apply(R, by_heads), tails.arm)[2]
    heads_tails = 1 / body.mass + cross(apply(R, by_tails), heads.arm)[2]
    determinant = tails_tails * heads_heads - tails_heads * heads_tails
    N_tails = (tails_heads * fall[1] - heads_heads * fall[0]) / determinant
    N_heads = (heads_tails * fall[0] - tails_tails * fall[1]) / determinant
    F = add(scale(N_tails, along_tails), scale(N_heads, along_heads))
    return RimForces((N_tails, N_heads), F, add(scale(N_tails, by_tails), scale(N_heads, by_heads)))


@compiled
def _spin_gained(body: Body, friction: FloorFriction, A: RimContact, S: Vector) -> Vector:
    """Return the change of ω by an impulse S at the `RimContact` A and its resistance, body frame, (3,)."""
    if has_resistance(friction):
        return apply_transposed(A.spins, S)
    return spin_gained(body, A.R, A.arm, S)


@compiled
def _velocity_gained(body: Body, friction: FloorFriction, A: RimContact, S: Vector, at: Vector) -> Vector:
    """Return the velocity that S at A, as above, gives to the coin's point `at` from C, space frame, (3,)."""
    return add(scale(1 / body.mass, S), cross(apply(A.R, _spin_gained(body, friction, A, S)), at))


@compiled
def _with_friction(body: Body, mu: float, v_A: Vector) -> Vector:
    """Return a force with the vertical part 1 and its friction at a point with velocity v_A, (3,)."""
    slip = max(horizontal_size(v_A), _slow_slip(body, mu))
    return -mu * v_A[0] / slip, -mu * v_A[1] / slip, 1.0


@compiled
def _slow_slip(body: Body, mu: float) -> float:
    """Return the speed of a slip up to which friction grows in proportion to it [m/s].

    At a friction as large as the weight it is `SLOW`, however rough the floor: larger coefficients would only
    make the motion stiff.
    """
    return SLOW * max(mu, 1.0) * (body.gravity * body.radius) ** 0.5


@compiled
def tilt(y: Array, angle: float) -> None:
    """Turn the coin about the horizontal axis in its plane so that n_z falls by a small `angle`."""
    e = attitude_of(y)
    up = rotation_matrix(e)[2]
    turn = quaternion_rate(e, scale(angle, cross(up, (0.0, 0.0, 1.0))))
    set_attitude(y, (e[0] + turn[0], e[1] + turn[1], e[2] + turn[2], e[3] + turn[3]))
    normalise(y)
