"""The integrator of sustained contact: a step of it, and its end."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.automaton import Event, Mode, flow, inlined_flow, project
from cointoss.analytic.contact.contact import BOTH_RIMS, SustainedContact
from cointoss.analytic.contact.landing import landing, time_to_landing
from cointoss.analytic.contact.rim_contact import lean_and_rate, tilt_time
from cointoss.analytic.contact.sliding import slip_time
from cointoss.analytic.flight.integrated_flight import first_step
from cointoss.analytic.flight.runge_kutta import end_point, stage_point, step_error, step_factor
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, normalise
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import FACE_SINE, tilt_sine_of
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.roots import Bracket, bracket_between, is_narrow, narrowed, next_try
from cointoss.models.records import Array

# The end of a contact is bracketed to this part of a step, or where its margin is no more than rounding, in
# at most so many tries.
_END, _ROUNDING, _MOST_TRIES = 0.5**50, 1e-16, 150
# A state within this part of a step from one that is known is found by a step of order 4.
_SHORT = 1e-2
# A step goes on by this part beyond the time at which a landing is in sight, and is not short for it alone.
_BEYOND, _NOT_SHORT = 1.1, 1e-6
# Below this part of a step that is short against the coin's motion, a step counts as failed.
_NO_STEP = 1e-30
# The largest step of contact, in units of one that is short against the coin's motion.
_LONGEST = 4
# The first step of a mode, against the times in which its rates change: see `tilt_time` and `slip_time`.
_FIRST, _FIRST_OF_SLIP = 0.3, 0.15
# Lengths of steps are said to go on changing by a factor within these bounds.
_LEAST_TREND, _MOST_TREND = 0.5, 1.5
# The next step is this part of the expected length, so that its error is as small as without the guess.
_CAUTION = 0.94
# The end of a mode is first sought on the cubic through both ends of a step, to this part of it.
_CUBIC = 1e-4
# A coin that turns back before its edge within a step may have passed it where its least lean, on the cubic
# through both ends, is below this part of theirs. That turn is found to a small part of the step.
_NEAR_EDGE, _TURN = 0.1, 1e-7
END_ROW = STAGES
"""The row after those of the stages: the rate of change at the end of a step."""
NEW_ROW = STAGES + 1
"""The row after that: the state there."""
# The length that suited the last step.
_LENGTH_ROW, ROWS = STAGES + 2, STAGES + 3


class ContactStep(NamedTuple):
    """A step of a contact that was made."""

    elapsed: float
    """The time that the step took [s]."""
    next_dt: float
    """A length for the next [s]."""
    is_over: bool
    """Whether the mode came to its end."""
    event: Event
    """The event of a landing, or of a step that has no solution; else `NONE`."""


@compiled
def contact_work(contact: SustainedContact, y: Array) -> Array:
    """Return the work space of a contact that starts in the state y, (13,).

    Its first row holds the rate of change at y, (15, 13).
    """
    stages = np.empty((ROWS, STATE_SIZE))
    start_contact(contact, y, stages)
    return stages


@compiled
def start_contact(contact: SustainedContact, y: Array, stages: Array) -> None:
    """Write what the work space of a contact holds at the state y, (13,), in which it starts."""
    flow(contact, y, stages[0])
    stages[_LENGTH_ROW, 0] = 0.0


@compiled
def step_of_length(contact: SustainedContact, y: Array, dt: float, stages: Array, y_new: Array) -> float:
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
        inside = min(inside, inlined_flow(contact, y_new, stages[stage]))
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    project(contact, y_new)
    return inside


@compiled
def short_step(contact: SustainedContact, y: Array, slope: Array, dt: float, y_new: Array) -> None:
    """Advance the state by a step so short that one of order 4 does, and project it onto the floor.

    The classical Runge-Kutta method. Args as `step_of_length`'s, but that `slope`, (13,), is the rate of
    change at y, and dt may be negative.
    """
    rate, total = slope.copy(), slope.copy()
    for part, weight in ((0.5, 2.0), (0.5, 2.0), (1.0, 1.0)):
        for i in range(STATE_SIZE):
            y_new[i] = y[i] + part * dt * rate[i]
        flow(contact, y_new, rate)
        for i in range(STATE_SIZE):
            total[i] += weight * rate[i]
    for i in range(STATE_SIZE):
        y_new[i] = y[i] + dt / 6 * total[i]
    normalise(y_new)
    project(contact, y_new)


@compiled
def first_length(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return the length of a mode's first step to try [s], infinite where nothing is known of it.

    The lowest point of a rim runs round it, and friction turns with the slip: a step is short against the
    time in which either changes. A coin that rises from a face has no tilt yet, and its step must reach one.

    Args:
        contact: the contact.
        y: state at the start, (13,).
        dy: its rate of change, (13,).
    """
    if contact.mode == Mode.UPRIGHT or tilt_sine_of(rotation_matrix(attitude_of(y))[2]) <= FACE_SINE:
        return np.inf
    length = _FIRST * tilt_time(y)
    if contact.mode == Mode.SLIDING and contact.friction.sliding > 0:
        return min(length, _FIRST_OF_SLIP * slip_time(contact, y, dy))
    return length


@compiled
def accepted_step(
    contact: SustainedContact, y: Array, dt: float, tolerance: float, stages: Array, y_new: Array
) -> tuple[float, float, float]:
    """Advance the state by a contact step whose error is within the tolerance, at most dt long.

    Lest an end of the contact is passed by, a step is short against the coin's motion, or at all its stages
    the mode goes on.

    Args:
        contact: the contact.
        y: state at the start, (13,).
        dt: length to try first [s].
        tolerance: error allowed in the step, relative to the scales of the coin.
        stages: see `contact_work`; its row of the end is written too.
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, 0 where none is short enough; a length for the next [s]; and the margin
        at the end.
    """
    dt, short = length_to_try(contact, y, dt, stages)
    while True:
        inside = step_of_length(contact, y, dt, stages, y_new)
        error = step_error(contact.body, y, dt, stages) / tolerance
        if is_accepted(error, dt, short, inside):
            return dt, next_length(dt, error, stages), inlined_flow(contact, y_new, stages[END_ROW])
        dt = max(short, dt / 2) if error <= 1 else dt * step_factor(error)
        if not dt > _NO_STEP * short:
            return 0.0, short, 0.0


@compiled
def length_to_try(contact: SustainedContact, y: Array, dt: float, stages: Array) -> tuple[float, float]:
    """Return the length of a step to try first, and a length that is short against the coin's motion [s].

    Args as `accepted_step`'s.
    """
    short = 8 * first_step(contact.body, y)
    ahead = _BEYOND * time_to_landing(contact, y, stages[0])
    dt = min(_LONGEST * short, dt, max(ahead, _NOT_SHORT * short))
    if stages[_LENGTH_ROW, 0] == 0:
        dt = min(dt, first_length(contact, y, stages[0]))
    return dt, short


@compiled
def is_accepted(error: float, dt: float, short: float, inside: float) -> bool:
    """Return whether a step of length dt is accepted, by its error over that allowed and its least margin."""
    return error <= 1 and (dt <= short or inside > 0)


@compiled
def next_length(dt: float, error: float, stages: Array) -> float:
    """Return a length for the step after one of length dt [s] with an error, over that allowed."""
    suited, last = dt * step_factor(error), stages[_LENGTH_ROW, 0]
    stages[_LENGTH_ROW, 0] = suited
    # The suitable length is extrapolated from its last change.
    trend = min(max(suited / last, _LEAST_TREND), _MOST_TREND) if last > 0 else 1.0
    return _CAUTION * suited * trend


@compiled
def step_contact(
    contact: SustainedContact, y: Array, dt: float, tolerance: float, stages: Array
) -> ContactStep:
    """Advance the state by one step in contact, or to the end of the mode.

    Args:
        contact: the contact, its rim that of y.
        y: state, (13,); advanced.
        dt: length of the step to try first [s]; infinite at the start of a contact.
        tolerance: error allowed in a step, relative to the scales of the coin.
        stages: see `contact_work`; kept up.
    """
    made, dt, left = accepted_step(contact, y, dt, tolerance, stages, stages[NEW_ROW])
    if made == 0:
        return ContactStep(made, dt, True, Event.NO_SOLUTION)
    return ended_step(contact, y, made, dt, left, tolerance, stages)


@compiled
def ended_step(
    contact: SustainedContact,
    y: Array,
    high: float,
    dt: float,
    left: float,
    tolerance: float,
    stages: Array,
) -> ContactStep:
    """Advance the state by a step that is accepted, or to the end of the mode within it.

    Args:
        contact: the contact, its rim that of y.
        y: state, (13,); advanced.
        high: the length of the step [s].
        dt: that of the next to try [s].
        left: the margin at the end.
        tolerance: error allowed in a step, relative to the scales of the coin.
        stages: of the step, the rates at its start and its end and the state there; kept up.
    """
    y_new = stages[NEW_ROW]
    if left > 0:
        high, left = _shortened_to_landing(contact, y, high, left, tolerance, stages)
    if left > 0:
        copy_into(y, y_new)
        copy_into(stages[0], stages[END_ROW])
        return ContactStep(high, dt, False, Event.NONE)
    before = np.empty(STATE_SIZE)
    low, high = _bracket_end(contact, y, high, left, stages, before, y_new)
    event = landing(contact, y_new)
    if event == Event.NONE:
        copy_into(y, y_new)
        return ContactStep(high, dt, True, event)
    # The other rim point is still to land: its velocity is that before the crossing.
    copy_into(y, before)
    if event == Event.FACE_LANDS and low == 0:
        event = Event.FALLS_FLAT
    return ContactStep(low, dt, True, event)


@compiled
def _shortened_to_landing(
    contact: SustainedContact, y: Array, dt: float, left: float, tolerance: float, stages: Array
) -> tuple[float, float]:
    """Shorten a step in which the other rim lands and would rise again to one that ends in between.

    Args:
        contact: the contact.
        y: state at the start of the step, (13,).
        dt: its length [s].
        left: the margin at its end, > 0.
        tolerance: error allowed in a step, relative: a rim that is deeper in the floor lands.
        stages: of the step; become those of the shorter one.

    Returns:
        The length of the step [s], and the margin at its end; both as given where no rim lands.
    """
    body, y_new = contact.body, stages[NEW_ROW]
    if contact.rim == BOTH_RIMS or body.thickness == 0:
        return dt, left
    (lean, fall), (lean_new, fall_new) = _lean_and_fall(contact, y), _lean_and_fall(contact, y_new)
    if not (fall > 0 and fall_new < 0):
        return dt, left
    share = fall / (fall - fall_new)
    rest = 1 - share
    least = lean * rest * rest * (1 + 2 * share) + lean_new * share * share * (3 - 2 * share)
    least -= dt * share * rest * (fall * rest - fall_new * share)
    if least > _NEAR_EDGE * max(lean, lean_new):
        return dt, left
    inner, bracket = stages.copy(), bracket_between(0.0, fall, dt, fall_new)
    while not is_narrow(bracket, _TURN * dt):
        tried = next_try(bracket)
        step_of_length(contact, y, tried, inner, inner[NEW_ROW])
        lean, fall = _lean_and_fall(contact, inner[NEW_ROW])
        if lean * body.thickness < -tolerance * body.radius:
            step_of_length(contact, y, tried, stages, y_new)
            return tried, flow(contact, y_new, stages[END_ROW])
        bracket = narrowed(bracket, tried, fall, _TURN * dt)
    return dt, left


@compiled
def _lean_and_fall(contact: SustainedContact, y: Array) -> tuple[float, float]:
    """Return the lean of a coin in the state y, (13,), < 0 past the edge, and how fast it falls [1/s]."""
    n_z, rate = lean_and_rate(y)
    return -contact.rim * n_z, contact.rim * rate


@compiled
def _bracket_end(
    contact: SustainedContact,
    y: Array,
    longest: float,
    at_end: float,
    stages: Array,
    before: Array,
    after: Array,
) -> tuple[float, float]:
    """Bracket the end of a contact in a step, to the part `_END` of it.

    Args:
        contact: the contact.
        y: state at the start of the step, (13,).
        longest: its length [s].
        at_end: the margin at its end.
        stages: of the step, with the rate of change at its end; see `contact_work`.
        before: where the last state found in which the contact goes on goes, (13,).
        after: state at the end of the step, where it does not, (13,); the first such state found.

    Returns:
        The lengths of steps to both states [s].
    """
    at_start = flow(contact, y, stages[0])
    copy_into(before, y)
    if not at_start > 0:
        short_step(contact, y, stages[0], longest * _END, after)
        return 0.0, longest * _END
    tolerance = longest * max(_END, min(_ROUNDING / (at_start - at_end), 1e-3))
    near, near_time, slope, y_new = after.copy(), longest, stages[END_ROW].copy(), np.empty(STATE_SIZE)
    share = _end_on_cubic(contact, y, longest, at_start, at_end, stages, after, y_new)
    bracket = Bracket(0.0, longest, longest, at_end, 0.0, at_start, 1 - share)
    for _ in range(_MOST_TRIES):
        tried = next_try(bracket)
        is_short = abs(tried - near_time) <= _SHORT * longest
        if is_short:
            short_step(contact, near, slope, tried - near_time, y_new)
        else:
            step_of_length(contact, y, tried, stages, y_new)
        left = flow(contact, y_new, stages[END_ROW])
        if not is_short:
            near_time = tried
            copy_into(near, y_new)
            copy_into(slope, stages[END_ROW])
        copy_into(before if left > 0 else after, y_new)
        bracket = narrowed(bracket, tried, left, tolerance)
        if is_narrow(bracket, tolerance):
            break
    return bracket.low, bracket.high


@compiled
def _end_on_cubic(
    contact: SustainedContact,
    y: Array,
    dt: float,
    at_start: float,
    at_end: float,
    stages: Array,
    y_end: Array,
    between: Array,
) -> float:
    """Return the part of a step after which its margin is zero on the cubic through both of its ends.

    Args:
        contact: the contact.
        y: state at the start, (13,).
        dt: length of the step [s].
        at_start: the margin there, > 0.
        at_end: the margin at the end, not > 0.
        stages: see `contact_work`.
        y_end: state at the end, (13,).
        between: work space, (13,).
    """
    rate, bracket = np.empty(STATE_SIZE), bracket_between(0.0, at_start, 1.0, at_end)
    for _ in range(_MOST_TRIES):
        tried = next_try(bracket)
        left = 1 - tried
        by_start, by_end = dt * tried * left * left, dt * tried * tried * left
        of_end = tried * tried * (3 - 2 * tried)
        for i in range(STATE_SIZE):
            chord = y[i] + of_end * (y_end[i] - y[i])
            between[i] = chord + (by_start * stages[0, i] - by_end * stages[END_ROW, i])
        bracket = narrowed(bracket, tried, flow(contact, between, rate), _CUBIC)
        if is_narrow(bracket, _CUBIC):
            break
    return next_try(bracket)
