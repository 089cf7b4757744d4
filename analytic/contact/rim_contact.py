"""The rim point at which a coin touches the floor, and what a force there meets.

The rim point A that is lowest moves round the rim; v_A is the velocity of the coin's matter there. With a
force F at A, dv_A/dt = b + K F, K the Delassus matrix of A, as in an impact, and b what free flight gives.
The flows of sliding and of sticking compute in the body frame, whose `RimMotion` takes half the products; the
resets, and what compares two rims, in the space frame.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.resistance import (
    FRICTIONLESS,
    FloorFriction,
    air_moment,
    contour_moment_per_force,
    has_resistance,
    moment_per_force,
)
from cointoss.analytic.flight.equations_of_motion import Flight, flight_in, write_rate
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
    velocity_of,
)
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.contour import has_contour
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


class RimMotion(NamedTuple):
    """The lowest point A of a rim in free flight, in one state of the coin; body frame."""

    up: Vector
    """The upward unit vector."""
    arm: Vector
    """The arm from C to A [m]."""
    velocity: Vector
    """v_A [m/s]."""
    free_acceleration: Vector
    """b [m/s²]."""
    spin_by_resistance: Vector
    """The change of dω/dt by the resistance that comes with a unit normal force at A [rad/(N s²)]."""


class RimContact(NamedTuple):
    """The lowest point A of a rim, in one state of the coin; space frame."""

    R: Matrix
    """Rotation matrix, body to space."""
    arm: Vector
    """The arm from C to A [m]."""
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
    return rim_contact_in_flight(body, FRICTIONLESS, flight_in(body, state_of(y), True), rim)


@compiled
def both_rims(body: Body, friction: FloorFriction, y: Array) -> tuple[RimContact, RimContact]:
    """Return the `RimContact` of tails' rim and that of heads', in the state y, (13,); see `rim_contact`."""
    flight = flight_over_floor(body, friction, y)
    return (
        rim_contact_in_flight(body, friction, flight, -1.0),
        rim_contact_in_flight(body, friction, flight, 1.0),
    )


@inlined
def flight_over_floor(body: Body, friction: FloorFriction, y: Array) -> Flight:
    """Return the `Flight` of a coin that is not flat, in the state y, (13,), with the air under it."""
    flight = flight_in(body, state_of(y), True)
    if friction.contour.air > 0:
        state = flight.state
        moment = air_moment(body, friction, state.R[2], state.spin)
        by_air = add(flight.spin_rate, apply(body.inertia_inverse, moment))
        return Flight(state, flight.velocity, flight.force, by_air)
    return flight


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
    # The division and the root go on side by side.
    squared = up[0] * up[0] + up[1] * up[1]
    by_squared = 1 / squared
    by_sine = math.sqrt(squared) * by_squared
    # Outward to the rim point, and the rate at which that direction turns about ζ.
    out = (-up[0] * by_sine, -up[1] * by_sine)
    up_rate = cross(up, w)
    turning = (up[0] * up_rate[1] - up[1] * up_rate[0]) * by_squared
    r = body.radius
    a = subtract((r * out[0], r * out[1], rim * body.thickness / 2), body.center)
    a_rate = (-r * turning * out[1], r * turning * out[0], 0.0)
    turn = cross(w, a)
    return a, turn, cross(w, add(turn, a_rate))


@compiled
def tilt_time(y: Array) -> float:
    """Return the time in which the normal's horizontal part would change by as much as it is [s].

    In about this time the lowest point runs round the rim by a radian, or the tilt doubles; y: state, (13,).
    """
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    up_rate = cross(up, w)
    rate = tilt_sine_of(up_rate)
    return tilt_sine_of(up) / rate if rate > 0 else np.inf


@compiled
def lean_and_rate(y: Array) -> tuple[float, float]:
    """Return n_z, which is 0 for a coin on its edge, and its rate in the state y, (13,) [1/s]."""
    up = rotation_matrix(attitude_of(y))[2]
    return up[2], cross(up, spin_of(y))[2]


@inlined
def rim_motion(body: Body, friction: FloorFriction, flight: Flight, rim: float) -> RimMotion:
    """Return the `RimMotion` of a rim, with the resistance of the floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        flight: the `Flight` of its state, not flat.
        rim: -1 for tails' rim, 1 for heads'.
    """
    up, w = flight.state.R[2], flight.state.spin
    a, turn, turn_rate = rim_point(body, up, w, rim)
    by_air_and_weight = subtract(scale(1 / body.mass, flight.force), scale(body.gravity, up))
    if body.downhill > 0:
        by_air_and_weight = add(by_air_and_weight, scale(body.downhill, flight.state.R[0]))
    b = add(by_air_and_weight, add(cross(flight.spin_rate, a), turn_rate))
    turned = (0.0, 0.0, 0.0)
    if has_resistance(friction):
        moment = moment_per_force(body, friction, up, w)
        if has_contour(friction.contour):
            moment = add(moment, contour_moment_per_force(body, friction, up, w))
        turned = apply(body.inertia_inverse, moment)
    return RimMotion(up, a, add(flight.velocity, turn), b, turned)


@inlined
def spin_gained_at(body: Body, friction: FloorFriction, A: RimMotion, F: Vector) -> Vector:
    """Return the change of dω/dt by a force F at A and its resistance, body frame, (3,) [rad/s²]."""
    spin = apply(body.inertia_inverse, cross(A.arm, F))
    return add(spin, scale(dot(A.up, F), A.spin_by_resistance)) if has_resistance(friction) else spin


@inlined
def delassus_matrix(body: Body, friction: FloorFriction, A: RimMotion) -> Matrix:
    """Return K in the body frame, with resistance K + q ẑᵀ [1/kg]; see `RimContact.delassus`.

    Its columns are the accelerations of A by unit forces along the axes.
    """
    a, J_inverse, by_mass = A.arm, body.inertia_inverse, 1 / body.mass
    along_xi = cross(subtract(scale(a[2], J_inverse[1]), scale(a[1], J_inverse[2])), a)
    along_eta = cross(subtract(scale(a[0], J_inverse[2]), scale(a[2], J_inverse[0])), a)
    along_zeta = cross(subtract(scale(a[1], J_inverse[0]), scale(a[0], J_inverse[1])), a)
    if has_resistance(friction):
        q = cross(A.spin_by_resistance, a)
        along_xi = add(along_xi, scale(A.up[0], q))
        along_eta = add(along_eta, scale(A.up[1], q))
        along_zeta = add(along_zeta, scale(A.up[2], q))
    return (
        (by_mass + along_xi[0], along_eta[0], along_zeta[0]),
        (along_xi[1], by_mass + along_eta[1], along_zeta[1]),
        (along_xi[2], along_eta[2], by_mass + along_zeta[2]),
    )


@inlined
def write_held_rate(body: Body, flight: Flight, F: Vector, spin: Vector, dy: Array) -> None:
    """Write the rate of change of a coin's state on which a force acts beside the air into dy, (13,).

    Args:
        body: the coin.
        flight: the `Flight` of the state.
        F: the force, body frame, (3,) [N].
        spin: the change of dω/dt by it, body frame, (3,) [rad/s²].
        dy: written to.
    """
    held = Flight(flight.state, flight.velocity, add(flight.force, F), add(flight.spin_rate, spin))
    write_rate(body, held, dy)


@inlined
def rim_contact_in_flight(body: Body, friction: FloorFriction, flight: Flight, rim: float) -> RimContact:
    """Return the `RimContact` of a rim, with the resistance of the floor; args as `rim_motion`'s."""
    R, A = flight.state.R, rim_motion(body, friction, flight, rim)
    a, J_inverse, by_mass = A.arm, body.inertia_inverse, 1 / body.mass
    levers = (cross(a, R[0]), cross(a, R[1]), cross(a, R[2]))
    spins = (apply(J_inverse, levers[0]), apply(J_inverse, levers[1]), apply(J_inverse, levers[2]))
    xy, xz, yz = dot(levers[0], spins[1]), dot(levers[0], spins[2]), dot(levers[1], spins[2])
    K = (
        (by_mass + dot(levers[0], spins[0]), xy, xz),
        (xy, by_mass + dot(levers[1], spins[1]), yz),
        (xz, yz, by_mass + dot(levers[2], spins[2])),
    )
    if has_resistance(friction):
        q = apply(R, cross(A.spin_by_resistance, a))
        spins = (spins[0], spins[1], add(spins[2], A.spin_by_resistance))
        K = (
            (K[0][0], K[0][1], K[0][2] + q[0]),
            (K[1][0], K[1][1], K[1][2] + q[1]),
            (K[2][0], K[2][1], K[2][2] + q[2]),
        )
    return RimContact(
        R=R,
        arm=apply(R, a),
        spins=spins,
        delassus=K,
        free_acceleration=apply(R, A.free_acceleration),
        velocity=apply(R, A.velocity),
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
def horizontal(up: Vector, a: Vector) -> Vector:
    """Return the horizontal part of a vector, in the frame of both, (3,)."""
    return subtract(a, scale(dot(up, a), up))


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
