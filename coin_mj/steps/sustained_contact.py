"""A sustained contact of MuJoCo's coin, which rolls, slides and spins on the floor."""

import math
from enum import IntEnum

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.state import state_of
from cointoss.coin_mj.steps.constrained_step import IMPACT, forward
from cointoss.coin_mj.steps.free_step import free_step
from cointoss.coin_mj.steps.friction import step_on_floor
from cointoss.coin_mj.steps.gap_evaluation import evaluate_gap
from cointoss.coin_mj.steps.held_step import (
    APPROACH,
    NEAR,
    contact_restitution,
    frequency_of,
    half_period,
    next_step,
    shallow_step,
    slow_speed,
)
from cointoss.coin_mj.steps.knots import RecordedPath, StepKind, add_knot
from cointoss.coin_mj.steps.mujoco_step import set_margin, set_spring
from cointoss.coin_mj.steps.resistance import shortest_stop
from cointoss.models.body import Body, Rules, friction_can_hold, slope_feeds
from cointoss.models.ending import classify_ending, out_of_steps
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, apply, cross, dot, norm, subtract
from cointoss.models.perpetual import FIRST_CHECK, EnergyHistory
from cointoss.models.records import Ending, Outcome
from cointoss.models.rest import holding_arm, is_held, is_slowing
from cointoss.models.state import State

ROCKS = 2
"""A coin rocks on its edge after more landings between which n_z changes no faster than `GROWTH` times as
fast as after them: its weight brings it back from either rim."""
GROWTH = 1.1
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
        now = State((x[0], x[1], x[2] + sunk), v, e, w, R)
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
            # It passes over its face, and onto the rim point that lands.
            free_step(coin, dt / APPROACH * (2 - APPROACH))
            joint_of(coin).qpos[2] -= evaluate_gap(coin).gap
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
def _land(plastic: MujocoCoin) -> float:
    """Let the floor stop the approach of the other rim, in one step of the coin for plastic impacts.

    The rocking stops if more landings would follow within the next step.

    Returns:
        The rate of n_z that is left [1/s].
    """
    set_margin(plastic, max(evaluate_gap(plastic).gap, 0.0) + NEAR * plastic.body.thickness)
    set_spring(plastic, 0.0, plastic.rebound.damping, plastic.rebound.slip_damping)
    pushes = forward(plastic) > 0
    step_on_floor(plastic, IMPACT, plastic.rebound.step, pushes and plastic.has_explicit_friction)
    up, w, qvel = state_of(plastic).R[2], state_of(plastic).spin, joint_of(plastic).qvel
    rate = cross(up, w)[2]
    if half_period(plastic, up, w) >= 1:
        return abs(rate)
    turning = rate / (up[0] * up[0] + up[1] * up[1])
    qvel[2], qvel[3], qvel[4] = 0.0, w[0] + up[1] * turning, w[1] - up[0] * turning
    return 0.0


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
