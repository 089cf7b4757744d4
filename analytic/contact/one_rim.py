"""Contact at one rim point A: what sliding, creeping and sticking have in common."""

import math

import numpy as np

from analytic.automaton import Event, Mode
from analytic.contact import creeping, sliding, sticking
from analytic.contact.floor_force import friction_holds, holding_force, slip_direction, starting_slip
from analytic.contact.rim_contact import accelerate, rim_contact, rim_contact_in_flight
from analytic.flight.equations_of_motion import flight_of, write_rate
from analytic.flight.state_vector import attitude_of, normalise, set_attitude, set_height, spin_of
from analytic.impact.coulomb import coulomb
from analytic.numerics.tolerances import BORDER, SLOW
from models.attitude import rotation_matrix
from models.geometry import FACE_SINE, lower_rim, tilt_sine_of
from models.kernel.compiled import compiled
from models.kernel.vectors import cross, dot
from models.laws import RestitutionKind


@compiled
def lower_rim_of(y):
    """Return the `lower_rim` of the state y, (13,)."""
    return lower_rim(rotation_matrix(attitude_of(y))[2][2])


@compiled
def force(A, mu, mode):
    """Return the floor's force at A in a mode, space frame, (3,) [N].

    Args:
        A: the `RimContact`.
        mu: coefficient of friction μ, 0 on a smooth floor.
        mode: number of the `Mode`.
    """
    if mode == Mode.STICKING:
        return sticking.force(A)
    return creeping.force(A, mu) if mode == Mode.CREEPING else sliding.force(A, mu)


@compiled
def rate(body, friction, mode, rim, y, dy):
    """Write the rate of change of the state y of a coin in contact at one rim into dy; both (13,).

    Returns:
        The `margin` of the contact in this state.
    """
    flight = flight_of(body, y)
    write_rate(body, flight, dy)
    A = rim_contact_in_flight(body, friction, flight, rim)
    F = force(A, friction.sliding, mode)
    accelerate(body, A, F, dy)
    return margin(body, A, F, friction.sliding, mode, rim)


@compiled
def put_on_floor(body, friction, mode, rim, y):
    """Bring A to the floor, and by an impulse there its velocity to what the mode allows.

    A point that sticks has none; one that slides has v_Az = 0; one that creeps slips in the direction in
    which its slip grows. The impulse is without resistance.
    """
    A, mu = rim_contact(body, y, rim), friction.sliding
    set_height(y, -A.arm[2])
    if mode == Mode.STICKING:
        S = sticking.stopping_impulse(A)
    elif mode == Mode.CREEPING:
        B = rim_contact_in_flight(body, friction, flight_of(body, y), rim)
        S = creeping.stopping_impulse(A, starting_slip(B.mobility, B.free_acceleration, mu))
    else:
        S = sliding.stopping_impulse(A, mu)
    accelerate(body, A, S, y)


@compiled
def margin(body, A, F, mu, mode, rim):
    """Return how far a contact is from its end: positive in it, 0 or below past it.

    It ends when the floor would have to pull, when the coin comes upon its edge, so that the other rim lands,
    or upon a face; and as its mode ends.

    Args:
        body: the coin.
        A: the `RimContact`.
        F: the floor's force there, space frame, (3,) [N].
        mu: coefficient of friction μ.
        mode: number of the `Mode`.
        rim: that is in contact.
    """
    up = A.R[2]
    left = min(F[2] / (body.mass * body.gravity), tilt_sine_of(up) / FACE_SINE - 1)
    if body.thickness > 0:
        left = min(left, -rim * up[2])
    if mode == Mode.STICKING:
        return min(left, sticking.margin(body, F, mu))
    if mode == Mode.CREEPING:
        return min(left, creeping.margin(body, A, mu))
    return min(left, sliding.margin(body, A, mu))


@compiled
def landing(body, rim, y):
    """Return which part of the coin lands in the state y, (13,), just past the end of a contact at a rim."""
    up = rotation_matrix(attitude_of(y))[2]
    if body.thickness > 0 and -rim * up[2] <= 0:
        return Event.RIM_LANDS
    return Event.FACE_LANDS if tilt_sine_of(up) <= FACE_SINE else Event.NONE


@compiled
def time_to_landing(body, rim, y, dy):
    """Return when the other rim would land if n_z were a parabola [s], infinite where it would not.

    Args:
        body: the coin.
        rim: that is in contact.
        y: state, (13,).
        dy: its rate of change, (13,).
    """
    if body.thickness == 0:
        return np.inf
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    up_rate = cross(up, w)
    left, speed = max(-rim * up[2], 0.0), -rim * up_rate[2]
    acceleration = -rim * (cross(up_rate, w)[2] + cross(up, spin_of(dy))[2])
    squared = speed * speed - 2 * left * acceleration
    if not squared >= 0:
        return np.inf
    if speed < 0:
        return 2 * left / (squared**0.5 - speed)
    return (speed + squared**0.5) / -acceleration if acceleration < 0 else np.inf


@compiled
def lay_flat(body, y):
    """Turn a coin that all but lies on a face until it does, and all of the face touches the floor.

    A coin whose axis passes the vertical at a tilt below `FACE_SINE` would go on upon its rim, around which
    the lowest point runs in no time: here the opposite rim point lands, as where the axis passes through it.
    """
    a, b, c, d = attitude_of(y)
    heads_up = rotation_matrix((a, b, c, d))[2][2] > 0
    set_attitude(y, (a, 0.0, 0.0, d) if heads_up else (0.0, b, c, 0.0))
    normalise(y)
    set_height(y, body.thickness / 2 + (body.center[2] if heads_up else -body.center[2]))


@compiled
def next_event(body, friction, mode, y):
    """Return how a coin goes on whose lowest point is on the floor with v_Az = 0; stop slip where A sticks.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode` up to here.
        y: state, (13,).
    """
    rim, mu = lower_rim_of(y), friction.sliding
    A = rim_contact_in_flight(body, friction, flight_of(body, y), rim)
    K, b, v_A = A.mobility, A.free_acceleration, A.velocity
    if b[2] >= 0:
        return Event.LIFTS_OFF
    if mu == 0:
        return Event.SLIPS
    slow = SLOW * (body.gravity * body.radius) ** 0.5
    # A mode that ends at its bound must not go on for rounding.
    least = (1 + BORDER) * slow / 2 if mode == Mode.SLIDING else (1 - BORDER) * slow
    if math.hypot(v_A[0], v_A[1]) > least:
        s = slip_direction(v_A, mu)
        if dot(K[2], (-mu * s[0], -mu * s[1], 1.0)) > 0:
            return Event.SLIPS
        # Painlevé: sliding presses the coin into the floor, until an impact without approach stops the slip.
        S = coulomb(K, (v_A[0], v_A[1], -1e-6 * slow), 0.0, mu, RestitutionKind.KINEMATIC)
        accelerate(body, A, S, y)
    holds = friction_holds(mu, holding_force(K, b))
    put_on_floor(body, friction, Mode.STICKING.value if holds else Mode.CREEPING.value, rim, y)
    return Event.SLIP_STOPS if holds else Event.SLIP_STARTS
