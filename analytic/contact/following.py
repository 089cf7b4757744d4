"""Sustained contact followed step by step: its integration, its end, and the states between."""

import numpy as np

from cointoss.analytic.automaton import Event, Mode
from cointoss.analytic.contact import modes, one_rim, smooth, upright
from cointoss.analytic.contact.one_rim import lay_flat, lower_rim_of
from cointoss.analytic.contact.resistance import FloorFriction, is_smooth
from cointoss.analytic.flight.integrated_flight import first_step
from cointoss.analytic.flight.runge_kutta import end_point, stage_point, step_error, step_factor
from cointoss.analytic.flight.state_vector import STATE_SIZE, normalise
from cointoss.analytic.numerics.roots import bracket_between, is_narrow, narrowed, next_try
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.laws import ContactLaw

# In sustained contact a perfectly rough floor is nearly the limit of Coulomb's: it lets go a point that it
# could only hold by pulling.
_ROUGH = 1e4
# The end of a contact is bracketed to this part of a step, or where its margin is no more than rounding, in
# at most so many tries.
_END, _ROUNDING, _MOST_TRIES = 0.5**50, 1e-16, 150
# A state within this part of a step from one that is known is found by a step of order 2.
_SHORT = 1e-4
# A step goes on by this part beyond the time at which a landing is in sight, and is not short for it alone.
_BEYOND, _NOT_SHORT = 1.1, 1e-6
# A step shorter than this part of one that is short against the coin's motion is none.
_NO_STEP = 1e-30
# A step of contact is at most so many times longer than one that is short against the coin's motion.
_LONGEST = 4


@compiled
def is_followed(law):
    """Return whether sustained contact is followed: on a smooth, a Coulomb or a perfectly rough floor."""
    return law == ContactLaw.SMOOTH or law == ContactLaw.COULOMB or law == ContactLaw.PERFECTLY_ROUGH


@compiled
def friction_in_contact(rules):
    """Return the `FloorFriction` of sustained contact: none on slip if smooth, large if perfectly rough."""
    mu = rules.friction if rules.law == ContactLaw.COULOMB else 0.0
    if rules.law == ContactLaw.PERFECTLY_ROUGH:
        mu = _ROUGH
    return FloorFriction(mu, rules.rolling_friction, rules.pivoting_friction)


@compiled
def start_following(body, friction, mode, y):
    """Return the work space of a contact that starts in the state y, (13,); for the others see `modes.rate`.

    Its first row holds the rate of change at y, its last one that at the end of a step, (13, 13).
    """
    stages = np.empty((STAGES + 1, STATE_SIZE))
    modes.rate(body, friction, mode, lower_rim_of(y), y, stages[0])
    return stages


@compiled
def contact_step(body, friction, mode, rim, y, dt, stages, y_new):
    """Advance the state by one step in contact, and put it back on the floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        rim: the lower one.
        y: state at the start, (13,).
        dt: length of the step [s].
        stages: see `start_following`.
        y_new: where the state at the end goes, (13,).

    Returns:
        The least margin of the mode at the stages between.
    """
    inside = _slopes(body, friction, mode, rim, y, dt, stages, y_new)
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    modes.put_on_floor(body, friction, mode, rim, y_new)
    return inside


@compiled
def _slopes(body, friction, mode, rim, y, dt, stages, point):
    """Compute the slopes at the stages of a step, `point` being work space; see `contact_step`.

    Each mode has a loop of its own, in which LLVM keeps what does not change with the state.
    """
    inside = np.inf
    if mode == Mode.UPRIGHT:
        for stage in range(1, STAGES):
            stage_point(y, dt, stages, stage, point)
            inside = min(inside, upright.rate(body, friction, point, stages[stage]))
    elif mode == Mode.STICKING:
        for stage in range(1, STAGES):
            stage_point(y, dt, stages, stage, point)
            inside = min(inside, one_rim.sticking_rate(body, friction, rim, point, stages[stage]))
    elif mode == Mode.CREEPING:
        for stage in range(1, STAGES):
            stage_point(y, dt, stages, stage, point)
            inside = min(inside, one_rim.creeping_rate(body, friction, rim, point, stages[stage]))
    elif is_smooth(friction):
        for stage in range(1, STAGES):
            stage_point(y, dt, stages, stage, point)
            inside = min(inside, smooth.rate(body, rim, point, stages[stage]))
    else:
        for stage in range(1, STAGES):
            stage_point(y, dt, stages, stage, point)
            inside = min(inside, one_rim.sliding_rate(body, friction, rim, point, stages[stage]))
    return inside


@compiled
def short_contact_step(body, friction, mode, rim, y, slope, dt, y_new):
    """Advance the state by a step in contact so short that one of order 2 does, and put it back on the floor.

    Args as `contact_step`'s, but that `slope`, (13,), is the rate of change at y, and dt may be negative.
    """
    halfway = np.empty(STATE_SIZE)
    for i in range(STATE_SIZE):
        y_new[i] = y[i] + dt / 2 * slope[i]
    modes.rate(body, friction, mode, rim, y_new, halfway)
    for i in range(STATE_SIZE):
        y_new[i] = y[i] + dt * halfway[i]
    normalise(y_new)
    modes.put_on_floor(body, friction, mode, rim, y_new)


@compiled
def accepted_contact_step(body, friction, mode, rim, y, dt, tolerance, stages, y_new):
    """Advance the state by a contact step whose error is within the tolerance, at most dt long.

    Lest an end of the contact is passed by, a step is short against the coin's motion, or at all its stages
    the mode goes on.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        rim: the lower one.
        y: state at the start, (13,).
        dt: length to try first [s].
        tolerance: error allowed in the step, relative to the scales of the coin.
        stages: see `start_following`.
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, 0 where none is short enough, and a length for the next [s].
    """
    short = 8 * first_step(body, y)
    landing = _BEYOND * modes.time_to_landing(body, mode, rim, y, stages[0])
    dt = min(_LONGEST * short, dt, max(landing, _NOT_SHORT * short))
    while True:
        inside = contact_step(body, friction, mode, rim, y, dt, stages, y_new)
        error = step_error(body, y, dt, stages) / tolerance
        if error <= 1 and (dt <= short or inside > 0):
            return dt, dt * step_factor(error)
        dt = max(short, dt / 2) if error <= 1 else dt * step_factor(error)
        if not dt > _NO_STEP * short:
            return 0.0, short


@compiled
def follow(body, friction, mode, y, dt, tolerance, stages):
    """Follow a contact for one step of the integrator, or to its end.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,); advanced.
        dt: length of the step to try first [s]; infinite at the start of a contact.
        tolerance: error allowed in a step, relative to the scales of the coin.
        stages: see `start_following`; kept up.

    Returns:
        The elapsed time, a length for the next step [s], whether the contact came to its end, and the event
        of a landing, `Event.NONE` without one, `Event.ENDS` where the motion has no solution.
    """
    y_new, rim = np.empty(STATE_SIZE), lower_rim_of(y)
    high, dt = accepted_contact_step(body, friction, mode, rim, y, dt, tolerance, stages, y_new)
    if high == 0:
        return high, dt, True, Event.ENDS
    if modes.rate(body, friction, mode, rim, y_new, stages[STAGES]) > 0:
        copy_into(y, y_new)
        copy_into(stages[0], stages[STAGES])
        return high, dt, False, Event.NONE
    before = np.empty(STATE_SIZE)
    low, high = _bracket_end(body, friction, mode, rim, y, high, stages, before, y_new)
    landing = modes.landing(body, mode, rim, y_new)
    if landing == Event.NONE:
        copy_into(y, y_new)
        return high, dt, True, landing
    # The other rim point is still to land: its velocity is that before the crossing.
    copy_into(y, before)
    if landing == Event.FACE_LANDS and low == 0:
        lay_flat(body, y)
    return low, dt, True, landing


@compiled
def _bracket_end(body, friction, mode, rim, y, longest, stages, before, after):
    """Bracket the end of a contact in a step, to the part `_END` of it.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        rim: the lower one.
        y: state at the start of the step, (13,).
        longest: its length [s].
        stages: of the step, see `start_following`.
        before: where the last state found in which the contact goes on goes, (13,).
        after: state at the end of the step, where it does not, (13,); the first such state found.

    Returns:
        The lengths of steps to both states [s].
    """
    at_end = modes.rate(body, friction, mode, rim, after, stages[STAGES])
    at_start = modes.rate(body, friction, mode, rim, y, stages[0])
    copy_into(before, y)
    if not at_start > 0:
        short_contact_step(body, friction, mode, rim, y, stages[0], longest * _END, after)
        return 0.0, longest * _END
    tolerance = longest * max(_END, min(_ROUNDING / (at_start - at_end), 1e-3))
    bracket = bracket_between(0.0, at_start, longest, at_end)
    near, near_time, slope, y_new = after.copy(), longest, stages[STAGES].copy(), np.empty(STATE_SIZE)
    for _ in range(_MOST_TRIES):
        tried = next_try(bracket)
        is_short = abs(tried - near_time) <= _SHORT * longest
        if is_short:
            short_contact_step(body, friction, mode, rim, near, slope, tried - near_time, y_new)
        else:
            contact_step(body, friction, mode, rim, y, tried, stages, y_new)
        left = modes.rate(body, friction, mode, rim, y_new, stages[STAGES])
        if not is_short:
            near_time = tried
            copy_into(near, y_new)
            copy_into(slope, stages[STAGES])
        copy_into(before if left > 0 else after, y_new)
        bracket = narrowed(bracket, tried, left, tolerance)
        if is_narrow(bracket, tolerance):
            break
    return bracket.low, bracket.high


@compiled
def sample_contact(body, friction, mode, start, start_time, times, tolerance, states):
    """Write the states of one contact at `times` into `states`.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        start: state at the start of the contact, (13,).
        start_time: its time [s].
        times: increasing, none before start_time, (n,) [s].
        tolerance: error allowed in a step, relative to the scales of the coin.
        states: where they go, (n, 13).
    """
    stages, y, y_new = start_following(body, friction, mode, start), start.copy(), np.empty(STATE_SIZE)
    elapsed, rim = 0.0, lower_rim_of(start)
    made, dt = accepted_contact_step(body, friction, mode, rim, y, np.inf, tolerance, stages, y_new)
    for i in range(len(times)):
        # The steps are those of `follow`: a time between them changes none.
        while made > 0 and times[i] - start_time > elapsed + made:
            elapsed += made
            copy_into(y, y_new)
            modes.rate(body, friction, mode, rim, y, stages[0])
            made, dt = accepted_contact_step(body, friction, mode, rim, y, dt, tolerance, stages, y_new)
        contact_step(body, friction, mode, rim, y, times[i] - start_time - elapsed, stages, states[i])
