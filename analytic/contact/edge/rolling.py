"""A coin on its edge in other phases of its roll: how fast it can roll there."""

import math

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.flight.state_vector import attitude_of, set_attitude, set_height, set_spin, state_of
from cointoss.models.attitude import quaternion_product, rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import tilt_sine_of
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, cross, dot
from cointoss.models.records import Array

PHASES = 48
"""A coin on its edge is tried in this number of phases of its roll."""


@compiled
def roll_by(
    contact: SustainedContact, keeps_turning: bool, y: Array, half_angle: float, phase: Array
) -> float:
    """Roll a coin on its edge on by an angle.

    Args:
        contact: the contact, at one rim.
        keeps_turning: whether L_z and the energy that it takes are kept.
        y: state of a coin on its edge, (13,).
        half_angle: half the angle.
        phase: where the state there goes, (13,), its velocities those of y.

    Returns:
        The largest roll rate that the energy leaves there [rad/s], -1 where the coin does not get there. On
        a smooth floor the horizontal velocity takes no part; a coin that sticks rolls about the floor's line.
    """
    body, friction = contact.body, contact.friction
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
    if contact.mode == Mode.STICKING:
        roll_inertia += m * z * z
    left = energy - weight * z
    if keeps_turning:
        moment, product = dot(up, apply(J, up)), dot(up, J[2])
        roll_inertia -= product * product / moment
        left -= L_z * L_z / (2 * moment)
    return (2 * max(left, 0.0) / roll_inertia) ** 0.5 if left > -1e-9 * weight * body.radius else -1.0


@compiled
def set_roll_rate(body: Body, L_z: float, straight: bool, roll_rate: float, y: Array) -> None:
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
def to_lowest(body: Body, y: Array) -> float:
    """Return the angle by which a coin in the state y, (13,), rolls until C is lowest [rad]."""
    up, center = rotation_matrix(attitude_of(y))[2], body.center
    return math.atan2(up[1], up[0]) - math.atan2(-center[1], -center[0])
