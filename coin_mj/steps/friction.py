"""Coulomb's force, and moments of resistance, on a frictionless MuJoCo contact.

Both follow from the normal force that MuJoCo measures.
"""

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.state import Motion, momentum_of, motion_of, set_motion
from cointoss.coin_mj.steps.constrained_step import Constraint, constrained_forward, contact_step
from cointoss.coin_mj.steps.coulomb import coulomb_force
from cointoss.coin_mj.steps.mujoco_step import other_force
from cointoss.coin_mj.steps.resistance import Coefficients, contour_arm, resisted_force
from cointoss.models.attitude import rotation_matrix
from cointoss.models.contour import leaning
from cointoss.models.kernel.address import call_c
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, add, apply, apply_transposed, cross, scale


@compiled
def step_on_floor(coin: MujocoCoin, constraint: Constraint, dt: float, has_friction: bool) -> None:
    """Advance by dt [s] from a state whose forces are known; with friction by `apply_friction`, if any."""
    if has_friction:
        apply_friction(coin, constraint, dt)
    contact_step(coin, constraint, dt)
    joint_of(coin).qfrc_applied[:] = 0


@compiled
def apply_friction(coin: MujocoCoin, constraint: Constraint, dt: float) -> None:
    """Apply Coulomb's force to a coin in a frictionless contact, for a step of dt [s].

    In a sustained contact the moments of the floor's resistance to rolling and pivoting come with it. The
    step is made without either, to measure the normal force, and taken back. The friction acts midway
    between the contact points at the start and at the end of the step.

    Args:
        coin: MuJoCo's, on the floor, after `constrained_forward`.
        constraint: how the floor holds it then.
        dt: length of the step [s].
    """
    start, momentum, other = motion_of(coin), momentum_of(coin)[2], other_force(coin)[2]
    R, point = rotation_matrix(start[3:7]), contact_point(coin)
    resists = coin.resists and constraint.frequency > 0
    K = delassus(coin, R, point, 6 if resists else 3)
    contact_step(coin, constraint, dt)
    normal = max((momentum_of(coin)[2] - momentum) / dt - other, 0.0)
    end = motion_of(coin)
    R_end, point_end = rotation_matrix(end[3:7]), point
    if constrained_forward(coin, constraint) > 0:
        point_end = contact_point(coin)
    slip, slip_free = _velocity(start, R, point), _velocity(end, R_end, point_end)
    # What the friction takes from the normal force goes with it: MuJoCo, which lets the share 1 - solimp of
    # any other push through its contact, has nothing left to do.
    if resists:
        motion, motion_free = slip + apply(R, start[10:13]), slip_free + apply(R_end, end[10:13])
        arm = contour_arm(coin, R[2], start[10:13], normal)
        coefficients = Coefficients(coin.friction, coin.rolling_friction, coin.pivoting_friction, arm)
        leans = (apply(R, leaning(R[2])), apply(R_end, leaning(R_end[2])))
        F, M = resisted_force(K, coefficients, normal, motion, motion_free, leans, dt)
    else:
        x, y = coulomb_force(K, coin.friction, normal, slip[:2], slip_free[:2], dt)
        F, M = (x, y, -(K[0, 2] * x + K[1, 2] * y) / K[2, 2]), (0.0, 0.0, 0.0)
    at_start = apply_transposed(R, add(cross(point, F), M))
    at_end = apply_transposed(R_end, add(cross(point_end, F), M))
    copy_into(joint_of(coin).qfrc_applied, F + scale(0.5, add(at_start, at_end)))
    set_motion(coin, start)
    constrained_forward(coin, constraint)


@compiled
def contact_point(coin: MujocoCoin) -> Vector:
    """Return the centre of the floor's pressure from B, space frame, (3,) [m].

    It follows from the moment of the normal forces about B, after `constrained_forward`.
    """
    f, qpos = joint_of(coin).qfrc_constraint, joint_of(coin).qpos
    moment = apply(rotation_matrix(qpos[3:]), (f[3], f[4], f[5]))
    return -moment[1] / f[2], moment[0] / f[2], coin.floor_height - qpos[2]


@compiled
def _velocity(motion: Motion, R: Matrix, point: Vector) -> Vector:
    """Return the velocity of the coin's point that is at `point` from B, space frame, (3,) [m/s]."""
    return add(motion[7:10], cross(apply(R, motion[10:13]), point))


@compiled
def delassus(coin: MujocoCoin, R: Matrix, point: Vector, n: int) -> Array:
    """Return K, the change of the velocity of the coin's point at `point` from B by an impulse there.

    Args:
        coin: MuJoCo's, after `constrained_forward`.
        R: rotation matrix, body to space.
        point: space frame, (3,) [m].
        n: 3; or 6, where the angular velocity and an angular impulse come after the other three.

    Returns:
        K: space frame, (n, n) [1/kg].
    """
    jacobian, gained = np.zeros((n, 6)), np.empty((n, 6))
    for i in range(n):
        k = i % 3
        unit = (1.0 if k == 0 else 0.0, 1.0 if k == 1 else 0.0, 1.0 if k == 2 else 0.0)
        turning = apply_transposed(R, cross(point, unit) if i < 3 else unit)
        if i < 3:
            jacobian[i, i] = 1.0
        for j in range(3):
            jacobian[i, 3 + j] = turning[j]
    at = coin.address
    call_c(
        coin.mujoco.mj_solveM,
        (at.model, at.data, gained.ctypes.data, jacobian.ctypes.data, np.int32(n)),
    )
    K = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            for k in range(6):
                K[i, j] += jacobian[i, k] * gained[j, k]
    return K
