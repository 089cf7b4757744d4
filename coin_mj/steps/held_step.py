"""A step of a sustained contact: how long it is, and how the floor holds MuJoCo's coin in it."""

import math

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.state import motion_of, set_motion, state_of
from cointoss.coin_mj.steps.constrained_step import Constraint, constrained_forward
from cointoss.coin_mj.steps.friction import apply_friction, step_on_floor
from cointoss.coin_mj.steps.gap_evaluation import evaluate_gap, turning_rate
from cointoss.coin_mj.steps.mujoco_step import set_margin, set_spring
from cointoss.models.body import Rules
from cointoss.models.geometry import lower_rim
from cointoss.models.inertia import largest_across
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, cross
from cointoss.models.restitution import chatter_restitution

HEAVY = 10
"""A touch is no impact when gravity alone gives its speed in HEAVY times the duration of a contact."""
ANGLE = 0.12
"""Largest turn of the coin, and of its lowest point round the rim, in a step [rad]."""
SOFTNESS = 0.5
"""√k times the step: RK4 follows a critically damped spring up to twice as much."""
RISE = 1e-2
"""The spring of a short step, with the damping of a stiff one, is no stiffer than that of the longest step
where it would lift a point that sank faster than this part of √(g r): that would give the coin energy."""
LEVEL = 0.3
"""A point is held from this part of the way on that the slowest landing makes in a step."""
REACH = 0.1
"""Height up to which MuJoCo keeps the row of a held point, in radii; the stages of a step leave the floor."""
NEAR = 1e-5
"""A rim point lands when the sine of the coin's angle to its edge, or to its face, is down to this."""
PAST = 3e-5
"""Part of a step that a step goes beyond the landing of the other rim."""
FACE = 1e-7
"""Below this sine of the tilt the rim turns under the coin too fast to follow."""
DEEPEST = 4e-4
"""Depth in the floor to which a step may lower the lowest point, in radii."""
HALVINGS = 30
"""Most times that a step is halved."""
APPROACH = 0.99
"""Part of the time to a landing that a step goes."""
STANDS = 0.3
"""A coin stands on both rims if either would land within this part of a longest step."""


@compiled
def slow_speed(coin: MujocoCoin, chi: float, w: Vector) -> float:
    """Return the speed of a touch below which the coin stays in contact [m/s].

    All its bounces to come would fall within one step of that contact, or weight would drive its impact.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    g = coin.body.gravity
    bounces = ANGLE / turning_rate(coin.body, w) * g * (1 - chi) / 2
    return max(HEAVY * g * coin.rebound.duration, bounces)


@compiled
def contact_restitution(coin: MujocoCoin, rules: Rules) -> float:
    """Return χ by which the touches of a sustained contact are told from impacts, see `slow_speed`.

    Where the restitution varies with the speed, it is that at the least `slow_speed`.
    """
    return chatter_restitution(rules, HEAVY * coin.body.gravity * coin.rebound.duration)


@compiled
def shallow_step(coin: MujocoCoin, chi: float, w: Vector, dt: float) -> tuple[float, float, bool]:
    """Advance a coin in sustained contact by dt [s], or by less where it would sink, or the other rim lands.

    The lowest point sinks no deeper than `DEEPEST`, unless it is as deep already, and no point is in the
    floor that moves down faster than `slow_speed`, unless one does already. A coin on one rim goes no further
    than onto its edge, where the other rim lands.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        w: angular velocity, body frame, (3,) [rad/s].
        dt: the longest step [s].

    Returns:
        The floor's force as of `sustained_step`, the length of the step [s], and whether the other rim lands.
    """
    start, before, rim = motion_of(coin), evaluate_gap(coin), held_rim(coin, w)
    lean, lean_rate = _lean(coin, rim)
    lowest = min(before.gap, -DEEPEST * coin.body.radius)
    fastest = min(before.speed, -slow_speed(coin, chi, w))
    force = sustained_step(coin, chi, w, dt)
    for _ in range(HALVINGS):
        now, (beyond, beyond_rate) = evaluate_gap(coin), _lean(coin, rim)
        if beyond > NEAR:
            part = _zero_of_cubic(lean, lean_rate * dt, beyond, beyond_rate * dt) + PAST
        elif now.gap < lowest or (beyond <= 0 and now.gap < 0 and now.speed < fastest):
            part = 0.5
        else:
            return force, dt, beyond > 0
        set_motion(coin, start)
        dt *= part
        force = sustained_step(coin, chi, w, dt)
    return force, dt, False


@compiled
def _lean(coin: MujocoCoin, rim: float) -> tuple[float, float]:
    """Return how far a coin on one rim is beyond its edge, by ±n_z, and its rate [1/s]; 0 for a rim of 0."""
    up, w = state_of(coin).R[2], state_of(coin).spin
    return rim * up[2], rim * cross(up, w)[2]


@compiled
def _zero_of_cubic(start: float, start_rate: float, end: float, end_rate: float) -> float:
    """Return where in 0 to 1 Hermite's cubic between two ends with opposite signs is zero."""
    rise, low, high = end - start, 0.0, 1.0
    for _ in range(HALVINGS):
        s = (low + high) / 2
        bend = (1 - s) * (start_rate - rise) - s * (end_rate - rise)
        low, high = (s, high) if start + s * rise + s * (1 - s) * bend < 0 else (low, s)
    return high


@compiled
def held_rim(coin: MujocoCoin, w: Vector) -> float:
    """Return the rim that the floor holds, as the sign of its ζ, or 0 for both.

    A coin of some thickness is held at its lower rim, unless it stands on both.

    Args:
        coin: MuJoCo's.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    if coin.body.thickness == 0:
        return 0.0
    up = state_of(coin).R[2]
    if half_period(coin, up, w) < STANDS:
        return 0.0
    return lower_rim(up[2] if up[2] != 0 else cross(up, w)[2])


@compiled
def half_period(coin: MujocoCoin, up: Vector, w: Vector) -> float:
    """Return how long the coin rocks on one rim until the other lands, by its weight, in longest steps.

    Args:
        coin: MuJoCo's.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    body, half, rate = coin.body, coin.body.thickness / 2, cross(up, w)[2]
    restoring = body.gravity * half / (largest_across(body.inertia) / body.mass + half * half)
    fastest = math.sqrt(rate * rate + 2 * restoring * abs(up[2]))
    return 2 * fastest / restoring * turning_rate(body, w) / ANGLE


@compiled
def sustained_step(coin: MujocoCoin, chi: float, w: Vector, dt: float) -> float:
    """Advance a coin in sustained contact by dt [s]; see `constrain` for the arguments.

    Returns:
        The floor's force along z at the start, without friction and resistance [N].
    """
    constraint = constrain(coin, chi, w, dt)
    force = constrained_forward(coin, constraint)
    step_on_floor(coin, constraint, dt, force > 0 and (coin.has_explicit_friction or coin.resists))
    return force


@compiled
def frequency_of(dt: float) -> float:
    """Return √k of the spring in a step of dt [s] [1/s]."""
    return SOFTNESS / dt


@compiled
def constrain(coin: MujocoCoin, chi: float, w: Vector, dt: float) -> Constraint:
    """Return the `Constraint` of a step, with MuJoCo's contact set for it.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        w: angular velocity, body frame, (3,) [rad/s].
        dt: length of the step [s].
    """
    body = coin.body
    set_margin(coin, REACH * body.radius)
    set_spring(coin, 0.0, 0.0, (body.gravity / body.radius) ** 0.5)
    frequency, sunk = frequency_of(dt), -evaluate_gap(coin).gap
    lift = frequency
    if sunk > 0:
        gentle = RISE * (body.gravity * body.radius) ** 0.5 / sunk
        lift = min(frequency, max(gentle, frequency_of(ANGLE / turning_rate(body, w))))
    return Constraint(frequency, lift, LEVEL * slow_speed(coin, chi, w) * dt, held_rim(coin, w), True)


@compiled
def floor_force(coin: MujocoCoin, chi: float, dt: float) -> Vector:
    """Return the floor's force at the start of a step of a sustained contact, space frame, (3,) [N].

    It is MuJoCo's own constraint force, and what `apply_friction` gives.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        dt: length of the step [s].
    """
    constraint = constrain(coin, chi, state_of(coin).spin, dt)
    if constrained_forward(coin, constraint) > 0 and (coin.has_explicit_friction or coin.resists):
        apply_friction(coin, constraint, dt)
    f, g = joint_of(coin).qfrc_constraint, joint_of(coin).qfrc_applied
    force = f[0] + g[0], f[1] + g[1], f[2] + g[2]
    joint_of(coin).qfrc_applied[:] = 0
    return force


@compiled
def next_step(
    coin: MujocoCoin, chi: float, up: Vector, up_rate: Vector, w: Vector, sunk: float
) -> tuple[float, bool]:
    """Return the length of the next step of a sustained contact.

    In it the coin, and the lowest point on its way round the rim, turn by less than `ANGLE`. It ends
    before the opposite rim point of a face lands faster than `slow_speed`.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        up: the upward unit vector in the body frame, (3,).
        up_rate: its rate of change [1/s].
        w: angular velocity, body frame, (3,) [rad/s].
        sunk: how deep its lowest point is in the floor [m].

    Returns:
        The length [s], and whether that point lands in it.
    """
    body, slow = coin.body, slow_speed(coin, chi, w)
    sine = math.hypot(up[0], up[1])
    rate = turning_rate(body, w)
    if sine > FACE:
        # A face that sank as a whole rises by the spring, not by a turn of the coin: shorter steps, which
        # have stiffer springs, would lift it the faster.
        lies = sunk > body.radius * sine
        around = abs(up[0] * up_rate[1] - up[1] * up_rate[0]) / (sine * sine)
        rate = max(rate, around if lies else math.hypot(up_rate[0], up_rate[1]) / sine)
    dt, lands = ANGLE / rate, False
    sine_rate = (up[0] * up_rate[0] + up[1] * up_rate[1]) / sine if sine > 0 else 0.0
    if -sine_rate * 2 * body.radius > slow:
        dt, lands = min(dt, APPROACH * sine / -sine_rate), sine < NEAR
    return dt, lands
