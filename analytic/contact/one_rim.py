"""Contact at one rim point A: what sliding, creeping and sticking have in common."""

import math

import numpy as np

from cointoss.analytic.automaton import Event, Mode
from cointoss.analytic.contact import creeping, sliding, smooth, sticking
from cointoss.analytic.contact.floor_force import friction_holds, holding_force, slip_direction, starting_slip
from cointoss.analytic.contact.resistance import is_smooth
from cointoss.analytic.contact.rim_contact import (
    accelerate,
    contact_margin,
    rim_contact,
    rim_contact_in_flight,
)
from cointoss.analytic.flight.equations_of_motion import flight_of, write_rate
from cointoss.analytic.flight.state_vector import attitude_of, normalise, set_attitude, set_height, spin_of
from cointoss.analytic.impact.coulomb import coulomb
from cointoss.analytic.numerics.tolerances import BORDER, SLOW
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import FACE_SINE, lower_rim, tilt_sine_of
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import cross, dot
from cointoss.models.laws import RestitutionKind


@compiled
def lower_rim_of(y):
    """Return the `lower_rim` of the state y, (13,)."""
    return lower_rim(rotation_matrix(attitude_of(y))[2][2])


@inlined
def sliding_rate(body, friction, rim, y, dy):
    """Write the rate of change of the state y of a coin whose rim point slides into dy; both (13,).

    Returns:
        How far the mode is from its end: positive in it, 0 or below past it.
    """
    A = _unheld(body, friction, rim, y, dy)
    F, left = sliding.force_and_margin(body, A, friction.sliding)
    return min(_held(body, rim, A, F, dy), left)


@inlined
def sticking_rate(body, friction, rim, y, dy):
    """As `sliding_rate`, of a coin whose rim point sticks."""
    A = _unheld(body, friction, rim, y, dy)
    F = sticking.force(A)
    return min(_held(body, rim, A, F, dy), sticking.margin(body, F, friction.sliding))


@inlined
def creeping_rate(body, friction, rim, y, dy):
    """As `sliding_rate`, of a coin whose rim point creeps."""
    A = _unheld(body, friction, rim, y, dy)
    F = creeping.force(A, friction.sliding)
    return min(_held(body, rim, A, F, dy), creeping.margin(body, A, friction.sliding))


@inlined
def _unheld(body, friction, rim, y, dy):
    """Write the rate of change in flight into dy, and return the `RimContact` there."""
    flight = flight_of(body, y)
    write_rate(body, flight, dy)
    return rim_contact_in_flight(body, friction, flight, rim)


@inlined
def _held(body, rim, A, F, dy):
    """Add what the floor's force F at A gives to dy, and return the `contact_margin`."""
    accelerate(body, A, F, dy)
    return contact_margin(body, A.R[2], F[2], rim)


@compiled
def rate(body, friction, mode, rim, y, dy):
    """Write the rate of change of the state y of a coin in contact at one rim into dy; both (13,).

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        rim: that is in contact.
        y: state, (13,).
        dy: where its rate of change goes, (13,).

    Returns:
        How far the mode is from its end: positive in it, 0 or below past it.
    """
    if mode == Mode.STICKING:
        return sticking_rate(body, friction, rim, y, dy)
    if mode == Mode.CREEPING:
        return creeping_rate(body, friction, rim, y, dy)
    if is_smooth(friction):
        return smooth.rate(body, rim, y, dy)
    return sliding_rate(body, friction, rim, y, dy)


@compiled
def put_on_floor(body, friction, mode, rim, y):
    """Bring A to the floor, and by an impulse there its velocity to what the mode allows.

    A point that sticks has none; one that slides has v_Az = 0; one that creeps slips in the direction in
    which its slip grows. The impulse is without resistance.
    """
    if mode == Mode.SLIDING and is_smooth(friction):
        smooth.put_on_floor(body, rim, y)
        return
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
