"""The rim point at which a coin touches the floor, and what a force there meets.

The rim point A that is lowest moves round the rim; v_A is the velocity of the coin's matter there. With a
force F at A, dv_A/dt = b + K F, K the Delassus matrix of A, as in an impact, and b what free flight gives.
"""

from typing import NamedTuple

from cointoss.analytic.contact.resistance import (
    FRICTIONLESS,
    FloorFriction,
    has_resistance,
    moment_per_force,
)
from cointoss.analytic.flight.equations_of_motion import Flight, flight_of
from cointoss.analytic.flight.state_vector import set_spin, set_velocity, spin_of, velocity_of
from cointoss.models.body import Body
from cointoss.models.geometry import FACE_SINE, tilt_sine_of
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import (
    Matrix,
    Vector,
    add,
    apply,
    apply_transposed,
    cross,
    dot,
    scale,
    subtract,
)
from cointoss.models.records import Array


class RimContact(NamedTuple):
    """The lowest point A of a rim, in one state of the coin; space frame."""

    R: Matrix
    """Rotation matrix, body to space."""
    arm: Vector
    """From C to A [m]."""
    spins: Matrix
    """Changes of ω by unit impulses at A along x, y and z, body frame, row by row [rad/(N s²)]; the last one
    with the resistance that comes with it."""
    delassus: Matrix
    """The Delassus matrix K (inverse effective mass) [1/kg], with resistance K + q ẑᵀ; see
    `cointoss.analytic.contact.resistance`."""
    free_acceleration: Vector
    """b [m/s²]."""
    velocity: Vector
    """v_A [m/s]."""


@compiled
def rim_contact(body: Body, y: Array, rim: float) -> RimContact:
    """Return the `RimContact` of a coin in the state y, without resistance.

    Args:
        body: the coin.
        y: state, (13,), not flat.
        rim: -1 for tails' rim, 1 for heads'; see `cointoss.models.geometry.lower_rim`.
    """
    return rim_contact_in_flight(body, FRICTIONLESS, flight_of(body, y), rim)


@compiled
def both_rims(body: Body, friction: FloorFriction, y: Array) -> tuple[RimContact, RimContact]:
    """Return the `RimContact` of tails' rim and that of heads', in the state y, (13,); see `rim_contact`."""
    flight = flight_of(body, y)
    return (
        rim_contact_in_flight(body, friction, flight, -1.0),
        rim_contact_in_flight(body, friction, flight, 1.0),
    )


@inlined
def rim_point(body: Body, up: Vector, w: Vector, rim: float) -> tuple[Vector, Vector, Vector]:
    """Return the lowest point A of a rim and how it moves; body frame.

    Args:
        body: the coin.
        up: the upward unit vector, (3,), the coin not being flat.
        w: angular velocity, (3,) [rad/s].
        rim: -1 for tails' rim, 1 for heads'.

    Returns:
        a: from C to A, (3,) [m].
        turn: ω × a, the velocity of the coin's matter at A from C, (3,) [m/s].
        turn_rate: dω/dt being 0, the change of the velocity at the lowest point, as it moves round the rim,
            (3,) [m/s²].
    """
    sine = tilt_sine_of(up)
    # Outward to the rim point, and the rate at which that direction turns about ζ.
    out = (-up[0] / sine, -up[1] / sine)
    up_rate = cross(up, w)
    turning = (up[0] * up_rate[1] - up[1] * up_rate[0]) / (sine * sine)
    r = body.radius
    a = subtract((r * out[0], r * out[1], rim * body.thickness / 2), body.center)
    a_rate = (-r * turning * out[1], r * turning * out[0], 0.0)
    turn = cross(w, a)
    return a, turn, cross(w, add(turn, a_rate))


@inlined
def rim_contact_in_flight(body: Body, friction: FloorFriction, flight: Flight, rim: float) -> RimContact:
    """Return the `RimContact` of a rim, with the resistance of the floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        flight: the `Flight` of its state, not flat.
        rim: -1 for tails' rim, 1 for heads'.
    """
    R, w, up = flight.state.R, flight.state.spin, flight.state.R[2]
    a, turn, turn_rate = rim_point(body, up, w, rim)
    turn_rate = add(cross(flight.spin_rate, a), turn_rate)
    levers = (cross(a, R[0]), cross(a, R[1]), cross(a, R[2]))
    J_inverse = body.inertia_inverse
    spins = (apply(J_inverse, levers[0]), apply(J_inverse, levers[1]), apply(J_inverse, levers[2]))
    by_mass = 1 / body.mass
    b = apply(R, add(scale(by_mass, flight.force), turn_rate))
    xy, xz, yz = dot(levers[0], spins[1]), dot(levers[0], spins[2]), dot(levers[1], spins[2])
    K = (
        (by_mass + dot(levers[0], spins[0]), xy, xz),
        (xy, by_mass + dot(levers[1], spins[1]), yz),
        (xz, yz, by_mass + dot(levers[2], spins[2])),
    )
    arm = apply(R, a)
    if has_resistance(friction):
        moment = moment_per_force(body, friction, apply(R, w))
        turned = apply(J_inverse, apply_transposed(R, moment))
        q = cross(apply(R, turned), arm)
        spins = (spins[0], spins[1], add(spins[2], turned))
        K = (
            (K[0][0], K[0][1], K[0][2] + q[0]),
            (K[1][0], K[1][1], K[1][2] + q[1]),
            (K[2][0], K[2][1], K[2][2] + q[2]),
        )
    return RimContact(
        R=R,
        arm=arm,
        spins=spins,
        delassus=K,
        free_acceleration=(b[0], b[1], b[2] - body.gravity),
        velocity=apply(R, add(flight.velocity, turn)),
    )


@compiled
def contact_margin(body: Body, up: Vector, N: float, rim: float) -> float:
    """Return how far a contact is from what ends it in every mode: positive in it, 0 or below past it.

    It ends when the floor would have to pull (Signorini's condition), when the coin comes upon its edge, so
    that the other rim lands, or upon a face.

    Args:
        body: the coin.
        up: the upward unit vector, body frame, (3,).
        N: the floor's vertical force [N].
        rim: that is in contact.
    """
    left = min(N / (body.mass * body.gravity), tilt_sine_of(up) / FACE_SINE - 1)
    return min(left, -rim * up[2]) if body.thickness > 0 else left


@compiled
def accelerate(body: Body, A: RimContact, F: Vector, dy: Array) -> None:
    """Add what a force F at A, space frame, (3,) [N], gives to the rate of change dy of a state, (13,).

    Of an impulse [N s] and the state itself: the change that it makes.
    """
    set_velocity(dy, add_quotient(velocity_of(dy), F, body.mass))
    set_spin(dy, add(spin_of(dy), apply_transposed(A.spins, F)))


@compiled
def add_quotient(a: Vector, b: Vector, divisor: float) -> Vector:
    """Return a + b/divisor."""
    return a[0] + b[0] / divisor, a[1] + b[1] / divisor, a[2] + b[2] / divisor
