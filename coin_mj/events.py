"""The event loop of a toss in MuJoCo: flight, impact, sustained contact, ending."""

import math

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of
from cointoss.coin_mj.model.settings import Budgets
from cointoss.coin_mj.model.state import set_motion, state_of
from cointoss.coin_mj.steps.flight import FlightExit, fly
from cointoss.coin_mj.steps.gap_evaluation import evaluate_gap
from cointoss.coin_mj.steps.held_step import slow_speed
from cointoss.coin_mj.steps.impact import TouchResult, resolve_impact
from cointoss.coin_mj.steps.knots import RecordedPath, StepKind, add_knot, nothing_recorded
from cointoss.coin_mj.steps.rebound import coin_touching
from cointoss.coin_mj.steps.sustained_contact import NO_LOSS, NOT_DECIDED, ContactExit, follow_contact
from cointoss.models.body import Body, Rules, is_linear, with_time_alone
from cointoss.models.ending import classify_ending, face_outcome, followed_until, unless_caught
from cointoss.models.geometry import lowest_point
from cointoss.models.impact_row import FIRST_ROOM, ImpactRows, with_room, write_impact
from cointoss.models.kernel.arrays import Row, Table, doubled
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector
from cointoss.models.making import AT_REST
from cointoss.models.perpetual import energy_history, start_history
from cointoss.models.records import Ending, Outcome
from cointoss.models.restitution import chatter_restitution
from cointoss.models.state import State

ROUNDED_FLAT = 1e-13
"""A flat coin's tilt, and its turn in √(r/g), by MuJoCo's rounding alone; measured: 3e-15 in five bounces."""

STILL = 1e-4
"""A coin in contact is at rest where it moves slower than this part of √(g r)."""
AIR_STEPS = 50
"""A step in air with b > 0 counts as this many: its quadratures take up to 1 ms for each force."""


@compiled
def toss_coin(
    coin: MujocoCoin,
    plastic: MujocoCoin,
    rules: Rules,
    budgets: Budgets,
    rows: ImpactRows,
    keep_all: bool,
    impacts: Row,
) -> tuple[int, ImpactRows, Table, Table, Outcome, Ending, float]:
    """Toss the coin from its present state until the toss is decided.

    Args:
        coin: MuJoCo's, at its release.
        plastic: the same, for touches up to the threshold of restitution.
        rules: floor and ending.
        budgets: the most steps in flight and in sustained contact.
        rows: where the impacts are recorded, (m,) of `IMPACT_ROW`.
        keep_all: whether all impacts are recorded, in as many rows as they need, and the path; else impact
            number n is recorded in row n modulo m.
        impacts: becomes their number so far, (1,), while the toss goes on, beside MuJoCo's time.

    Returns:
        Number of impacts; the rows; knots of the path, see `path.Knots`, (k, 15), or none; start and end of
        every sustained contact, (c, 2) [s]; outcome; ending; and the time of the end [s].
    """
    time, n, history = 0.0, 0, energy_history(NO_LOSS)
    weight = 1 if is_linear(coin.body.air) else AIR_STEPS
    steps_left, flight_steps_left = budgets.contact_steps // weight, budgets.flight_steps // weight
    path = add_knot(coin, time, StepKind.FLIGHT, nothing_recorded(keep_all))
    contacts, c = np.empty((FIRST_ROOM if keep_all else 0, 2)), 0
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    lands = False
    while ending == Ending.NONE:
        impacts[0] = n
        if n == rules.max_impacts:
            ending = Ending.MAX_IMPACTS
            break
        if not lands:
            time, way, flight_steps_left, path = fly(coin, rules, time, flight_steps_left, path)
            if way == FlightExit.CAUGHT:
                outcome, ending = face_outcome(state_of(coin)), Ending.CAUGHT
                break
            if way == FlightExit.BUDGET:
                ending = Ending.MAX_TIME if time >= rules.max_time else Ending.FLIGHT_STEPS
                break
        start, touch = time, state_of(coin)
        touched, is_slow = touch_of(coin, plastic, rules)
        sustained = is_slow and not lands
        if not sustained:
            result, time, impulse, path = resolve_impact(touched, time, path)
            sustained = result == TouchResult.SUSTAINED
            if result == TouchResult.IMPACT:
                if keep_all:
                    rows = with_room(rows, n)
                now = state_of(coin)
                record(coin.body, start, touch, impulse, now, rows[n % len(rows)])
                n += 1
                outcome, ending = classify_ending(coin.body, rules, now, time, history)
        lands = False
        if sustained:
            start_history(coin.body, history, time)
            left_by, time, steps_left, outcome, ending, path = follow_contact(
                coin, plastic, rules, time, steps_left, history, path, NOT_DECIDED
            )
            if keep_all and time > start:
                contacts = doubled(contacts) if c == len(contacts) else contacts
                contacts[c, 0], contacts[c, 1] = start, time
                c += 1
            lands = left_by == ContactExit.RIM_LANDS
            steps_left -= 1
    path = add_knot(coin, time, StepKind.FLIGHT, path)
    outcome, ending = unless_caught(rules, outcome, ending)
    return n, rows, path.table[: path.size], contacts[:c], outcome, ending, time


@compiled
def touch_of(coin: MujocoCoin, plastic: MujocoCoin, rules: Rules) -> tuple[MujocoCoin, bool]:
    """Return the coin with the rebound of its touch now, and whether it is so slow that the coin stays down.

    Args:
        coin: MuJoCo's, which touches.
        plastic: the same, for touches up to the threshold of restitution.
        rules: floor and ending.
    """
    speed, w = -evaluate_gap(coin).speed, state_of(coin).spin
    if rules.restitution_threshold > 0 and speed <= rules.restitution_threshold:
        return plastic, speed < slow_speed(coin, 0.0, w)
    return coin_touching(coin, rules, speed), speed < slow_speed(coin, chatter_restitution(rules, speed), w)


@compiled
def go_on(
    coin: MujocoCoin,
    plastic: MujocoCoin,
    rules: Rules,
    budgets: Budgets,
    knots: Table,
    ending: Ending,
    until: float,
) -> tuple[Table, Table]:
    """Step the coin on after its toss, without the tests that end one, see `EndingCriteria.until`.

    Args:
        coin: MuJoCo's.
        plastic: the same, for touches up to the threshold of restitution.
        rules: floor and ending.
        budgets: the most steps in flight and in sustained contact, from the end of the toss on.
        knots: of the path of the toss, (k, 15).
        ending: of the toss.
        until: the time up to which the coin is followed [s]; `AT_REST`: until it is at rest.

    Returns:
        Knots of the whole path, (m, 15); and start and end of each impact or sustained contact after the
        toss, (n, 3) [s], with 1 as the third number for a sustained contact.
    """
    k, time = len(knots) - 1, knots[-1, 0]
    touches, n = np.empty((FIRST_ROOM, 3)), 0
    last = followed_until(rules, ending, time, until)
    if last == time:
        return knots, touches[:n]
    path = RecordedPath(doubled(knots), k)
    set_motion(coin, knots[k, 2:])
    if ending == Ending.CAUGHT:
        joint_of(coin).qvel[:] = 0
        path = add_knot(coin, last, StepKind.FLIGHT, add_knot(coin, time, StepKind.IMPACT, path))
        return path.table[: path.size], touches[:n]
    rules, history = with_time_alone(rules, last), energy_history(NO_LOSS)
    still = STILL * (coin.body.gravity * coin.body.radius) ** 0.5 if until == AT_REST else 0.0
    weight = 1 if is_linear(coin.body.air) else AIR_STEPS
    steps_left, flight_steps_left = budgets.contact_steps // weight, budgets.flight_steps // weight
    sustained, lands = knots[k - 1, 1] >= StepKind.CONTACT.value, False
    while time < last and steps_left > 0:
        touched = coin
        if not (sustained or lands):
            time, way, flight_steps_left, path = fly(coin, rules, time, flight_steps_left, path)
            if way == FlightExit.BUDGET:
                break
            touched, sustained = touch_of(coin, plastic, rules)
        start, left_by, now = time, ContactExit.LIFT_OFF, Ending.NONE
        if not sustained:
            result, time, _, path = resolve_impact(touched, time, path)
            sustained = result == TouchResult.SUSTAINED
        if sustained:
            left_by, time, steps_left, _, now, path = follow_contact(
                coin, plastic, rules, time, steps_left, history, path, still
            )
        touches = doubled(touches) if n == len(touches) else touches
        touches[n, 0], touches[n, 1], touches[n, 2] = start, time, 1.0 if sustained else 0.0
        n += 1
        steps_left -= 1
        sustained, lands = False, left_by == ContactExit.RIM_LANDS
        if left_by == ContactExit.DECIDED:
            if now == Ending.AT_REST:
                joint_of(coin).qvel[:] = 0
            break
    path = add_knot(coin, time, StepKind.FLIGHT, path)
    return path.table[: path.size], touches[:n]


@compiled
def record(body: Body, time: float, touch: State, impulse: Vector, release: State, row: np.record) -> None:
    """Record an impact; if the coin is flat within rounding, at the point under C.

    Args:
        body: the coin.
        time: of first touch [s].
        touch: state then.
        impulse: integral of the floor's force, space frame, (3,) [N s].
        release: state at release.
        row: where it goes.
    """
    up, w = touch.R[2], touch.spin
    turning = math.hypot(w[0], w[1]) * (body.radius / body.gravity) ** 0.5
    if max(math.hypot(up[0], up[1]), turning) <= ROUNDED_FLAT:
        up, w = (0.0, 0.0, up[2]), (0.0, 0.0, w[2])
    point, _ = lowest_point(body, up, w)
    write_impact(body, impulse, point, touch, release, row)
    row.time = time
