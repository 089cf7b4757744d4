"""One impact of MuJoCo's coin on the floor, from first touch to release."""

import math
from enum import IntEnum

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.state import Motion, momentum_of, motion_of, set_motion
from cointoss.coin_mj.steps.constrained_step import IMPACT, constrained_forward, forward
from cointoss.coin_mj.steps.flight import TOUCH_STEP
from cointoss.coin_mj.steps.friction import step_on_floor
from cointoss.coin_mj.steps.gap_evaluation import evaluate_gap
from cointoss.coin_mj.steps.knots import RecordedPath, StepKind, add_knot
from cointoss.coin_mj.steps.mujoco_step import other_force, set_margin, set_spring
from cointoss.models.attitude import Quaternion, quaternion_product, rotation_matrix
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, cross, scale, subtract

PAST = 1.0005
"""Factor on a step that should end with the contact: past the release there is no force."""
SHORT = 0.02
"""Shortest step, as a part of the longest; another point of the rim may push when the lowest is released."""
DAMPED_STEP = 1.0
"""A step of an impact is at most this part of the time in which the damping stops a point."""
SUSTAINED = 20
"""A contact of more than SUSTAINED times the duration of an impact is none."""
FLAT = 1e-8
"""A sine of the tilt that no contact can tell from flat: over the whole coin it is 1e-8 of its width."""


class TouchResult(IntEnum):
    """What a touch turned out to be."""

    MISSED = 0
    """The coin left the floor before any force acted."""
    IMPACT = 1
    SUSTAINED = 2
    """The contact outlasted `SUSTAINED` impacts, and the coin is still in it."""


@compiled
def resolve_impact(
    coin: MujocoCoin, time: float, path: RecordedPath
) -> tuple[TouchResult, float, Vector, RecordedPath]:
    """Follow a contact from the touch to the release of all rim points.

    On a coin that lands flat there is no Coulomb force: its impulse goes through C, as in the paper's
    mechanics. MuJoCo's plane-cylinder routine finds the lowest rim point from the tilt, and where that is
    nothing but rounding it takes the radius for the height. So a coin flat within `FLAT` is turned about the
    vertical, until its axes are MuJoCo's and the tilt exactly nothing, and back after its contact. The floor
    and the cylinder are round: neither this turn nor the spin about ζ changes the contact. One that turns out
    of `FLAT` in its contact lands on the rim point that goes down.

    Args:
        coin: MuJoCo's.
        time: of the touch [s].
        path: of the toss so far.

    Returns:
        `TouchResult`; time of the release [s]; integral of the floor's force, space frame, (3,) [N s];
        the path.
    """
    set_margin(coin, 0.0)
    set_spring(coin, coin.rebound.stiffness, coin.rebound.damping, coin.rebound.slip_damping)
    up = rotation_matrix(joint_of(coin).qpos[3:])[2]
    if math.hypot(up[0], up[1]) > FLAT or _leans(coin, up):
        return _resolve(coin, coin.has_explicit_friction, time, path)
    first = path.size
    turn, spin = _turn_level(coin, up[2])
    result, end, impulse, path = _resolve(coin, False, time, path)
    last = _turned_back(turn, spin, end - time, motion_of(coin))
    for number in range(first, path.size):
        knot = path.table[number]
        set_motion(coin, knot[2:])
        copy_into(knot[2:], _turned_back(turn, spin, knot[0] - time, motion_of(coin)))
    set_motion(coin, last)
    return result, end, apply(rotation_matrix(turn), impulse), path


@compiled
def _leans(coin: MujocoCoin, up: Vector) -> bool:
    """Let a flat coin that turns lean as it does, on the floor; return whether it turns.

    Args:
        coin: MuJoCo's.
        up: the upward unit vector in the body frame, (3,).
    """
    qpos, w = joint_of(coin).qpos, joint_of(coin).qvel
    rate = cross(up, (w[3], w[4], w[5]))
    turning = math.hypot(rate[0], rate[1])
    if turning * coin.rebound.duration <= FLAT:
        return False
    half = scale(FLAT / turning, cross(rate, up))
    e = quaternion_product((qpos[3], qpos[4], qpos[5], qpos[6]), (1.0, half[0], half[1], half[2]))
    copy_into(qpos[3:], e)
    qpos[2] -= evaluate_gap(coin).gap
    return True


@compiled
def _turn_level(coin: MujocoCoin, n_z: float) -> tuple[Quaternion, float]:
    """Turn a coin that is flat about the vertical until its axes are MuJoCo's, and stop its spin.

    Returns:
        turn: Euler parameters of the turn back, (4,).
        spin: ω_ζ, taken out [rad/s].
    """
    q, v = joint_of(coin).qpos, joint_of(coin).qvel
    e = (q[3], q[4], q[5], q[6])
    # Times the conjugate of the flat attitude: (1, 0, 0, 0), or (0, 1, 0, 0) with tails up.
    turn = e if n_z > 0 else quaternion_product(e, (0.0, -1.0, 0.0, 0.0))
    velocity = apply_transposed(rotation_matrix(turn), (v[0], v[1], v[2]))
    spin = v[5]
    copy_into(v[:3], velocity)
    copy_into(q[3:], (1.0, 0.0, 0.0, 0.0) if n_z > 0 else (0.0, 1.0, 0.0, 0.0))
    v[5] = 0.0
    return turn, spin


@compiled
def _turned_back(turn: Quaternion, spin: float, elapsed: float, motion: Motion) -> Motion:
    """Return a state turned back, with its spin and the angle that it would have spun, (13,)."""
    angle = spin * elapsed / 2
    spun = (math.cos(angle), 0.0, 0.0, math.sin(angle))
    e = quaternion_product(quaternion_product(turn, motion[3:7]), spun)
    velocity = apply(rotation_matrix(turn), motion[7:10])
    return motion[:3] + e + velocity + (motion[10], motion[11], motion[12] + spin)


@compiled
def _resolve(
    coin: MujocoCoin, has_friction: bool, time: float, path: RecordedPath
) -> tuple[TouchResult, float, Vector, RecordedPath]:
    start, momentum, other = time, momentum_of(coin), (0.0, 0.0, 0.0)
    acted, result = False, TouchResult.SUSTAINED
    while time - start <= SUSTAINED * coin.rebound.duration:
        force = forward(coin) if time == start else constrained_forward(coin, IMPACT)
        if force == 0:
            if acted:
                result = TouchResult.IMPACT
                break
            if evaluate_gap(coin).speed >= 0:
                result = TouchResult.MISSED
                break
        # Tiny steps up to the onset, so that it falls between two steps, not into one.
        dt = _step_length(coin) if force > 0 else TOUCH_STEP * coin.rebound.step
        acted = acted or force > 0
        other = add(other, scale(dt, other_force(coin)))
        path = add_knot(coin, time, StepKind.IMPACT, path)
        step_on_floor(coin, IMPACT, dt, force > 0 and has_friction)
        time += dt
        if acted and coin.has_one_step:
            joint_of(coin).qpos[2] -= min(evaluate_gap(coin).gap, 0.0)
            result = TouchResult.IMPACT
            break
    return result, time, subtract(subtract(momentum_of(coin), momentum), other), path


@compiled
def _step_length(coin: MujocoCoin) -> float:
    """Return the length of the next step of an impact [s]; the last ends as the lowest point is released."""
    rebound = coin.rebound
    if coin.has_one_step:
        return rebound.step
    longest = min(rebound.step, DAMPED_STEP / rebound.damping)
    below = evaluate_gap(coin)
    left = time_to_release(rebound.stiffness, rebound.damping, below.gap, below.speed)
    if left > SUSTAINED * rebound.duration:
        return longest
    return max(PAST * left / max(math.ceil(left / longest), 1), SHORT * longest)


@compiled
def time_to_release(stiffness: float, damping: float, x: float, speed: float) -> float:
    """Return the time until a damped spring lets go [s]: 0 where it would pull, infinite where it never does.

    The force per mass f = -k x - d x' obeys the equation of the spring, f" = -k f - d f'.

    Args:
        stiffness: k [1/s²].
        damping: d [1/s].
        x: length of the spring, negative where it is compressed [m].
        speed: x' [m/s].
    """
    force = -stiffness * x - damping * speed
    if force < 0:
        return 0.0
    decay = damping / 2
    # f = exp(-d t/2) (force cos(ω t) + slope sin(ω t)/ω), or with cosh and sinh.
    slope = -stiffness * speed - decay * force
    square = stiffness - decay * decay
    rate = abs(square) ** 0.5
    if square > 0:
        return math.atan2(force * rate, -slope) / rate
    if slope >= -force * rate:
        return math.inf
    return math.atanh(-force * rate / slope) / rate if rate > 0 else -force / slope
