"""Between MuJoCo's state and the records': the free joint carries B, the records carry C.

Both have velocities in space, the angular velocity in the body, and Euler parameters with the scalar first.
"""

import numpy as np

from cointoss.coin_mj.model.library import mj_reset
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.models.attitude import Quaternion, rotation_matrix
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, cross, scale, subtract
from cointoss.models.parts import Release
from cointoss.models.records import Array
from cointoss.models.state import State

Motion = tuple[float, float, float, float, float, float, float, float, float, float, float, float, float]
"""qpos and qvel of the free joint."""


@compiled
def to_mass_center(body: Body, qpos: Array, qvel: Array) -> State:
    """Return the `State` of a free joint.

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
    return State(x, v, e, w, R)


@compiled
def of_mass_center(body: Body, x: Vector, v: Vector, e: Quaternion, w: Vector) -> tuple[Vector, Vector]:
    """Return position and velocity of B, space frame, of a state in which C is at x with the velocity v.

    Args:
        body: the coin.
        x: position of C, (3,) [m].
        v: velocity of C, (3,) [m/s].
        e: Euler parameters, (4,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    R = rotation_matrix(e)
    return subtract(x, apply(R, body.center)), subtract(v, apply(R, cross(w, body.center)))


def of_release(body: Body, release: Release) -> tuple[Array, Array]:
    """Return qpos, (7,), and qvel, (6,), of a release.

    Args:
        body: the coin.
        release: position and velocity of C, attitude, angular velocity.
    """
    e, w = release.attitude, release.angular_velocity
    x_B, v_B = of_mass_center(body, release.position, release.velocity, e, w)
    return np.array([*x_B, *e]), np.array([*v_B, *w])


@compiled
def put_at(coin: MujocoCoin, y: Array) -> None:
    """Put MuJoCo's coin into a state, as new: nothing is left of what MuJoCo kept of an earlier toss.

    Args:
        coin: MuJoCo's.
        y: position and velocity of C (space), Euler parameters and angular velocity (body), (13,).
    """
    mj_reset(coin.address.model, coin.address.data)
    x, v = (y[0], y[1], y[2]), (y[3], y[4], y[5])
    e, w = (y[6], y[7], y[8], y[9]), (y[10], y[11], y[12])
    x_B, v_B = of_mass_center(coin.body, x, v, e, w)
    set_motion(coin, x_B + e + v_B + w)


@compiled
def set_motion(coin: MujocoCoin, motion: Array | Motion) -> None:
    """Put MuJoCo's coin into a state: qpos and qvel, (13,)."""
    for i in range(7):
        coin.joint.qpos[i] = motion[i]
    for i in range(6):
        coin.joint.qvel[i] = motion[7 + i]


@compiled
def motion_of(coin: MujocoCoin) -> Motion:
    """Return qpos and qvel, a tuple of 13."""
    q, v = coin.joint.qpos, coin.joint.qvel
    return q[0], q[1], q[2], q[3], q[4], q[5], q[6], v[0], v[1], v[2], v[3], v[4], v[5]


@compiled
def state_of(coin: MujocoCoin) -> State:
    """Return the present `State`."""
    return to_mass_center(coin.body, coin.joint.qpos, coin.joint.qvel)


@compiled
def momentum_of(coin: MujocoCoin) -> Vector:
    """Return the momentum, space frame, (3,) [N s]."""
    return scale(coin.body.mass, state_of(coin).velocity)
