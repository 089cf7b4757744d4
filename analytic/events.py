"""The event loop of a toss: the flow of each mode to its next event, the mode after it, and its reset."""

from typing import Any, NamedTuple

import numpy as np

from cointoss.analytic.contact.automaton import Event, Mode, contact_at, margin_event, mode_after
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.edge.guards import comes_upright, stands_for_good
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.integrator import ContactStep, contact_work, step_contact
from cointoss.analytic.contact.lying import lay_flat
from cointoss.analytic.contact.periodic import TiltHistory, record_tilt, repeats, start_tilt_history
from cointoss.analytic.contact.resets import (
    begin_contact,
    bounce,
    rebound_at,
    stand_up,
    stop_slip,
    tip_over,
)
from cointoss.analytic.contact.resistance import FloorFriction, has_resistance
from cointoss.analytic.contact.rest import rests, rolls_upright
from cointoss.analytic.flight.catch import fly_to_hand
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.analytic.flight.touch_search import Flown, is_chattering
from cointoss.analytic.settings import ContactLimits
from cointoss.models.body import Body, Rules, is_to_be_caught
from cointoss.models.contact_laws.table import is_followed
from cointoss.models.ending import classify_ending, endless, face_outcome, out_of_steps, unless_caught
from cointoss.models.impact_row import FIRST_ROOM, ImpactRows, with_room
from cointoss.models.kernel.arrays import Codes, Row, Table, copy_into, doubled
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.laws import EndingTest
from cointoss.models.perpetual import EnergyHistory, energy_history, start_history
from cointoss.models.records import Array, Ending, Outcome

# A step shorter than this part of √(r/g) counts as this many, or changes in no time could go on for ever.
_NO_TIME, _STALLED = 1e-12, 1000
EVENT = 4
"""An event after the first sustained contact counts as this many steps."""
NO_LOSS = 1e-12
"""A loss in the time √(r/g) that rounding may cause, against the energy; steps of contact come on top."""


class Setup(NamedTuple):
    """The data of a toss beside its release, and its energies so far."""

    body: Body
    rules: Rules
    friction: FloorFriction
    """The floor's friction in sustained contact."""
    limits: ContactLimits
    history: EnergyHistory
    """The energies so far, which the event loop keeps up."""
    with_graze: bool
    """Whether the flights before the first contact look for minima of the gap; they change nothing else."""
    so_far: Row
    """Impacts and time [s] so far, (2,), for whoever waits for the toss."""


class Spent(NamedTuple):
    """What a toss has spent of its budgets."""

    time: float
    """Now [s]."""
    impacts: int
    steps: int
    """The steps from the first sustained contact on; an event counts as `EVENT`."""


class TossEnd(NamedTuple):
    """How a toss ends, or that it goes on: `Outcome.UNDECIDED` and `Ending.NONE`."""

    outcome: Outcome
    ending: Ending


class Passage(NamedTuple):
    """A mode up to the event that ends it."""

    event: Event
    spent: Spent
    """What the toss has spent up to the event."""
    verdict: TossEnd
    """How the toss ends, where the event ends it."""
    flown: Flown
    """The flight up to a touch, or `NOT_FLOWN`."""


GOES_ON, OUT_OF_TIME = TossEnd(Outcome.UNDECIDED, Ending.NONE), TossEnd(Outcome.UNDECIDED, Ending.MAX_TIME)
NOT_FLOWN = Flown(0.0, False, 0, 0, np.inf)
_STEPS, _GRAZE = 2 + STATE_SIZE, 3 + STATE_SIZE
"""Columns of the table of modes for the flights, after the time, the `Mode` and the state."""


class Started(NamedTuple):
    """Where modes start, and where the toss ends."""

    times: Row
    """The times at which modes start, and the end of the toss, (k,) [s]."""
    states: Table
    """The states at these times, (k, 13)."""
    modes: Codes
    """What starts there: `Mode`, (k,)."""
    steps: Row
    """The steps of the flights, 0 of other modes, (k,)."""
    grazes: Row
    """The `Flown.graze` of the flights, (k,) [m]."""


@compiled
def started_of(pieces: Array) -> Started:
    """Return the modes of a toss from the table that `toss_coin` gives, (k, 17)."""
    return Started(
        pieces[:, 0].copy(),
        pieces[:, 2:_STEPS].copy(),
        pieces[:, 1].astype(np.int8),
        pieces[:, _STEPS].copy(),
        pieces[:, _GRAZE].copy(),
    )


@compiled
def toss_coin(
    body: Body, rules: Rules, limits: ContactLimits, y: Row, rows: ImpactRows, keep_all: bool, so_far: Row
) -> tuple[int, ImpactRows, Table, Outcome, Ending, float]:
    """Run the event loop.

    Args:
        body: the coin.
        rules: floor and ending.
        limits: `ContactLimits`.
        y: state at release, (13,); becomes the state at the end.
        rows: where the impacts are recorded, (m,) of `IMPACT_ROW`. The row after the last is work space.
        keep_all: whether all impacts are recorded, in as many rows as they need, and where modes start;
            else impact number n is recorded in row n modulo m.
        so_far: becomes the number of impacts and the time [s] so far, (2,), while the toss goes on.

    Returns:
        Number of impacts; the rows; where modes start, each with its time, `Mode` and state, the steps and
        the graze of a flight, and the end, (k, 17), or none; outcome; ending; and the time of the end [s].
    """
    history = energy_history(NO_LOSS + limits.tolerance)
    setup = Setup(body, rules, friction_in_contact(rules), limits, history, keep_all, so_far)
    pieces, k = np.empty((FIRST_ROOM if keep_all else 0, _GRAZE + 1)), 0
    mode, spent, verdict = Mode.FLIGHT.value, Spent(0.0, 0, 0), GOES_ON
    while True:
        so_far[0], so_far[1] = spent.impacts, spent.time
        if keep_all and mode != Mode.TOUCHING:
            pieces = with_piece(pieces, k, spent.time, mode, y)
            k += 1
        if mode == Mode.ENDED:
            break
        passage = flow_to_event(setup, mode, y, spent)
        if keep_all:
            rows = with_room(rows, passage.spent.impacts)
            if mode == Mode.FLIGHT:
                pieces[k - 1, _STEPS], pieces[k - 1, _GRAZE] = passage.flown.steps, passage.flown.graze
        mode, spent, verdict = after_event(setup, mode, passage, y, rows)
    outcome, ending = unless_caught(rules, verdict.outcome, verdict.ending)
    return spent.impacts, rows, pieces[:k], outcome, ending, spent.time


@compiled
def after_event(
    setup: Setup, before: int, passage: Passage, y: Array, rows: ImpactRows
) -> tuple[int, Spent, TossEnd]:
    """Bring a toss from the event that ends a mode to the start of the next, and return that.

    Args:
        setup: the toss.
        before: number of the `Mode` that has ended.
        passage: of that mode.
        y: state, (13,); changed by the reset.
        rows: where impacts are recorded, see `toss_coin`.

    Returns:
        The number of the next `Mode`; what the toss has spent; and how it ends, or `GOES_ON`.
    """
    event, spent, verdict = passage.event, passage.spent, passage.verdict
    mode = mode_after(before, event)
    ending = reset(setup, before, passage, y, rows[spent.impacts % len(rows)])
    if ending != Ending.NONE:
        verdict = TossEnd(Outcome.UNDECIDED, ending)
    elif event == Event.IMPACT or event == Event.FALLS_FLAT:
        spent = Spent(spent.time, spent.impacts + (1 if event == Event.IMPACT else 0), spent.steps)
        verdict = classified(setup, y, spent.time)
    if verdict.ending == Ending.NONE and mode != Mode.TOUCHING and spent.steps >= setup.limits.steps:
        verdict = steps_spent(setup, y)
    if verdict.ending != Ending.NONE and mode != Mode.ENDED:
        mode = mode_after(mode, Event.ENDS)
    return mode, spent, verdict


@compiled
def with_piece(pieces: Table, k: int, time: float, mode: int, y: Array) -> Table:
    """Return where modes start with one more in row k: in twice as many rows if there is no room.

    Args:
        pieces: where modes start, see `toss_coin`.
        k: how many do.
        time: at which the next starts [s].
        mode: the number of its `Mode`.
        y: state there, (13,).
    """
    if k == len(pieces):
        pieces = doubled(pieces)
    pieces[k, 0], pieces[k, 1] = time, mode
    copy_into(pieces[k, 2:_STEPS], y)
    pieces[k, _STEPS], pieces[k, _GRAZE] = 0, np.inf
    return pieces


@compiled
def classified(setup: Setup, y: Array, time: float) -> TossEnd:
    """Return the `classify_ending` of the state y, (13,), at this time [s]."""
    outcome, ending = classify_ending(setup.body, setup.rules, state_of(y), time, setup.history)
    return TossEnd(outcome, ending)


@compiled
def flow_to_event(setup: Setup, mode: int, y: Array, spent: Spent) -> Passage:
    """Advance the state y, (13,), by the flow of its mode to the event that ends it."""
    if mode == Mode.FLIGHT:
        return fly_to_event(setup, y, spent)
    if mode == Mode.TOUCHING:
        contact = contact_at(setup.body, setup.friction, mode, y)
        return Passage(margin_event(contact, y), spent, GOES_ON, NOT_FLOWN)
    return hold_to_event(setup, mode, y, spent)


@compiled
def reset(setup: Setup, mode: int, passage: Passage, y: Array, row: Any) -> Ending:
    """Map the state y, (13,), at an event to that in which the next mode starts.

    Args:
        setup: the toss.
        mode: number of the `Mode` that has ended.
        passage: of that mode.
        y: state, (13,).
        row: where an impact is recorded, one `IMPACT_ROW`; else work space.

    Returns:
        `Ending.NO_SOLUTION` where the contact law has none, else `Ending.NONE`.
    """
    event, body, time = passage.event, setup.body, passage.spent.time
    if event == Event.IMPACT:
        row.time = time
        return bounce(body, setup.rules, y, row)
    if event == Event.CHATTERS:
        start_history(body, setup.history, time)
        return begin_contact(body, setup.rules, y, row)
    if event == Event.FALLS_FLAT:
        lay_flat(body, y)
    elif event == Event.SLIP_STARTS or event == Event.SLIP_STOPS:
        stop_slip(contact_at(body, setup.friction, mode, y), mode_after(mode, event), y)
    elif event == Event.COMES_UPRIGHT:
        stand_up(contact_at(body, setup.friction, mode, y), y)
    elif event == Event.TIPS_OVER:
        tip_over(body, setup.friction, y)
    return Ending.NONE


@compiled
def fly_to_event(setup: Setup, y: Array, spent: Spent) -> Passage:
    """Fly to the next touch: an impact, or where impacts chatter the start of a sustained contact.

    Args:
        setup: the toss.
        y: state, (13,); advanced.
        spent: at the start.
    """
    body, rules = setup.body, setup.rules
    if spent.impacts == rules.max_impacts:
        return ends(spent, Outcome.UNDECIDED, Ending.MAX_IMPACTS)
    left = rules.max_time - spent.time
    if is_to_be_caught(rules):
        caught = fly_to_hand(body, rules.caught, y, left)
        if caught < np.inf:
            spent = Spent(spent.time + caught, spent.impacts, spent.steps)
            return ends(spent, face_outcome(state_of(y)), Ending.CAUGHT)
    flown = fly(body, y, left, setup.with_graze and spent.steps == 0)
    steps = EVENT + flown.steps if spent.steps > 0 else 0
    spent = Spent(spent.time + flown.time, spent.impacts, spent.steps + steps)
    if not flown.touches:
        return ends(spent, Outcome.UNDECIDED, Ending.MAX_TIME)
    if not is_chattering(body, rebound_at(body, rules, y), state_of(y)):
        return Passage(Event.IMPACT, spent, GOES_ON, flown)
    spent = Spent(spent.time, spent.impacts, spent.steps + 1)
    verdict = classified(setup, y, spent.time)
    if verdict.ending == Ending.NONE and not is_followed(rules.law):
        verdict = TossEnd(verdict.outcome, Ending.CHATTER)
    return Passage(Event.CHATTERS if verdict.ending == Ending.NONE else Event.ENDS, spent, verdict, flown)


@compiled
def ends(spent: Spent, outcome: Outcome, ending: Ending) -> Passage:
    """Return the `Passage` to the end of the toss."""
    return Passage(Event.ENDS, spent, TossEnd(outcome, ending), NOT_FLOWN)


@compiled
def hold_to_event(setup: Setup, mode: int, y: Array, spent: Spent) -> Passage:
    """Follow a sustained contact to the end of its mode, or of the toss.

    Args:
        setup: the toss.
        mode: number of the `Mode`, in contact.
        y: state, (13,); advanced.
        spent: at the start.
    """
    max_time, in_mode = setup.rules.max_time, 0
    contact = contact_at(setup.body, setup.friction, mode, y)
    stages, tilts = contact_work(contact, y), start_tilt_history(contact)
    dt = np.inf
    while spent.time < max_time:
        step = step_contact(contact, y, min(dt, max_time - spent.time), setup.limits.tolerance, stages)
        dt, in_mode = step.next_dt, in_mode + 1
        passage = after_step(setup, mode, tilts, in_mode, step, y, spent)
        if passage.event != Event.NONE:
            return passage
        spent, contact = passage.spent, contact_at(setup.body, setup.friction, mode, y)
    return out_of_budget(contact, y, spent, OUT_OF_TIME)


@inlined
def after_step(
    setup: Setup, mode: int, tilts: TiltHistory, in_mode: int, step: ContactStep, y: Array, spent: Spent
) -> Passage:
    """Return the `Passage` up to a step's end: its event is `NONE` where the mode goes on.

    These checks follow a step, in this order:

    1. no step: nothing was computed, so the other checks have no state to test.
    2. falls flat: the reset comes first, and the other checks test the coin that lies flat.
    3. decided by energy: the cheapest check, and a proof whatever the contact does next.
    4. at rest: resistance holds the coin; the next checks would report that it stands or rolls on.
    5. periodic: only within a mode, because the mode's end also ends the proof.
    6. standing: before the coin comes upright, because it could also stand on both rims.
    7. comes upright: before the budget, which is checked again when both rims are down.
    8. out of budget: before the mode's end, because a coin without budget is not followed further.
    9. the mode's end: a landing, or the event of a margin that is zero.

    Args:
        setup: the toss.
        mode: number of the `Mode`, in contact.
        tilts: of this mode.
        in_mode: steps made in it.
        step: the last of them.
        y: state at its end, (13,).
        spent: at its start.
    """
    body, rules, friction = setup.body, setup.rules, setup.friction
    if step.event == Event.NO_SOLUTION:
        return Passage(step.event, spent, TossEnd(Outcome.UNDECIDED, Ending.NO_SOLUTION), NOT_FLOWN)
    spent = Spent(spent.time + step.elapsed, spent.impacts, spent.steps + cost_of(body, step))
    setup.so_far[1] = spent.time
    if step.event == Event.FALLS_FLAT:
        return Passage(step.event, spent, GOES_ON, NOT_FLOWN)
    contact = contact_at(body, friction, mode, y)
    verdict = classified(setup, y, spent.time)
    if verdict.ending != Ending.NONE:
        return Passage(Event.ENDS, spent, verdict, NOT_FLOWN)
    if has_resistance(friction) and rests(contact, y):
        return ends(spent, Outcome.EDGE, Ending.AT_REST)
    if tilts.periodic and not step.is_over:
        record_tilt(tilts, y)
        if repeats(tilts):
            outcome, ending = endless(body, rules, state_of(y), setup.history, Ending.PERIODIC)
            return ends(spent, outcome, ending)
    if stands_for_good(contact, in_mode, rules.test != EndingTest.LYING, y):
        return ends(spent, Outcome.EDGE, Ending.STANDING)
    if comes_upright(contact, y):
        return Passage(Event.COMES_UPRIGHT, spent, GOES_ON, NOT_FLOWN)
    if spent.steps >= setup.limits.steps:
        return out_of_budget(contact, y, spent, steps_spent(setup, y))
    if step.is_over:
        event = margin_event(contact, y) if step.event == Event.NONE else step.event
        return Passage(event, spent, GOES_ON, NOT_FLOWN)
    if spent.time >= rules.max_time:
        return out_of_budget(contact, y, spent, OUT_OF_TIME)
    return Passage(Event.NONE, spent, GOES_ON, NOT_FLOWN)


@compiled
def cost_of(body: Body, step: ContactStep) -> int:
    """Return what a step counts against the budget: more where the mode ends again in no time."""
    is_short = step.elapsed < _NO_TIME * (body.radius / body.gravity) ** 0.5
    if step.is_over and step.event == Event.NONE and is_short:
        return _STALLED
    return 1 + EVENT if step.is_over else 1


@compiled
def steps_spent(setup: Setup, y: Array) -> TossEnd:
    """Return the `TossEnd` of a toss whose steps are spent in the state y, (13,)."""
    outcome, ending = out_of_steps(setup.body, setup.rules, state_of(y), setup.history)
    return TossEnd(outcome, ending)


@compiled
def out_of_budget(contact: SustainedContact, y: Array, spent: Spent, verdict: TossEnd) -> Passage:
    """Return how a toss ends in contact as a budget is spent.

    Args:
        contact: the contact.
        y: state, (13,).
        spent: so far.
        verdict: on a coin that does not roll on its edge.
    """
    if rolls_upright(contact, y):
        verdict = TossEnd(Outcome.EDGE, Ending.ROLLING)
    return Passage(Event.ENDS, spent, verdict, NOT_FLOWN)
