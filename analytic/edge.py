"""A thick coin on its edge, on the rims of both faces: whether it stands."""

import math

import numpy as np

from analytic.contact import contact_rate
from analytic.flight import STATE_SIZE, attitude_of, spin_of
from analytic.floor_force import side_of
from analytic.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.compiled import compiled
from models.vectors import apply, cross, dot, scale

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
def stands(body, mu, motion, y):
    """Tell whether a coin on its edge is held there however it rolls on.

    Rolling brings C up and down, and so changes the roll rate: the floor must hold the coin in every phase
    that it can reach, at rest and at the largest roll rate that its energy of turning leaves there. It turns
    about the vertical as L_z has it.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state of a coin on its edge, (13,).
    """
    J, weight = body.inertia, body.mass * body.gravity
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    L_z, energy = dot(up, apply(J, w)), dot(w, apply(J, w)) / 2 + weight * y[2]
    if not held_on_edge(body, mu, motion, y):
        return False
    phase = y.copy()
    e0, e1, e2, e3 = attitude_of(y)
    for i in range(_PHASES):
        c, s = math.cos(math.pi * i / _PHASES), math.sin(math.pi * i / _PHASES)
        phase[6], phase[7] = c * e0 - s * e3, c * e1 + s * e2
        phase[8], phase[9] = c * e2 - s * e1, c * e3 + s * e0
        up = rotation_matrix(attitude_of(phase))[2]
        phase[2] = body.radius * math.hypot(up[0], up[1]) + dot(up, body.center)
        moment = dot(up, apply(J, up))
        left = energy - weight * phase[2] - L_z * L_z / (2 * moment)
        fastest = (2 * max(left, 0.0) / J[2][2]) ** 0.5
        for rolling in (-fastest, 0.0, fastest):
            for k in range(3):
                phase[10 + k] = L_z / moment * up[k]
            phase[12] += rolling
            if left > -1e-9 * weight * body.radius and not held_on_edge(body, mu, motion, phase):
                return False
    return True


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
