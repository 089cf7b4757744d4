"""The event loop of a toss: in every mode to its next event, and on in the mode that follows."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.automaton import Event, Mode, mode_after
from cointoss.analytic.contact import edge, modes, one_rim
from cointoss.analytic.contact.following import follow, friction_in_contact, is_followed, start_following
from cointoss.analytic.contact.periodic import repeats, start_tilting
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rest import rests, rolls_upright
from cointoss.analytic.flight.catch import fly_to_hand
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import (
    STATE_SIZE,
    position_of,
    set_height,
    set_spin,
    set_velocity,
    state_of,
)
from cointoss.analytic.flight.touch_search import is_chattering
from cointoss.analytic.impact.laws import ImpactPoint, impulse, spin_gained
from cointoss.analytic.settings import FINE, Settings, contact_limits
from cointoss.models.body import Body, Rules, is_to_be_caught
from cointoss.models.ending import classify_ending, endless, face_outcome, unless_caught
from cointoss.models.geometry import contact_velocity, evaluate_gap, lowest_point
from cointoss.models.impact_row import FIRST_ROOM, with_room, write_impact
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import add, apply, scale, subtract
from cointoss.models.laws import EndingTest
from cointoss.models.perpetual import energy_history, start_history
from cointoss.models.records import IMPACT_ROW, Array, Ending, Outcome
from cointoss.models.state import State

# A mode that lasts less than this part of √(r/g) costs so many steps, lest changes that take no time go on.
_NO_TIME, _STALLED = 1e-12, 1000
NO_LOSS = 1e-12
"""A loss in the time √(r/g) that rounding may cause, against the energy; steps of contact come on top."""


class EventLog(NamedTuple):
    """What the event loop gives for one toss."""

    rows: NDArray[Any]
    """Impacts, (n,) of `IMPACT_ROW`."""
    start_times: Array
    """Where modes start, and where the toss ends, (k,) [s]."""
    start_states: Array
    """States there, (k, 13)."""
    modes: NDArray[np.int8]
    """What starts there: `Mode`, (k,)."""
    contacts: Array
    """Start and end of every sustained contact, (n, 2) [s]."""
    outcome: Outcome
    ending: Ending
    end_time: float


def run(body: Body, rules: Rules, start: Array, settings: Settings = FINE) -> EventLog:
    """Toss the coin in state `start`, (13,), until the toss is decided or a budget is spent."""
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    n, rows, pieces, outcome, ending, end_time = toss_coin(
        body, rules, contact_limits(settings), start.copy(), room, True
    )
    start_times, started = pieces[:, 0].copy(), pieces[:, 1].astype(np.int8)
    return EventLog(
        rows=rows[:n].copy(),
        start_times=start_times,
        start_states=pieces[:, 2:].copy(),
        modes=started,
        contacts=contacts_of(start_times, started),
        outcome=Outcome(outcome),
        ending=Ending(ending),
        end_time=end_time,
    )


def contacts_of(start_times: Array, started: NDArray[np.int8]) -> Array:
    """Return start and end of every sustained contact, (n, 2) [s], from the modes and where they start."""
    lasting = (started != Mode.FLIGHT) & (started != Mode.ENDED)
    changes = np.diff(lasting.astype(np.int8), prepend=0)
    return np.stack([start_times[changes == 1], start_times[changes == -1]], axis=1)


@compiled
def hit(body, rules, chi, y, row):
    """Let the floor act on the coin in state y, which touches it, and record the impact.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of this impact.
        y: state at the touch, (13,); becomes the state after the impact.
        row: where the impact is recorded, one `IMPACT_ROW`.

    Returns:
        `Ending.NO_SOLUTION` where the contact law has none, else `Ending.NONE`.
    """
    before = state_of(y)
    x, v, e, w, R = before
    point, flat = lowest_point(body, R[2], w)
    arm = apply(R, subtract(point, body.center))
    out = (point[0] ** 2 + point[1] ** 2) ** 0.5
    tau = apply(R, (-point[1] / out, point[0] / out, 0.0)) if out > 0 else (1.0, 0.0, 0.0)
    v_A = contact_velocity(body, R, v, w, point)
    S, ending = impulse(body, rules, chi, ImpactPoint(R, arm, tau, v_A, flat))
    v_after = add(v, scale(1 / body.mass, S))
    w_after = w if flat else add(w, spin_gained(body, R, arm, S))
    write_impact(body, S, point, before, State(x, v_after, e, w_after, R), row)
    set_velocity(y, v_after)
    set_spin(y, w_after)
    return ending


@compiled
def restitution_at(body, rules, y):
    """Return χ of the touch in the state y, (13,): 0 up to the floor's threshold of the speed of approach."""
    threshold = rules.restitution_threshold
    is_plastic = threshold > 0 and -evaluate_gap(body, state_of(y)).speed <= threshold
    return 0.0 if is_plastic else rules.restitution


@compiled
def toss_coin(body, rules, limits, y, rows, keep_all):
    """Run the event loop.

    Args:
        body: the coin.
        rules: floor and ending.
        limits: `ContactLimits`.
        y: state at release, (13,); becomes the state at the end.
        rows: where the impacts are recorded, (m,) of `IMPACT_ROW`. The row after the last is work space.
        keep_all: whether all impacts are recorded, in as many rows as they need, and where modes start;
            else impact number n is recorded in row n modulo m.

    Returns:
        Number of impacts; the rows; where modes start, each with its time, `Mode` and state, and the end,
        (k, 15), or none; outcome; ending; and the time of the end [s].
    """
    pieces = np.empty((FIRST_ROOM if keep_all else 0, 2 + STATE_SIZE))
    time, n, k, steps = 0.0, 0, 0, 0
    mode, history = Mode.FLIGHT.value, energy_history(NO_LOSS + limits.tolerance)
    friction = friction_in_contact(rules)
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    while True:
        if keep_all:
            if k == len(pieces):
                pieces = doubled(pieces)
            pieces[k, 0], pieces[k, 1] = time, mode
            copy_into(pieces[k, 2:], y)
            k += 1
        if mode == Mode.ENDED:
            break
        if mode == Mode.FLIGHT:
            if keep_all:
                rows = with_room(rows, n)
            row = rows[n % len(rows)]
            event, time, n, outcome, ending = fly_to_event(body, rules, friction, y, time, n, row, history)
            steps += event != Event.IMPACT
        else:
            event, time, steps, outcome, ending = follow_to_event(
                body, rules, friction, mode, y, time, steps, limits, history
            )
        if event != Event.ENDS and steps >= limits.steps:
            event, ending = Event.ENDS, Ending.CONTACT_STEPS
        mode = mode_after(mode, event)
    return n, rows, pieces[:k], *unless_caught(rules, outcome, ending), time


@compiled
def doubled(table):
    """Return the table with twice its rows."""
    larger = np.empty((2 * len(table), table.shape[1]))
    for i in range(len(table)):
        copy_into(larger[i], table[i])
    return larger


@compiled
def fly_to_event(body, rules, friction, y, time, n, row, history):
    """Fly to the next touch, and let the floor act: an impact, or where impacts chatter a sustained contact.

    Args:
        body: the coin.
        rules: floor and ending.
        friction: `FloorFriction` in sustained contact.
        y: state, (13,); advanced.
        time: now [s].
        n: number of impacts so far.
        row: where an impact is recorded, one `IMPACT_ROW`.
        history: `EnergyHistory` of the toss; kept up.

    Returns:
        The event, the time [s], the number of impacts, the outcome and the ending.
    """
    if n == rules.max_impacts:
        return Event.ENDS, time, n, Outcome.UNDECIDED, Ending.MAX_IMPACTS
    if is_to_be_caught(rules):
        flown = fly_to_hand(body, rules.caught, y, rules.max_time - time)
        if flown < np.inf:
            return Event.ENDS, time + flown, n, face_outcome(state_of(y)), Ending.CAUGHT
    flown, touches, _ = fly(body, y, rules.max_time - time)
    time += flown
    if not touches:
        return Event.ENDS, time, n, Outcome.UNDECIDED, Ending.MAX_TIME
    chi = restitution_at(body, rules, y)
    if is_chattering(body, chi, state_of(y)):
        event, outcome, ending = come_to_stay(body, rules, friction, y, time, row, history)
        return event, time, n, outcome, ending
    ending = hit(body, rules, chi, y, row)
    if ending != Ending.NONE:
        return Event.ENDS, time, n, Outcome.UNDECIDED, ending
    row.time = time
    # A step forced at a grazing point may have left the coin a little below the floor.
    set_height(y, position_of(y)[2] - min(evaluate_gap(body, state_of(y)).gap, 0.0))
    outcome, ending = classify_ending(body, rules, state_of(y), time, history)
    return Event.IMPACT if ending == Ending.NONE else Event.ENDS, time, n + 1, outcome, ending


@compiled
def come_to_stay(body, rules, friction, y, time, row, history):
    """Let the floor stop the approach of a coin whose impacts chatter, `row` being work space.

    Returns:
        The event, the outcome and the ending.
    """
    outcome, ending = classify_ending(body, rules, state_of(y), time, history)
    if ending == Ending.NONE and not is_followed(rules.law):
        ending = Ending.CHATTER
    if ending != Ending.NONE:
        return Event.ENDS, outcome, ending
    ending = hit(body, rules, 0.0, y, row)
    if ending != Ending.NONE:
        return Event.ENDS, outcome, ending
    start_history(body, history, time)
    edge.lean(body, y)
    return one_rim.next_event(body, friction, Mode.FLIGHT.value, y), outcome, ending


@compiled
def follow_to_event(body, rules, friction, mode, y, time, steps, limits, history):
    """Follow a sustained contact to the end of its mode, or of the toss.

    Args:
        body: the coin.
        rules: floor and ending.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,); advanced.
        time: now [s].
        steps: made in contact so far.
        limits: `ContactLimits`.
        history: `EnergyHistory` of the toss; kept up.

    Returns:
        The event, the time [s], the steps, the outcome and the ending.
    """
    undecided, dt, in_mode = Outcome.UNDECIDED, np.inf, 0
    stages, tilting = start_following(body, friction, mode, y), start_tilting(body, friction, mode)
    while time < rules.max_time:
        longest = min(dt, rules.max_time - time)
        made, dt, over, event = follow(body, friction, mode, y, longest, limits.tolerance, stages)
        time += made
        in_mode += 1
        if event == Event.ENDS:
            return event, time, steps, undecided, Ending.NO_SOLUTION
        stalled = over and event == Event.NONE and made < _NO_TIME * (body.radius / body.gravity) ** 0.5
        steps += _STALLED if stalled else 1
        outcome, ending = classify_ending(body, rules, state_of(y), time, history)
        if ending != Ending.NONE:
            return Event.ENDS, time, steps, outcome, ending
        if has_resistance(friction) and rests(body, friction, mode, y):
            return Event.ENDS, time, steps, Outcome.EDGE, Ending.AT_REST
        if not over and repeats(tilting, y):
            return Event.ENDS, time, steps, *endless(body, rules, state_of(y))
        on_edge = modes.edge_event(body, friction, mode, in_mode, rules.test != EndingTest.LYING, y)
        if on_edge == Event.ENDS:
            return Event.ENDS, time, steps, Outcome.EDGE, Ending.STANDING
        if on_edge == Event.COMES_UPRIGHT:
            return on_edge, time, steps, undecided, Ending.NONE
        if steps >= limits.steps:
            return Event.ENDS, time, steps, *out_of_budget(body, friction, mode, y, Ending.CONTACT_STEPS)
        if over:
            if event == Event.NONE:
                event = modes.next_event(body, friction, mode, y)
            return event, time, steps, undecided, Ending.NONE
    return Event.ENDS, time, steps, *out_of_budget(body, friction, mode, y, Ending.MAX_TIME)


@compiled
def out_of_budget(body, friction, mode, y, ending: Ending) -> tuple[Outcome, Ending]:
    """Return the outcome and ending of a toss that ends in contact as a budget is spent.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,).
        ending: named after the budget.
    """
    if rolls_upright(body, friction, mode, y):
        return Outcome.EDGE, Ending.ROLLING
    return Outcome.UNDECIDED, ending
