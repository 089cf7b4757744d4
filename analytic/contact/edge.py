"""A thick coin on its edge, on the rims of both faces: whether it comes upright, and whether it stands."""

import math

import numpy as np

from analytic.automaton import Event, Mode
from analytic.contact import one_rim, upright
from analytic.contact.floor_force import friction_holds, holding_force
from analytic.contact.one_rim import lower_rim_of
from analytic.contact.periodic import tilt_rate
from analytic.contact.resistance import has_resistance
from analytic.contact.rim_contact import both_rims
from analytic.flight.state_vector import (
    STATE_SIZE,
    attitude_of,
    set_attitude,
    set_height,
    set_spin,
    spin_of,
    state_of,
)
from analytic.numerics.rotation import quaternion_rate
from analytic.numerics.tolerances import ON_EDGE, SLOW
from models.attitude import quaternion_product, rotation_matrix
from models.body import in_vacuum
from models.geometry import FLAT_SINE, tilt_sine_of
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, cross, dot, scale
from models.rest import is_slowing

# Half the angle by which a coin on its edge is tipped onto either rim, for trial.
_TRIAL = 1e-9
# In so many phases of its roll a coin on its edge is tried.
_PHASES = 48
# An upright coin is tried for whether it stands once in so many steps.
_BETWEEN_TRIALS = 64


@compiled
def event_at_one_rim(body, friction, mode, y):
    """Return whether a coin in contact at one rim comes upright, or stands for good: `Event.ENDS`.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`.
        y: state, (13,); put upright where the coin comes so.
    """
    if not (on_edge(body, y) and held_on_edge(body, friction, mode, y)):
        return Event.NONE
    if not slows(body, friction, y) and stands(body, friction, mode, y):
        return Event.ENDS
    both = y.copy()
    upright.put_on_floor(body, both)
    if mode == Mode.STICKING:
        upright.start_creep(body, friction, lower_rim_of(y), both)
    if not upright.margin(body, friction, both) > 0:
        return Event.NONE
    copy_into(y, both)
    return Event.COMES_UPRIGHT


@compiled
def event_of_upright_coin(body, friction, steps, y):
    """Return whether an upright coin stands for good: `Event.ENDS`.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        steps: made upright so far; the trial is costly, and made only in some of them.
        y: state, (13,).
    """
    at_one_rim = Mode.SLIDING.value
    if steps % _BETWEEN_TRIALS != 0 or slows(body, friction, y):
        return Event.NONE
    if not held_on_edge(body, friction, at_one_rim, y):
        return Event.NONE
    return Event.ENDS if stands(body, friction, at_one_rim, y) else Event.NONE


@compiled
def slows(body, friction, y):
    """Return whether the floor's resistance slows a coin that stands; see `models.rest.is_slowing`."""
    w = apply(rotation_matrix(attitude_of(y)), spin_of(y))
    return is_slowing(body, friction.rolling, friction.pivoting, w)


@compiled
def lean(body, y):
    """Let a coin that is just passing its edge lean as it turns: onto the rim that landed.

    Args:
        body: the coin.
        y: state, (13,).
    """
    up, rate = rotation_matrix(attitude_of(y))[2], tilt_rate(y)
    if body.thickness > 0 and abs(up[2]) < FLAT_SINE and rate != 0:
        upright.tilt(y, up[2] - math.copysign(FLAT_SINE / 8, rate))


@compiled
def on_edge(body, y):
    """Return whether a coin in contact is on its edge, and does not turn off it."""
    up = rotation_matrix(attitude_of(y))[2]
    n_z_rate = cross(up, spin_of(y))[2]
    most = ON_EDGE * body.thickness / (2 * body.radius)
    return abs(up[2]) < most and abs(n_z_rate) < most * (body.gravity / body.radius) ** 0.5


@compiled
def rolls(body, friction, y):
    """Return whether a coin on its edge rolls straight on: neither rim slips on a rough floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        y: state of a coin on its edge, (13,).
    """
    if friction.sliding == 0:
        return False
    tails, heads = both_rims(body, friction, y)
    slip = max(
        math.hypot(tails.velocity[0], tails.velocity[1]), math.hypot(heads.velocity[0], heads.velocity[1])
    )
    return slip < SLOW * (body.gravity * body.radius) ** 0.5


@compiled
def stands(body, friction, mode, y):
    """Return whether a coin on its edge is held there however it rolls on.

    Rolling brings C up and down, and so changes the roll rate: the floor must hold the coin in every phase
    that it can reach. It rolls at most as fast as its energy leaves it there: just so fast in vacuum on a
    smooth floor or without slip, slower and either way where it loses energy. It turns about the vertical as
    L_z has it, unless it `rolls`: then not at all.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        y: state of a coin on its edge, (13,).
    """
    straight = rolls(body, friction, y)
    if straight:
        mode = Mode.STICKING.value
    if not held_on_edge(body, friction, mode, y):
        return False
    lossless = (friction.sliding == 0 or straight) and in_vacuum(body) and not has_resistance(friction)
    one_way = lossless
    phases, roll_rates = np.empty((_PHASES, STATE_SIZE)), np.empty(_PHASES)
    for i in range(_PHASES):
        roll_rates[i] = rolled_on(body, friction, mode, straight, y, math.pi * i / _PHASES, phases[i])
        one_way = one_way and roll_rates[i] > 0
    L_z = dot(rotation_matrix(attitude_of(y))[2], apply(body.inertia, spin_of(y)))
    for i in range(_PHASES):
        for share in (1.0, -1.0, 0.0):
            if roll_rates[i] < 0 or (one_way and share * spin_of(y)[2] < 0) or (lossless and share == 0):
                continue
            set_rolling(body, L_z, straight, share * roll_rates[i], phases[i])
            if not held_on_edge(body, friction, mode, phases[i]) or (
                straight and not _sticks(body, friction, phases[i])
            ):
                return False
    return True


@compiled
def _sticks(body, friction, y):
    """Return whether friction can hold a coin on its edge by either rim; y: state, (13,)."""
    tails, heads = both_rims(body, friction, y)
    return friction_holds(
        friction.sliding, holding_force(tails.mobility, tails.free_acceleration)
    ) and friction_holds(friction.sliding, holding_force(heads.mobility, heads.free_acceleration))


@compiled
def rolled_on(body, friction, mode, straight, y, half_angle, phase):
    """Roll a coin on its edge on by an angle.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        straight: whether it does not turn about the vertical.
        y: state of a coin on its edge, (13,).
        half_angle: half the angle.
        phase: where the state there goes, (13,), its velocities those of y.

    Returns:
        The largest roll rate that the energy leaves there [rad/s], -1 where the coin does not get there. On
        a smooth floor the horizontal velocity takes no part; a coin that sticks rolls about the floor's line.
    """
    J, m, weight = body.inertia, body.mass, body.mass * body.gravity
    state = state_of(y)
    up, w, v = state.R[2], state.spin, state.velocity
    L_z = dot(up, apply(J, w))
    energy = (dot(w, apply(J, w)) + m * v[2] * v[2]) / 2 + weight * state.position[2]
    if friction.sliding > 0:
        energy += m * (v[0] * v[0] + v[1] * v[1]) / 2
    c, s = math.cos(half_angle), math.sin(half_angle)
    copy_into(phase, y)
    set_attitude(phase, quaternion_product(state.attitude, (c, 0.0, 0.0, s)))
    up = rotation_matrix(attitude_of(phase))[2]
    z = body.radius * tilt_sine_of(up) + dot(up, body.center)
    set_height(phase, z)
    rise = cross(up, (0.0, 0.0, 1.0))
    roll_inertia = J[2][2] + m * dot(rise, body.center) ** 2
    if mode == Mode.STICKING:
        roll_inertia += m * z * z
    left = energy - weight * z
    if not straight:
        moment, product = dot(up, apply(J, up)), dot(up, J[2])
        roll_inertia -= product * product / moment
        left -= L_z * L_z / (2 * moment)
    return (2 * max(left, 0.0) / roll_inertia) ** 0.5 if left > -1e-9 * weight * body.radius else -1.0


@compiled
def set_rolling(body, L_z, straight, roll_rate, y):
    """Let a coin on its edge roll at a rate, and turn about the vertical as L_z has it, or not at all.

    Args:
        body: the coin.
        L_z: angular momentum about the vertical [kg m²/s].
        straight: whether it does not turn.
        roll_rate: about ζ [rad/s].
        y: state, (13,); its velocities change.
    """
    turn_rate = 0.0
    up = rotation_matrix(attitude_of(y))[2]
    if not straight:
        about_vertical = apply(body.inertia, up)
        turn_rate = (L_z - roll_rate * about_vertical[2]) / dot(up, about_vertical)
    set_spin(y, (turn_rate * up[0], turn_rate * up[1], turn_rate * up[2] + roll_rate))


@compiled
def held_on_edge(body, friction, mode, y):
    """Return whether the floor's force on either rim turns a coin on its edge back to the other now.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        y: state of a coin on its edge, (13,).
    """
    dy, tipped = np.empty(STATE_SIZE), y.copy()
    # Level the coin, then turn it a little to either side, about the horizontal axis in its plane.
    upright.tilt(tipped, rotation_matrix(attitude_of(y))[2][2])
    state = state_of(tipped)
    e, w = state.attitude, state.spin
    axis = cross(state.R[2], (0.0, 0.0, 1.0))
    for side in (-1.0, 1.0):
        turn = quaternion_rate(e, scale(side * 2 * _TRIAL, axis))
        set_attitude(tipped, (e[0] + turn[0], e[1] + turn[1], e[2] + turn[2], e[3] + turn[3]))
        one_rim.rate(body, friction, mode, lower_rim_of(tipped), tipped, dy)
        up = rotation_matrix(attitude_of(tipped))[2]
        n_z_acceleration = cross(cross(up, w), w)[2] + cross(up, spin_of(dy))[2]
        if n_z_acceleration * up[2] >= 0:
            return False
    return True
