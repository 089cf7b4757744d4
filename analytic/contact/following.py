"""Sustained contact followed step by step: its integration, its end, and the states between."""

import numpy as np

from analytic.automaton import Event
from analytic.contact import modes
from analytic.contact.one_rim import lower_rim_of
from analytic.flight.integrated_flight import first_step, step_error
from analytic.flight.state_vector import STATE_SIZE, normalise
from analytic.numerics.roots import bracket_between, is_narrow, narrowed, next_try
from analytic.numerics.runge_kutta import STAGES, end_point, stage_point, step_factor
from analytic.numerics.tolerances import STEP_ERROR
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled
from models.laws import ContactLaw

# In sustained contact a perfectly rough floor is nearly the limit of Coulomb's: it lets go a point that it
# could only hold by pulling.
_ROUGH = 1e4
# The end of a contact is bracketed to this part of a step, in at most so many tries.
_END, _MOST_TRIES = 0.5**50, 150


@compiled
def is_followed(law):
    """Return whether sustained contact is followed: on a smooth, a Coulomb or a perfectly rough floor."""
    return law == ContactLaw.SMOOTH or law == ContactLaw.COULOMB or law == ContactLaw.PERFECTLY_ROUGH


@compiled
def friction_in_contact(rules):
    """Return the coefficient of friction μ of sustained contact: 0 smooth, large perfectly rough."""
    if rules.law == ContactLaw.PERFECTLY_ROUGH:
        return _ROUGH
    return rules.friction if rules.law == ContactLaw.COULOMB else 0.0


@compiled
def contact_step(body, mu, mode, rim, y, dt, stages, y_new):
    """Advance the state by one step in contact, and put it back on the floor.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        mode: number of the `Mode`, in contact.
        rim: the lower one.
        y: state at the start, (13,); the first row of `stages` must hold its rate of change.
        dt: length of the step [s].
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).
    """
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        modes.rate(body, mu, mode, rim, y_new, stages[stage])
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    modes.put_on_floor(body, mu, mode, rim, y_new)


@compiled
def accepted_contact_step(body, mu, mode, rim, y, dt, stages, y_new):
    """Advance the state by a contact step whose error is within `STEP_ERROR`, at most dt long.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        mode: number of the `Mode`, in contact.
        rim: the lower one.
        y: state at the start, (13,).
        dt: length to try first [s]; the coin's motion bounds it too, lest an end of the contact is passed by.
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, and a length for the next [s].
    """
    modes.rate(body, mu, mode, rim, y, stages[0])
    dt = min(8 * first_step(body, y), dt)
    while True:
        contact_step(body, mu, mode, rim, y, dt, stages, y_new)
        error = step_error(body, y, dt, stages) / STEP_ERROR
        if error <= 1:
            return dt, dt * step_factor(error)
        dt *= step_factor(error)
        if not dt > 0:
            raise FloatingPointError("the contact leaves the range of floating-point numbers")


@compiled
def follow(body, mu, mode, y, dt):
    """Follow a contact for one step of the integrator, or to its end.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        mode: number of the `Mode`, in contact.
        y: state, (13,); advanced.
        dt: length of the step to try first [s]; infinite at the start of a contact.

    Returns:
        The elapsed time, a length for the next step [s], whether the contact came to its end, and the event
        of a landing, `Event.NONE` without one.
    """
    stages, y_new = np.empty((STAGES, STATE_SIZE)), np.empty(STATE_SIZE)
    rim = lower_rim_of(y)
    high, dt = accepted_contact_step(body, mu, mode, rim, y, dt, stages, y_new)
    if modes.margin(body, mu, mode, rim, y_new) > 0:
        copy_into(y, y_new)
        return high, dt, False, Event.NONE
    low, high = _bracket_end(body, mu, mode, rim, y, high, stages, y_new)
    contact_step(body, mu, mode, rim, y, high, stages, y_new)
    landing = modes.landing(body, mode, rim, y_new)
    if landing != Event.NONE:
        # The other rim point is still to land: its velocity is that before the crossing.
        contact_step(body, mu, mode, rim, y, low, stages, y_new)
        high = low
    copy_into(y, y_new)
    return high, dt, True, landing


@compiled
def _bracket_end(body, mu, mode, rim, y, longest, stages, y_new):
    """Bracket the end of a contact in a step, to the part `_END` of it.

    Args as `contact_step`'s, where at the end y_new of the step, `longest` [s], the contact is over.

    Returns:
        A length of the step at whose end the contact goes on, and one at which it does not [s].
    """
    tolerance, at_start = longest * _END, modes.margin(body, mu, mode, rim, y)
    if not at_start > 0:
        return 0.0, tolerance
    bracket = bracket_between(0.0, at_start, longest, modes.margin(body, mu, mode, rim, y_new))
    for _ in range(_MOST_TRIES):
        tried = next_try(bracket)
        contact_step(body, mu, mode, rim, y, tried, stages, y_new)
        bracket = narrowed(bracket, tried, modes.margin(body, mu, mode, rim, y_new), tolerance)
        if is_narrow(bracket, tolerance):
            break
    return bracket.low, bracket.high


@compiled
def sample_contact(body, mu, mode, start, start_time, times, states):
    """Write the states of one contact at `times` into `states`.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        mode: number of the `Mode`, in contact.
        start: state at the start of the contact, (13,).
        start_time: its time [s].
        times: increasing, none before start_time, (n,) [s].
        states: where they go, (n, 13).
    """
    stages, y, y_new = np.empty((STAGES, STATE_SIZE)), start.copy(), np.empty(STATE_SIZE)
    elapsed, rim = 0.0, lower_rim_of(start)
    made, dt = accepted_contact_step(body, mu, mode, rim, y, np.inf, stages, y_new)
    for i in range(len(times)):
        # The steps are those of `follow`: a time between them changes none.
        while times[i] - start_time > elapsed + made:
            elapsed += made
            copy_into(y, y_new)
            made, dt = accepted_contact_step(body, mu, mode, rim, y, dt, stages, y_new)
        modes.rate(body, mu, mode, rim, y, stages[0])
        contact_step(body, mu, mode, rim, y, times[i] - start_time - elapsed, stages, states[i])
