"""Between MuJoCo's state and the records': the free joint carries B, the records carry C.

Both have velocities in space, the angular velocity in the body, and Euler parameters with the scalar first.
"""

import numpy as np

from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, cross, subtract
from models.records import Array
from models.scenario import Release


@compiled
def to_mass_center(body, qpos, qvel):
    """Give position and velocity of C (space), Euler parameters and angular velocity (body).

    Args:
        body: the coin.
        qpos: of the free joint, (7,).
        qvel: of the free joint, (6,).
    """
    e = (qpos[3], qpos[4], qpos[5], qpos[6])
    w = (qvel[3], qvel[4], qvel[5])
    R = rotation_matrix(e)
    x = add((qpos[0], qpos[1], qpos[2]), apply(R, body.center))
    v = add((qvel[0], qvel[1], qvel[2]), apply(R, cross(w, body.center)))
    return x, v, e, w


@compiled
def of_mass_center(body, x, v, e, w):
    """Give position and velocity of B, space frame, of a state in which C is at x with the velocity v.

    Args:
        body: the coin.
        x: position of C, (3,) [m].
        v: velocity of C, (3,) [m/s].
        e: Euler parameters, (4,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    R = rotation_matrix(e)
    return subtract(x, apply(R, body.center)), subtract(v, apply(R, cross(w, body.center)))


def of_release(body, release: Release) -> tuple[Array, Array]:
    """Give qpos, (7,), and qvel, (6,), of a release.

    Args:
        body: the coin.
        release: position and velocity of C, attitude, angular velocity.
    """
    e, w = release.attitude, release.angular_velocity
    x_B, v_B = of_mass_center(body, release.position, release.velocity, e, w)
    return np.array([*x_B, *e]), np.array([*v_B, *w])
