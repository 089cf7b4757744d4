"""The motion of a coin after its toss is decided, by the modes of the event loop without its verdicts."""

import numpy as np

from cointoss.analytic.contact.automaton import Event, Mode, contact_at, margin_event, mode_after
from cointoss.analytic.contact.edge.guards import comes_upright
from cointoss.analytic.contact.floor_force import horizontal_size
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.integrator import contact_work, step_contact
from cointoss.analytic.contact.lying import STILL, project
from cointoss.analytic.contact.resets import rebound_at
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.events import (
    EVENT,
    GOES_ON,
    NO_LOSS,
    NOT_FLOWN,
    Passage,
    Setup,
    Spent,
    cost_of,
    flow_to_event,
    reset,
    with_piece,
)
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import set_spin, set_velocity, spin_of, state_of, velocity_of
from cointoss.analytic.flight.touch_search import is_chattering
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.analytic.settings import ContactLimits
from cointoss.models.body import Body, Rules
from cointoss.models.contact_laws.table import is_followed
from cointoss.models.ending import WOBBLE, followed_until, lies
from cointoss.models.geometry import FACE_SINE, tilt_sine_of
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.arrays import Table, doubled
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm
from cointoss.models.making import AT_REST
from cointoss.models.perpetual import energy_history
from cointoss.models.records import IMPACT_ROW, Array, Ending

FOLLOWED = 4
"""A coin is followed for this many times the steps in contact that its toss may take."""


@compiled
def go_on(
    body: Body, rules: Rules, limits: ContactLimits, pieces: Table, ending: Ending, until: float
) -> Table:
    """Return where the modes of a toss start, and those after it was decided.

    It is followed for `FOLLOWED` times the steps in contact of a toss at most, from its end on, and up to the
    time limit. Where the contact law goes no further, the path ends.

    Args:
        body: the coin.
        rules: floor and ending.
        limits: of sustained contact.
        pieces: where the modes of the toss start, and its end, as `toss_coin` gives them, (k, 17).
        ending: of the toss.
        until: the time up to which the coin is followed [s]; `AT_REST`: until it is at rest.

    Returns:
        The same with the modes from the end of the toss on, and the end of the path, (m, 17).
    """
    k, to_rest = len(pieces) - 1, until == AT_REST
    start = pieces[k, 0]
    last = followed_until(rules, ending, start, until)
    if last == start:
        return pieces
    y, room = pieces[k, 2:15].copy(), np.zeros(FIRST_ROOM, IMPACT_ROW)
    history = energy_history(NO_LOSS + limits.tolerance)
    limits = ContactLimits(FOLLOWED * limits.steps, limits.tolerance)
    setup = Setup(body, rules, friction_in_contact(rules), limits, history, False, np.empty(2))
    mode, spent = mode_at_end(pieces, ending), Spent(start, 0, 1)
    found = doubled(pieces)
    while True:
        if can_lie(mode) and lies(body, rules, state_of(y), WOBBLE):
            mode = mode_after(mode, Event.LIES)
        if mode == Mode.LYING:
            project(contact_at(body, setup.friction, mode, y), y)
        elif mode == Mode.RESTING:
            stop(y)
            mode = Mode.ENDED.value if to_rest else mode
        if mode != Mode.TOUCHING:
            found = with_piece(found, k, min(spent.time, last), mode, y)
            k += 1
        if mode == Mode.ENDED:
            return found[:k]
        passage = move_to_event(setup, mode, y, spent, last)
        before, spent = mode, passage.spent
        mode = mode_after(mode, passage.event)
        if reset(setup, before, passage, y, room[0]) != Ending.NONE or (
            mode != Mode.TOUCHING and mode != Mode.ENDED and spent.steps >= limits.steps
        ):
            mode = Mode.ENDED.value


@compiled
def mode_at_end(pieces: Table, ending: int) -> int:
    """Return the `Mode` in which a coin goes on after its toss; args as of `go_on`.

    A verdict after an impact, at a touch or on a coin laid flat leaves the coin in flight; one in a contact,
    in that contact.
    """
    if ending == Ending.CAUGHT:
        return Mode.RESTING.value
    mode, y = int(pieces[-2, 1]), pieces[-1, 2:15]
    return Mode.FLIGHT.value if tilt_sine_of(state_of(y).R[2]) <= FACE_SINE else mode


@compiled
def can_lie(mode: int) -> bool:
    """Return whether a coin in this `Mode` may lie flat unnoticed: in flight or on a rim."""
    return mode < Mode.ENDED


@compiled
def fastest(body: Body, y: Array) -> float:
    """Return the speed of C, or that of the rim by the spin, in the state y, (13,) [m/s]: the larger."""
    return max(norm(velocity_of(y)), body.radius * norm(spin_of(y)))


@compiled
def stop(y: Array) -> None:
    """Take all velocity from the state y, (13,)."""
    set_velocity(y, (0.0, 0.0, 0.0))
    set_spin(y, (0.0, 0.0, 0.0))


@compiled
def move_to_event(setup: Setup, mode: int, y: Array, spent: Spent, last: float) -> Passage:
    """Advance the state y, (13,), by the flow of its mode to the event that ends it, or to `last` [s]."""
    if mode == Mode.FLIGHT:
        return fly_on(setup, y, spent, last)
    if mode == Mode.RESTING:
        return Passage(Event.ENDS, Spent(last, spent.impacts, spent.steps), GOES_ON, NOT_FLOWN)
    if mode == Mode.TOUCHING:
        return flow_to_event(setup, mode, y, spent)
    return hold_on(setup, mode, y, spent, last)


@compiled
def fly_on(setup: Setup, y: Array, spent: Spent, last: float) -> Passage:
    """Fly to the next touch, or to the time `last`, or to where the law goes no further; y: state, (13,)."""
    body, rules = setup.body, setup.rules
    flown = fly(body, y, last - spent.time, False)
    spent = Spent(spent.time + flown.time, spent.impacts, spent.steps + EVENT + flown.steps)
    if not flown.touches:
        return Passage(Event.ENDS, Spent(last, spent.impacts, spent.steps), GOES_ON, flown)
    if not is_chattering(body, rebound_at(body, rules, y), state_of(y)):
        return Passage(Event.IMPACT, spent, GOES_ON, flown)
    return Passage(Event.CHATTERS if is_followed(rules.law) else Event.ENDS, spent, GOES_ON, flown)


@compiled
def hold_on(setup: Setup, mode: int, y: Array, spent: Spent, last: float) -> Passage:
    """Follow a sustained contact to the end of its mode, or to the time `last`; y: state, (13,)."""
    body, friction, limits = setup.body, setup.friction, setup.limits
    contact = contact_at(body, friction, mode, y)
    stages, dt = contact_work(contact, y), np.inf
    slow = SLOW * (body.gravity * body.radius) ** 0.5
    while spent.time < last and spent.steps < limits.steps:
        step = step_contact(contact, y, min(dt, last - spent.time), limits.tolerance, stages)
        dt = step.next_dt
        if step.event == Event.NO_SOLUTION:
            return Passage(step.event, spent, GOES_ON, NOT_FLOWN)
        spent = Spent(spent.time + step.elapsed, spent.impacts, spent.steps + cost_of(body, step))
        if step.event == Event.FALLS_FLAT:
            return Passage(step.event, spent, GOES_ON, NOT_FLOWN)
        contact = contact_at(body, friction, mode, y)
        if mode != Mode.LYING:
            if lies(body, setup.rules, state_of(y), WOBBLE):
                return Passage(Event.LIES, spent, GOES_ON, NOT_FLOWN)
            is_held = has_resistance(friction) and rests(contact, y)
            if (is_held and horizontal_size(velocity_of(y)) < slow) or (
                mode == Mode.UPRIGHT
                and body.downhill == 0
                and fastest(body, y) < STILL * (body.gravity * body.radius) ** 0.5
            ):
                return Passage(Event.RESTS, spent, GOES_ON, NOT_FLOWN)
            if comes_upright(contact, y):
                return Passage(Event.COMES_UPRIGHT, spent, GOES_ON, NOT_FLOWN)
        if step.is_over:
            event = margin_event(contact, y) if step.event == Event.NONE else step.event
            return Passage(event, spent, GOES_ON, NOT_FLOWN)
    return Passage(Event.ENDS, spent, GOES_ON, NOT_FLOWN)
