"""A sustained contact of MuJoCo's coin, which rolls, slides and spins on the floor."""

import math
from enum import IntEnum

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.state import motion_of, set_motion, state_of
from cointoss.coin_mj.steps.constrained_step import (
    IMPACT,
    Constraint,
    constrained_forward,
    contact_step,
    forward,
)
from cointoss.coin_mj.steps.free_step import free_step
from cointoss.coin_mj.steps.friction import apply_friction, friction_step
from cointoss.coin_mj.steps.gap_evaluation import evaluate_gap, turning_rate
from cointoss.coin_mj.steps.knots import RecordedPath, StepKind, add_knot
from cointoss.coin_mj.steps.mujoco_step import set_margin, set_spring
from cointoss.coin_mj.steps.resistance import shortest_stop
from cointoss.models.body import Body, Rules, friction_can_hold, slope_feeds
from cointoss.models.ending import classify_ending, out_of_steps
from cointoss.models.geometry import lower_rim, lowest_point
from cointoss.models.inertia import largest_across
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, apply, cross, dot, norm, subtract
from cointoss.models.perpetual import FIRST_CHECK, EnergyHistory
from cointoss.models.records import Ending, Outcome
from cointoss.models.rest import holding_arm, is_held, is_slowing
from cointoss.models.restitution import chatter_restitution
from cointoss.models.state import State

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
ROCKS = 2
"""A coin rocks on its edge after more landings between which n_z changes no faster than `GROWTH` times as
fast as after them: its weight brings it back from either rim."""
GROWTH = 1.1
STANDS = 0.3
"""A coin stands on both rims if either would land within this part of a longest step."""
UPRIGHT = 1e-4
"""A sine of the angle off the edge, its change in a step against √(g/r), in which a coin is on both rims."""
NO_LOSS = 8e-5
"""A loss in the time √(r/g) that is none, against the energy: the steps alone change it by up to 4e-5."""


NOT_DECIDED = -1.0
"""In place of the speed of a coin at rest, while its toss is not decided."""


class ContactExit(IntEnum):
    """How a sustained contact ended."""

    DECIDED = 0
    """The toss is decided."""
    LIFT_OFF = 1
    RIM_LANDS = 2
    """Another rim point touches: of the other face's rim, or opposite on this one."""


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
def follow_contact(
    coin: MujocoCoin,
    plastic: MujocoCoin,
    rules: Rules,
    time: float,
    steps_left: int,
    history: EnergyHistory,
    path: RecordedPath,
    still: float,
) -> tuple[ContactExit, float, int, Outcome, Ending, RecordedPath]:
    """Follow a sustained contact until the coin lifts off, another rim point lands, or the toss is decided.

    A slow landing of the other rim is a plastic impact, after which the contact goes on.

    Args:
        coin: MuJoCo's.
        plastic: the same, for plastic impacts.
        rules: floor and ending.
        time: now [s].
        steps_left: the most steps wanted.
        history: `EnergyHistory` of the toss; kept up.
        path: of the toss so far.
        still: of a toss that is decided, the speed at which the coin is at rest [m/s]; `NOT_DECIDED` before.

    Returns:
        `ContactExit`, the time [s], the steps left, the outcome, the ending, and the path.
    """
    body = coin.body
    rate, chi = (body.gravity / body.radius) ** 0.5, contact_restitution(coin, rules)
    landings, landing_rate = 0, math.inf
    unloaded, upright, may_speed_up = 0.0, 0.0, slope_feeds(body, coin.friction == 0)
    while time < rules.max_time:
        x, v, e, w, R = state_of(coin)
        up = R[2]
        up_rate = cross(up, w)
        landings = landings if abs(up_rate[2]) < GROWTH * landing_rate else 0
        # Where the coin would be if it did not sink: the energy tests are finer than that.
        sunk = -min(evaluate_gap(coin).gap, 0.0)
        z = x[2] + sunk
        now = State((x[0], x[1], z), v, e, w, R)
        if still == NOT_DECIDED:
            outcome, ending = classify_ending(body, rules, now, time, history)
            stands = upright * rate > FIRST_CHECK and not (may_speed_up or slows(coin, R, w))
            if ending == Ending.NONE and stands:
                outcome, ending = Outcome.EDGE, Ending.STANDING
            if ending == Ending.NONE and rests(coin, now, upright > 0):
                outcome, ending = Outcome.EDGE, Ending.AT_REST
            if ending == Ending.NONE and steps_left <= 0:
                outcome, ending = out_of_budget(coin, upright > 0, *out_of_steps(body, rules, now, history))
        elif friction_can_hold(body, coin.friction) and max(norm(v), body.radius * norm(w)) < still:
            outcome, ending = Outcome.UNDECIDED, Ending.AT_REST
        else:
            outcome, ending = Outcome.UNDECIDED, Ending.CONTACT_STEPS if steps_left <= 0 else Ending.NONE
        if ending != Ending.NONE:
            return ContactExit.DECIDED, time, steps_left, outcome, ending, path
        dt, face_lands = next_step(coin, chi, up, up_rate, w, sunk)
        if face_lands:
            _pass_over(coin, dt)
            return ContactExit.RIM_LANDS, time + dt, steps_left, Outcome.UNDECIDED, Ending.NONE, path
        dt = min(dt, shortest_stop(coin, up, w), rules.max_time - time)
        path = add_knot(coin, time, StepKind.CONTACT, path)
        force, dt, rim_lands = shallow_step(coin, chi, w, dt)
        time += dt
        steps_left -= 1
        if rim_lands and evaluate_gap(coin).speed < 0:
            is_fast = -evaluate_gap(coin).speed > slow_speed(coin, chi, w)
            if is_fast and half_period(coin, state_of(coin).R[2], state_of(coin).spin) > 1:
                joint_of(coin).qpos[2] -= evaluate_gap(coin).gap
                return ContactExit.RIM_LANDS, time, steps_left, Outcome.UNDECIDED, Ending.NONE, path
            path = add_knot(coin, time, StepKind.LANDING, path)
            landing_rate = _land(plastic)
            time += plastic.rebound.step
            steps_left -= 1
            landings += 1
        leans = state_of(coin).R[2][2] - up[2]
        on_edge = body.thickness > 0 and abs(up[2]) < UPRIGHT and abs(leans) < UPRIGHT * rate * dt
        on_edge = on_edge or (landings > ROCKS and weight_rights(body, up, w))
        upright = upright + dt if on_edge and force > 0 else 0.0
        unloaded = unloaded + dt if force == 0 else 0.0
        # Half a period of the spring.
        if unloaded * frequency_of(dt) > math.pi:
            return ContactExit.LIFT_OFF, time, steps_left, Outcome.UNDECIDED, Ending.NONE, path
    outcome, ending = out_of_budget(coin, upright > 0, Outcome.UNDECIDED, Ending.MAX_TIME)
    return ContactExit.DECIDED, time, steps_left, outcome, ending, path


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
def weight_rights(body: Body, up: Vector, w: Vector) -> bool:
    """Return whether weight rights a coin on either rim, however all of its turning goes into its roll.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    rolling = body.inertia[2][2] + body.mass * body.radius * body.radius
    return rolling * norm(w) * abs(dot(up, w)) < body.mass * body.gravity * body.thickness / 2


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
def _land(plastic: MujocoCoin) -> float:
    """Let the floor stop the approach of the other rim, in one step of the coin for plastic impacts.

    The rocking stops if more landings would follow within the next step.

    Returns:
        The rate of n_z that is left [1/s].
    """
    set_margin(plastic, max(evaluate_gap(plastic).gap, 0.0) + NEAR * plastic.body.thickness)
    set_spring(plastic, 0.0, plastic.rebound.damping, plastic.rebound.slip_damping)
    if forward(plastic) > 0 and plastic.has_explicit_friction:
        friction_step(plastic, IMPACT, plastic.rebound.step)
    else:
        contact_step(plastic, IMPACT, plastic.rebound.step)
    up, w, qvel = state_of(plastic).R[2], state_of(plastic).spin, joint_of(plastic).qvel
    rate = cross(up, w)[2]
    if half_period(plastic, up, w) >= 1:
        return abs(rate)
    turning = rate / (up[0] * up[0] + up[1] * up[1])
    qvel[2], qvel[3], qvel[4] = 0.0, w[0] + up[1] * turning, w[1] - up[0] * turning
    return 0.0


@compiled
def sustained_step(coin: MujocoCoin, chi: float, w: Vector, dt: float) -> float:
    """Advance a coin in sustained contact by dt [s]; see `constrain` for the arguments.

    Returns:
        The floor's force along z at the start, without friction and resistance [N].
    """
    constraint = constrain(coin, chi, w, dt)
    force = constrained_forward(coin, constraint)
    if force > 0 and (coin.has_explicit_friction or coin.resists):
        friction_step(coin, constraint, dt)
    else:
        contact_step(coin, constraint, dt)
    return force


@compiled
def frequency_of(dt: float) -> float:
    """Return √k of the spring in a step of dt [s] [1/s]."""
    return SOFTNESS / dt


@compiled
def slows(coin: MujocoCoin, R: Matrix, w: Vector) -> bool:
    """Return whether the floor's resistance slows a coin that stands; see `is_slowing`."""
    rolling = coin.rolling_friction + coin.contour.friction
    return is_slowing(coin.body, rolling, coin.pivoting_friction, apply(R, w))


@compiled
def rests(coin: MujocoCoin, state: State, upright: bool) -> bool:
    """Return whether resistance to rolling holds the coin where it is; see `cointoss.models.rest.is_held`.

    Args:
        coin: MuJoCo's.
        state: its own.
        upright: whether it is on both rims.
    """
    rolling = holding_arm(coin.rolling_friction, coin.contour.friction, upright)
    if not rolling > 0:
        return False
    point, _ = lowest_point(coin.body, state.R[2], state.spin)
    arm = apply(state.R, subtract(point, coin.body.center))
    return is_held(coin.body, rolling, coin.friction, state, arm, upright)


@compiled
def out_of_budget(
    coin: MujocoCoin, upright: bool, outcome: Outcome, ending: Ending
) -> tuple[Outcome, Ending]:
    """Return the outcome and ending of a toss that ends in contact as a budget is spent.

    Args:
        coin: MuJoCo's.
        upright: whether it is on both rims.
        outcome: that of a coin which does not roll on its edge.
        ending: that of such a coin.
    """
    if upright and (coin.resists or slope_feeds(coin.body, coin.friction == 0)):
        return Outcome.EDGE, Ending.ROLLING
    return outcome, ending


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


@compiled
def _pass_over(coin: MujocoCoin, dt: float) -> None:
    """Let the coin pass over its face in a time dt [s], and put it on the rim point that lands."""
    free_step(coin, dt / APPROACH * (2 - APPROACH))
    joint_of(coin).qpos[2] -= evaluate_gap(coin).gap
