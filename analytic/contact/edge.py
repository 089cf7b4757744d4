"""A thick coin on its edge, on the rims of both faces: whether it comes upright, and whether it stands."""

import math

import numpy as np

from cointoss.analytic.automaton import Event, Mode
from cointoss.analytic.contact import one_rim, upright
from cointoss.analytic.contact.floor_force import friction_holds, holding_force
from cointoss.analytic.contact.one_rim import lower_rim_of
from cointoss.analytic.contact.periodic import tilt_rate
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rim_contact import both_rims
from cointoss.analytic.flight.state_vector import (
    STATE_SIZE,
    attitude_of,
    set_attitude,
    set_height,
    set_spin,
    spin_of,
    state_of,
)
from cointoss.analytic.numerics.tolerances import ON_EDGE, SLOW, STEADY
from cointoss.models.attitude import quaternion_product, rotation_matrix
from cointoss.models.body import in_vacuum
from cointoss.models.geometry import FLAT_SINE, tilt_sine_of
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, cross, dot
from cointoss.models.rest import is_slowing

# The angle by which an upright coin is tipped onto either rim, for trial [rad].
_TRIAL = 2e-9
# In so many phases of its roll a coin on its edge is tried.
_PHASES = 48
# Where it changes slowly how strongly either rim is turned back, rocking keeps its action, which goes as
# E^(3/2) (1/a₋ + 1/a₊): its energy E grows by less than this factor until it meets the weaker rim.
_GROWTH = 2 ** (2 / 3)
# An upright coin is tried for whether it stands once in so many steps.
_BETWEEN_TRIALS = 64


@compiled
def event_at_one_rim(body, friction, mode, steps, early, y):
    """Return whether a coin in contact at one rim comes upright, or stands for good: `Event.ENDS`.

    A coin without thickness does neither.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`.
        steps: made in the mode so far.
        early: whether a coin that still rocks may be said to stand; the trial is costly, and made only at the
            start of a mode and in some of the steps after.
        y: state, (13,); put upright where the coin comes so.
    """
    if body.thickness == 0:
        return Event.NONE
    if not on_edge(body, y):
        tried = early and steps % _BETWEEN_TRIALS == 1 and not has_resistance(friction)
        return Event.ENDS if tried and rocks_on_edge(body, friction, mode, y) else Event.NONE
    if not held_on_edge(body, friction, mode, y):
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
    return Event.ENDS if stands(body, friction, at_one_rim, y) else Event.NONE


@compiled
def slows(body, friction, y):
    """Return whether the floor's resistance slows a coin that stands; see `is_slowing`."""
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
    """Return whether a coin in contact is on its edge, and does not turn off it; see `ON_EDGE`."""
    n_z, n_z_rate = lean_and_rate(y)
    most = ON_EDGE * body.thickness / (2 * body.radius)
    return abs(n_z) < most and abs(n_z_rate) < most * (body.gravity / body.radius) ** 0.5


@compiled
def lean_and_rate(y):
    """Return n_z, which is 0 for a coin on its edge, and its rate in the state y, (13,) [1/s]."""
    up = rotation_matrix(attitude_of(y))[2]
    return up[2], cross(up, spin_of(y))[2]


@compiled
def steady_lean(body):
    """Return the |n_z| up to which a coin may be lifted by its rocking on its edge; see `STEADY`.

    A coin at rest has C above its lowest point at about 1/`STEADY` of it, or more. It is 0 for a coin that
    has no thickness, or C beyond a face.
    """
    x, y, z = body.center
    return STEADY * max(body.thickness / 2 - abs(z), 0.0) / (body.radius + math.hypot(x, y))


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
        roll_rates[i] = rolled_on(body, friction, mode, not straight, y, math.pi * i / _PHASES, phases[i])
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
def rocks_on_edge(body, friction, mode, y):
    """Return whether a coin that rocks on its edge, rim by rim, has too little energy of rocking to leave it.

    In every phase of its roll that it can reach, C lowest among them, the floor must turn it back from
    either rim up to `steady_lean`. The least work of that must be more than the energy of its rocking can
    become: now it is at most that of n_z's rate, and what the strongest turning back gives it from its lean.
    As its rims land it loses energy, and on a rough floor L_z: there all of its energy may go into its roll.
    Nothing is said while friction acts on slip, for across the rim it tips the coin as soon as slip turns
    there.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        y: state, (13,).
    """
    n_z, n_z_rate = lean_and_rate(y)
    most_lean, moving = steady_lean(body), n_z_rate * n_z_rate / 2
    slips = friction.sliding > 0 and mode != Mode.STICKING
    if slips or not abs(n_z) < most_lean:
        return False
    least_work, strongest, phase = np.inf, 0.0, np.empty(STATE_SIZE)
    L_z = dot(rotation_matrix(attitude_of(y))[2], apply(body.inertia, spin_of(y)))
    for i in range(_PHASES):
        half_angle = to_lowest(body, y) / 2 + math.pi * i / _PHASES
        roll_rate = rolled_on(body, friction, mode, friction.sliding == 0, y, half_angle, phase)
        if roll_rate < 0:
            continue
        for share in (1.0, -1.0, 0.0):
            set_rolling(body, L_z, False, share * roll_rate, phase)
            for side in (-1.0, 1.0):
                at_edge = turned_back(body, friction, mode, side, _TRIAL, phase)
                leaning = turned_back(body, friction, mode, side, most_lean, phase)
                strongest = max(strongest, at_edge)
                least_work = min(least_work, (at_edge + leaning) / 2 * most_lean)
                energy = moving + abs(n_z) * strongest
                if not (min(at_edge, leaning) > 0 and _GROWTH * energy < least_work):
                    return False
    return least_work < np.inf


@compiled
def to_lowest(body, y):
    """Return the angle by which a coin in the state y, (13,), rolls until C is lowest [rad]."""
    up, center = rotation_matrix(attitude_of(y))[2], body.center
    return math.atan2(up[1], up[0]) - math.atan2(-center[1], -center[0])


@compiled
def _sticks(body, friction, y):
    """Return whether friction can hold a coin on its edge by either rim; y: state, (13,)."""
    tails, heads = both_rims(body, friction, y)
    return friction_holds(
        friction.sliding, holding_force(tails.mobility, tails.free_acceleration)
    ) and friction_holds(friction.sliding, holding_force(heads.mobility, heads.free_acceleration))


@compiled
def rolled_on(body, friction, mode, keeps_turning, y, half_angle, phase):
    """Roll a coin on its edge on by an angle.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        keeps_turning: whether L_z and the energy that it takes are kept.
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
    if keeps_turning:
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
    on_heads = turned_back(body, friction, mode, -1.0, _TRIAL, y)
    return on_heads > 0 and turned_back(body, friction, mode, 1.0, _TRIAL, y) > 0


@compiled
def turned_back(body, friction, mode, side, lean, y):
    """Return how fast n_z accelerates back to 0 of a coin leaning onto a rim [1/s²]; < 0 where it does not.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, at one rim.
        side: 1 with heads up, on tails' rim, -1 with tails up.
        lean: |n_z|.
        y: state that is tried so, (13,).
    """
    dy, tipped = np.empty(STATE_SIZE), y.copy()
    # To the first order, the second time from next to nothing.
    for most in (0.0, side * lean):
        n_z, _ = lean_and_rate(tipped)
        upright.tilt(tipped, n_z - most)
    one_rim.rate(body, friction, mode, lower_rim_of(tipped), tipped, dy)
    up, w = rotation_matrix(attitude_of(tipped))[2], spin_of(tipped)
    return -side * (cross(cross(up, w), w)[2] + cross(up, spin_of(dy))[2])
