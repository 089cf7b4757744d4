"""A step in which the floor holds the coin's lowest point, as in a sustained contact.

MuJoCo's contact prescribes the acceleration of the contact point, J q̈ = -k x - d ẋ, and leaves out J̇ q̇, by
which that point, on its way round the rim, leaves the floor: x would become J̇ q̇/k, and the coin gain and
lose energy by it. So the reference acceleration gets that term, in every stage: x'' = -k x - d ẋ. Once x has
died away the point is held, however soft the spring, and a soft one allows large steps.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.coin_mj.model.addresses import address_at, integer_at, numbers_at
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.coin_mj.model.state import motion_of, set_motion
from cointoss.coin_mj.steps.free_step import place_body
from cointoss.coin_mj.steps.mujoco_step import euler_step
from cointoss.coin_mj.steps.runge_kutta import CLASSICAL, TSITOURAS, end_motion, stage_motion, write_rate
from cointoss.coin_mj.steps.smooth_forces import write_smooth_forces
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, cross, scale

# MuJoCo caps its impedance at 0.9999; with R smaller and D larger by this, it is 1 - 1e-8.
_HARDER = 1e4
# A reference acceleration that makes a row push nothing [m/s²].
_FREE = -1e9
# The cosine of the angle round the rim within which a point is the lowest.
_LOWEST = 0.999999
# Below this sine of the tilt the rim turns too fast for its point to be followed.
_FACE = 1e-7


class Constraint(NamedTuple):
    """How the floor holds the coin in a sustained contact."""

    frequency: float
    """Half the damping of the spring [1/s]; 0 in an impact, which has a spring of its own."""
    lift: float
    """The spring's stiffness over `frequency` [1/s]: as large where critically damped, else smaller."""
    level: float
    """Height above the lowest point up to which others, that land slowly, are held too [m]."""
    rim: float
    """The sign of ζ of the rim that is held; 0 for both."""
    feels_air: bool
    """Whether each stage finds the force of air with b > 0 anew; it is what it was last otherwise."""


TOUCH = Constraint(0.0, 0.0, 0.0, 0.0, True)
"""The touch of an impact: the contact's own spring acts alone."""
IMPACT = Constraint(0.0, 0.0, 0.0, 0.0, False)
"""An impact after its touch: the air, a quadrature of a millisecond, hardly changes its impulse meanwhile."""


@compiled
def constrained_forward(coin: MujocoCoin, constraint: Constraint) -> float:
    """Return the floor's force along z [N], with all accelerations of the constrained state computed.

    Args:
        coin: MuJoCo's, with a margin.
        constraint: how the floor holds it.
    """
    place_body(coin, False)
    return _constrained_force(coin, constraint)


@compiled
def _constrained_force(coin: MujocoCoin, constraint: Constraint) -> float:
    run(coin, coin.mujoco.mj_collision)
    run(coin, coin.mujoco.mj_makeConstraint)
    run(coin, coin.mujoco.mj_projectConstraint)
    run(coin, coin.mujoco.mj_referenceConstraint)
    if constraint.frequency > 0:
        _set_rows(coin, constraint)
    write_smooth_forces(coin, constraint.feels_air)
    run(coin, coin.mujoco.mj_fwdAcceleration)
    run(coin, coin.mujoco.mj_fwdConstraint)
    return joint_of(coin).qfrc_constraint[2]


@compiled
def forward(coin: MujocoCoin) -> float:
    """Return the floor's force along z at a touch [N], with all accelerations of the state computed."""
    return constrained_forward(coin, TOUCH)


@compiled
def contact_step(coin: MujocoCoin, constraint: Constraint, dt: float) -> None:
    """Advance by dt [s], after `constrained_forward`: a one-step impact by Euler's method."""
    if coin.has_one_step and constraint.frequency == 0:
        euler_step(coin, dt)
    else:
        constrained_step(coin, constraint, dt)


@compiled
def constrained_step(coin: MujocoCoin, constraint: Constraint, dt: float) -> None:
    """Advance by dt [s], after `constrained_forward`; see there for the arguments."""
    # A spring is resolved in time by few steps; what limits those of a sustained contact is the constraint.
    weights = CLASSICAL if constraint.frequency > 0 else TSITOURAS
    stages = len(weights) - 1
    start, rates, motion = motion_of(coin), np.empty((stages, 13)), np.empty(13)
    write_rate(motion_of(coin), joint_of(coin).qacc, rates[0])
    for stage in range(1, stages):
        stage_motion(start, rates, weights, stage, dt, motion)
        set_motion(coin, motion)
        place_body(coin, True)
        _constrained_force(coin, constraint)
        write_rate(motion_of(coin), joint_of(coin).qacc, rates[stage])
    set_motion(coin, end_motion(start, rates, weights, dt, motion))


@compiled
def _set_rows(coin: MujocoCoin, constraint: Constraint) -> None:
    """Let MuJoCo's rows of normal forces hold the lowest points, and all below the floor, and no others.

    Of these they hold those of the constraint's rim alone.
    """
    n, frequency = integer_at(coin.address.nefc), constraint.frequency
    if n == 0:
        return
    J, position, D, R, reference = _row_arrays(coin, n)
    up = rotation_matrix(joint_of(coin).qpos[3:])[2]
    lowest = np.inf
    for i in range(n):
        if J[i, 2] > 1 - 1e-9 and constraint.rim * _point_of(coin, up, J[i])[2] >= 0:
            lowest = min(lowest, position[i])
    for i in range(n):
        D[i], R[i] = D[i] * _HARDER, R[i] / _HARDER
        if J[i, 2] <= 1 - 1e-9:
            continue
        point = _point_of(coin, up, J[i])
        if position[i] > max(lowest, 0.0) + constraint.level or constraint.rim * point[2] < 0:
            reference[i] = _FREE
            continue
        speed = 0.0
        for j in range(6):
            speed += J[i, j] * joint_of(coin).qvel[j]
        spring = frequency * (constraint.lift * position[i] + 2 * speed)
        reference[i] = -spring - _rising(coin, up, point)


@compiled
def _row_arrays(coin: MujocoCoin, n: int) -> tuple[Array, Array, Array, Array, Array]:
    """Return J, (n, 6), position, D, R and reference acceleration of MuJoCo's rows, (n,)."""
    at = coin.address
    return (
        numbers_at(address_at(at.efc_J), (n, 6)),
        numbers_at(address_at(at.efc_pos), (n,)),
        numbers_at(address_at(at.efc_D), (n,)),
        numbers_at(address_at(at.efc_R), (n,)),
        numbers_at(address_at(at.efc_aref), (n,)),
    )


@compiled
def _point_of(coin: MujocoCoin, up: Vector, J: Array) -> Vector:
    """Return the point p of a row from B, body frame, (3,) [m].

    J tells the point by p × u: p = u × (p × u) + (p · u) u, where p · u is the point's height below B.

    Args:
        coin: MuJoCo's.
        up: u, the upward unit vector in the body frame, (3,).
        J: the row, (6,).
    """
    below = coin.floor_height - joint_of(coin).qpos[2]
    return add(cross(up, (J[3], J[4], J[5])), scale(below, up))


@compiled
def _rising(coin: MujocoCoin, up: Vector, p: Vector) -> float:
    """Return J̇ q̇ of a row of the rim's lowest point, its rise but for q̈ [m/s²]; 0 of any other row.

    The lowest point of the rim at ζ = ±h/2 is z_B ± (h/2) u_ζ - r |u⊥| high, u' = u × ω.

    Args:
        coin: MuJoCo's.
        up: u, the upward unit vector in the body frame, (3,).
        p: the row's point, see `_point_of`.
    """
    v = joint_of(coin).qvel
    w = v[3], v[4], v[5]
    sine = math.hypot(up[0], up[1])
    if sine < _FACE:
        return 0.0
    if -(p[0] * up[0] + p[1] * up[1]) < _LOWEST * sine * math.hypot(p[0], p[1]):
        return 0.0
    half = math.copysign(coin.shape.thickness / 2, p[2])
    rate = cross(up, w)
    turning = cross(rate, w)
    sine_rate = (up[0] * rate[0] + up[1] * rate[1]) / sine
    round_rim = rate[0] * rate[0] + rate[1] * rate[1] - sine_rate * sine_rate
    return half * turning[2] - coin.body.radius * (up[0] * turning[0] + up[1] * turning[1] + round_rim) / sine
