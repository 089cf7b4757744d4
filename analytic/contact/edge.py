"""A thick coin on its edge, on the rims of both faces: whether it stands."""

import math

import numpy as np

from analytic.contact.contact import contact_rate
from analytic.contact.floor_force import SLOW, Motion, contact, holding_force, holds, side_of
from analytic.flight.equations_of_motion import STATE_SIZE, attitude_of, derivative, spin_of, velocity_of
from analytic.numerics.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.body import in_vacuum
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, cross, dot, scale

# A sine of the angle off the edge, and its rate against √(g/r), below which a coin is on its edge.
_ON_EDGE = 1e-6
# The angle by which a coin on its edge is tried on either rim.
_TIP = 1e-9
# In so many phases of its roll a coin on its edge is tried.
_PHASES = 48


@compiled
def on_edge(body, y):
    """Tell whether a coin in contact is on its edge, and does not turn off it."""
    up = rotation_matrix(attitude_of(y))[2]
    n_z_rate = cross(up, spin_of(y))[2]
    rate = (body.gravity / body.radius) ** 0.5
    return body.thickness > 0 and abs(up[2]) < _ON_EDGE and abs(n_z_rate) < _ON_EDGE * rate


@compiled
def rolls(body, mu, y):
    """Tell whether a coin on its edge rolls straight on: neither rim slips on a rough floor.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        y: state of a coin on its edge, (13,).
    """
    if mu == 0:
        return False
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0)[4], contact(body, y, dy, -1.0)[4]
    slip = max(math.hypot(tails[0], tails[1]), math.hypot(heads[0], heads[1]))
    return slip < SLOW * (body.gravity * body.radius) ** 0.5


@compiled
def stands(body, mu, motion, y):
    """Tell whether a coin on its edge is held there however it rolls on.

    Rolling brings C up and down, and so changes the roll rate: the floor must hold the coin in every phase
    that it can reach. It rolls at most as fast as its energy leaves it there: just so fast in vacuum on a
    smooth floor or without slip, slower and either way where it loses energy. It turns about the vertical as
    L_z has it, unless it `rolls`: then not at all.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact, at one rim point.
        y: state of a coin on its edge, (13,).
    """
    straight = rolls(body, mu, y)
    if straight:
        motion = Motion.STICKING
    if not held_on_edge(body, mu, motion, y):
        return False
    lossless = (mu == 0 or straight) and in_vacuum(body)
    phases, roll_rates = np.empty((_PHASES, STATE_SIZE)), np.empty(_PHASES)
    for i in range(_PHASES):
        roll_rates[i] = rolled_on(body, mu, motion, straight, y, math.pi * i / _PHASES, phases[i])
    one_way = lossless and roll_rates.min() > 0
    L_z = dot(rotation_matrix(attitude_of(y))[2], apply(body.inertia, spin_of(y)))
    for i in range(_PHASES):
        for share in (1.0, -1.0, 0.0):
            if roll_rates[i] < 0 or (one_way and share * y[12] < 0) or (lossless and share == 0):
                continue
            set_rolling(body, L_z, straight, share * roll_rates[i], phases[i])
            if not held_on_edge(body, mu, motion, phases[i]) or (
                straight and not _sticks(body, mu, phases[i])
            ):
                return False
    return True


@compiled
def _sticks(body, mu, y):
    """Tell whether friction can hold a coin on its edge by either rim; y: state, (13,)."""
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    for side in (-1.0, 1.0):
        _, _, K, b, _ = contact(body, y, dy, side)
        if not holds(mu, holding_force(K, b)):
            return False
    return True


@compiled
def rolled_on(body, mu, motion, straight, y, half_angle, phase):
    """Roll a coin on its edge on by an angle.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact, at one rim point.
        straight: whether it does not turn about the vertical.
        y: state of a coin on its edge, (13,).
        half_angle: half the angle.
        phase: where the state there goes, (13,), its velocities those of y.

    Returns:
        The largest roll rate that the energy leaves there [rad/s], -1 where the coin does not get there. On
        a smooth floor the horizontal velocity takes no part; a coin that sticks rolls about the floor's line.
    """
    J, m, weight = body.inertia, body.mass, body.mass * body.gravity
    up, w, v = rotation_matrix(attitude_of(y))[2], spin_of(y), velocity_of(y)
    L_z = dot(up, apply(J, w))
    energy = (dot(w, apply(J, w)) + m * v[2] * v[2]) / 2 + weight * y[2]
    if mu > 0:
        energy += m * (v[0] * v[0] + v[1] * v[1]) / 2
    e0, e1, e2, e3 = attitude_of(y)
    c, s = math.cos(half_angle), math.sin(half_angle)
    phase[:] = y
    phase[6], phase[7] = c * e0 - s * e3, c * e1 + s * e2
    phase[8], phase[9] = c * e2 - s * e1, c * e3 + s * e0
    up = rotation_matrix(attitude_of(phase))[2]
    phase[2] = body.radius * math.hypot(up[0], up[1]) + dot(up, body.center)
    rise = cross(up, (0.0, 0.0, 1.0))
    roll_inertia = J[2][2] + m * dot(rise, body.center) ** 2
    if motion == Motion.STICKING:
        roll_inertia += m * phase[2] * phase[2]
    left = energy - weight * phase[2]
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
    for k in range(3):
        y[10 + k] = turn_rate * up[k]
    y[12] += roll_rate


@compiled
def held_on_edge(body, mu, motion, y):
    """Tell whether the floor's force on either rim turns a coin on its edge back to the other now.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state of a coin on its edge, (13,).
    """
    dy, tipped = np.empty(STATE_SIZE), y.copy()
    R = rotation_matrix(attitude_of(y))
    for side in (-1.0, 1.0):
        # Turn the coin a little to the side, about the horizontal axis in its plane.
        axis = cross(R[2], (0.0, 0.0, 1.0))
        turn = quaternion_rate(attitude_of(y), scale(side * 2 * _TIP, axis))
        for i in range(4):
            tipped[6 + i] = y[6 + i] + turn[i]
        contact_rate(body, mu, motion, side_of(tipped), tipped, dy)
        up, w = rotation_matrix(attitude_of(tipped))[2], spin_of(tipped)
        up_rate = cross(up, w)
        n_z_acceleration = cross(up_rate, w)[2] + cross(up, (dy[10], dy[11], dy[12]))[2]
        if n_z_acceleration * up[2] >= 0:
            return False
    return True
