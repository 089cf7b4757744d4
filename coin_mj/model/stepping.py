"""How long the next step may be."""

from typing import NamedTuple

from coin_mj.model.state import to_mass_center
from models.attitude import rotation_matrix
from models.clearance import clear_time
from models.geometry import contact_velocity, gap, lowest_point
from models.kernel.compiled import compiled
from models.kernel.vectors import norm


class Outlook(NamedTuple):
    """What a state of the coin says about its next step."""

    height: float
    """Gap of the coin's shape, negative in contact [m]."""
    speed: float
    """Vertical velocity of the lowest point [m/s]."""
    clear: float
    """A step of free flight that surely ends before the coin touches [s]."""


@compiled
def outlook(shape, floor, flight_angle, qpos, qvel):
    """Look at a state of the coin.

    Args:
        shape: the coin, with the thickness of its shape.
        floor: height of the floor below the shape [m].
        flight_angle: largest turn of the coin in a step of free flight [rad].
        qpos: of the free joint, (7,).
        qvel: of the free joint, (6,).
    """
    x, v, e, w = to_mass_center(shape, qpos, qvel)
    R = rotation_matrix(e)
    z = x[2] - floor
    point, flat = lowest_point(shape, R[2], w)
    speed = v[2] if flat else contact_velocity(shape, R, v, w, point)[2]
    longest = flight_angle / turning_rate(shape, w)
    return Outlook(gap(shape, z, R[2]), speed, clear_time(shape, z, v, R[2], w, longest))


@compiled
def turning_rate(body, w):
    """Give the rate at which the coin turns, or would soon turn in contact [rad/s]."""
    return max(norm(w), (body.gravity / body.radius) ** 0.5)
