"""The integrator of sustained contact: a step of it, and its end."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.automaton import Event, flow, project
from cointoss.analytic.contact.contact import Contact
from cointoss.analytic.contact.landing import landing, time_to_landing
from cointoss.analytic.flight.integrated_flight import first_step
from cointoss.analytic.flight.runge_kutta import end_point, stage_point, step_error, step_factor
from cointoss.analytic.flight.state_vector import STATE_SIZE, normalise
from cointoss.analytic.numerics.roots import bracket_between, is_narrow, narrowed, next_try
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

# The end of a contact is bracketed to this part of a step, or where its margin is no more than rounding, in
# at most so many tries.
_END, _ROUNDING, _MOST_TRIES = 0.5**50, 1e-16, 150
# A state within this part of a step from one that is known is found by a step of order 2.
_SHORT = 1e-4
# A step goes on by this part beyond the time at which a landing is in sight, and is not short for it alone.
_BEYOND, _NOT_SHORT = 1.1, 1e-6
# A step shorter than this part of one that is short against the coin's motion is none.
_NO_STEP = 1e-30
# The largest step of contact, in units of one that is short against the coin's motion.
_LONGEST = 4


class Step(NamedTuple):
    """A step of a contact that was made."""

    elapsed: float
    """How long it took [s]."""
    next_dt: float
    """A length for the next [s]."""
    is_over: bool
    """Whether the mode came to its end."""
    event: Event
    """Of a landing, or of a step that has no solution; else `NONE`."""


@compiled
def contact_work(contact: Contact, y: Array) -> Array:
    """Return the work space of a contact that starts in the state y, (13,).

    Its first row holds the rate of change at y, its last one that at the end of a step, (13, 13).
    """
    stages = np.empty((STAGES + 1, STATE_SIZE))
    flow(contact, y, stages[0])
    return stages


@compiled
def step_of_length(contact: Contact, y: Array, dt: float, stages: Array, y_new: Array) -> float:
    """Advance the state by one step in contact, and project it onto the floor.

    Args:
        contact: the contact.
        y: state at the start, (13,).
        dt: length of the step [s].
        stages: see `contact_work`.
        y_new: where the state at the end goes, (13,).

    Returns:
        The least margin of the mode at the stages between.
    """
    inside = np.inf
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        inside = min(inside, flow(contact, y_new, stages[stage]))
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    project(contact, y_new)
    return inside


@compiled
def short_step(contact: Contact, y: Array, slope: Array, dt: float, y_new: Array) -> None:
    """Advance the state by a step so short that one of order 2 does, and project it onto the floor.

    Args as `step_of_length`'s, but that `slope`, (13,), is the rate of change at y, and dt may be negative.
    """
    halfway = np.empty(STATE_SIZE)
    for i in range(STATE_SIZE):
        y_new[i] = y[i] + dt / 2 * slope[i]
    flow(contact, y_new, halfway)
    for i in range(STATE_SIZE):
        y_new[i] = y[i] + dt * halfway[i]
    normalise(y_new)
    project(contact, y_new)


@compiled
def accepted_step(
    contact: Contact, y: Array, dt: float, tolerance: float, stages: Array, y_new: Array
) -> tuple[float, float]:
    """Advance the state by a contact step whose error is within the tolerance, at most dt long.

    Lest an end of the contact is passed by, a step is short against the coin's motion, or at all its stages
    the mode goes on.

    Args:
        contact: the contact.
        y: state at the start, (13,).
        dt: length to try first [s].
        tolerance: error allowed in the step, relative to the scales of the coin.
        stages: see `contact_work`.
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, 0 where none is short enough, and a length for the next [s].
    """
    short = 8 * first_step(contact.body, y)
    ahead = _BEYOND * time_to_landing(contact, y, stages[0])
    dt = min(_LONGEST * short, dt, max(ahead, _NOT_SHORT * short))
    while True:
        inside = step_of_length(contact, y, dt, stages, y_new)
        error = step_error(contact.body, y, dt, stages) / tolerance
        if error <= 1 and (dt <= short or inside > 0):
            return dt, dt * step_factor(error)
        dt = max(short, dt / 2) if error <= 1 else dt * step_factor(error)
        if not dt > _NO_STEP * short:
            return 0.0, short


@compiled
def step_contact(contact: Contact, y: Array, dt: float, tolerance: float, stages: Array) -> Step:
    """Advance the state by one step in contact, or to the end of the mode.

    Args:
        contact: the contact, its rim that of y.
        y: state, (13,); advanced.
        dt: length of the step to try first [s]; infinite at the start of a contact.
        tolerance: error allowed in a step, relative to the scales of the coin.
        stages: see `contact_work`; kept up.
    """
    y_new = np.empty(STATE_SIZE)
    high, dt = accepted_step(contact, y, dt, tolerance, stages, y_new)
    if high == 0:
        return Step(high, dt, True, Event.NO_SOLUTION)
    if flow(contact, y_new, stages[STAGES]) > 0:
        copy_into(y, y_new)
        copy_into(stages[0], stages[STAGES])
        return Step(high, dt, False, Event.NONE)
    before = np.empty(STATE_SIZE)
    low, high = _bracket_end(contact, y, high, stages, before, y_new)
    event = landing(contact, y_new)
    if event == Event.NONE:
        copy_into(y, y_new)
        return Step(high, dt, True, event)
    # The other rim point is still to land: its velocity is that before the crossing.
    copy_into(y, before)
    if event == Event.FACE_LANDS and low == 0:
        event = Event.FALLS_FLAT
    return Step(low, dt, True, event)


@compiled
def _bracket_end(
    contact: Contact, y: Array, longest: float, stages: Array, before: Array, after: Array
) -> tuple[float, float]:
    """Bracket the end of a contact in a step, to the part `_END` of it.

    Args:
        contact: the contact.
        y: state at the start of the step, (13,).
        longest: its length [s].
        stages: of the step, see `contact_work`.
        before: where the last state found in which the contact goes on goes, (13,).
        after: state at the end of the step, where it does not, (13,); the first such state found.

    Returns:
        The lengths of steps to both states [s].
    """
    at_end = flow(contact, after, stages[STAGES])
    at_start = flow(contact, y, stages[0])
    copy_into(before, y)
    if not at_start > 0:
        short_step(contact, y, stages[0], longest * _END, after)
        return 0.0, longest * _END
    tolerance = longest * max(_END, min(_ROUNDING / (at_start - at_end), 1e-3))
    bracket = bracket_between(0.0, at_start, longest, at_end)
    near, near_time, slope, y_new = after.copy(), longest, stages[STAGES].copy(), np.empty(STATE_SIZE)
    for _ in range(_MOST_TRIES):
        tried = next_try(bracket)
        is_short = abs(tried - near_time) <= _SHORT * longest
        if is_short:
            short_step(contact, near, slope, tried - near_time, y_new)
        else:
            step_of_length(contact, y, tried, stages, y_new)
        left = flow(contact, y_new, stages[STAGES])
        if not is_short:
            near_time = tried
            copy_into(near, y_new)
            copy_into(slope, stages[STAGES])
        copy_into(before if left > 0 else after, y_new)
        bracket = narrowed(bracket, tried, left, tolerance)
        if is_narrow(bracket, tolerance):
            break
    return bracket.low, bracket.high
