"""MuJoCo's coin put into a state, and its state read."""

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.models.body import Body
from cointoss.models.free_joint import of_mass_center, to_mass_center
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, scale
from cointoss.models.parts import Release
from cointoss.models.records import Array
from cointoss.models.state import State

Motion = tuple[float, float, float, float, float, float, float, float, float, float, float, float, float]
"""qpos and qvel of the free joint."""


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
    run(coin, coin.mujoco.mj_resetData)
    x, v = (y[0], y[1], y[2]), (y[3], y[4], y[5])
    e, w = (y[6], y[7], y[8], y[9]), (y[10], y[11], y[12])
    x_B, v_B = of_mass_center(coin.body, x, v, e, w)
    set_motion(coin, x_B + e + v_B + w)


@compiled
def set_motion(coin: MujocoCoin, motion: Array | Motion) -> None:
    """Put MuJoCo's coin into a state: qpos and qvel, (13,)."""
    copy_into(joint_of(coin).qpos, motion[:7])
    copy_into(joint_of(coin).qvel, motion[7:])


@compiled
def motion_of(coin: MujocoCoin) -> Motion:
    """Return qpos and qvel, a tuple of 13."""
    q, v = joint_of(coin).qpos, joint_of(coin).qvel
    return q[0], q[1], q[2], q[3], q[4], q[5], q[6], v[0], v[1], v[2], v[3], v[4], v[5]


@compiled
def state_of(coin: MujocoCoin) -> State:
    """Return the present `State`."""
    return to_mass_center(coin.body, joint_of(coin).qpos, joint_of(coin).qvel)


@compiled
def momentum_of(coin: MujocoCoin) -> Vector:
    """Return the momentum, space frame, (3,) [N s]."""
    return scale(coin.body.mass, state_of(coin).velocity)
