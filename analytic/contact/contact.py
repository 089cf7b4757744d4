"""A coin that stays in contact with the floor: it slides, creeps, sticks and rolls, or stays upright."""

import math
from enum import IntEnum

import numpy as np

from analytic.contact.floor_force import (
    SLOW,
    Motion,
    contact,
    direction_of,
    force,
    give_impulse,
    holding_force,
    holds,
    side_of,
    sliding_force,
    slip_direction,
)
from analytic.contact.upright import put_upright, rim_forces, tip_over, upright_rate
from analytic.flight.equations_of_motion import (
    STATE_SIZE,
    TOLERANCE,
    attitude_of,
    derivative,
    first_step,
    normalise,
    step_error,
)
from analytic.impact.coulomb import coulomb
from analytic.impact.laws import spin_gained
from analytic.numerics.runge_kutta import STAGES, end_point, stage_point, step_factor
from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import dot, subtract
from models.laws import ContactLaw, RestitutionKind


class Verdict(IntEnum):
    """How a contact goes on after a step."""

    GOES_ON = 0
    CHANGES = 1
    """It starts or stops to slip, or lifts off."""
    LANDS = 2
    """Another rim point touches: of the other face's rim, or opposite on this one."""


# Below this sine of the tilt the rim turns under the coin too fast to follow: a face lands.
_FACE = 1e-7
# Friction holds a little more than it starts with, or a coin on the border would for ever start and stop.
_HOLD = 1e-6
# In a contact that lasts, a perfectly rough floor is nearly the limit of Coulomb's: it lets go a point that
# it could only hold by pulling.
_ROUGH = 1e4
# The end of a contact is bracketed as tightly as by so many bisections of a step; the most tries that takes.
_HALVINGS, _MOST_TRIES = 50, 150


@compiled
def keeps_contact(law):
    """Tell whether a contact is followed: on a smooth, a Coulomb or a perfectly rough floor."""
    return law == ContactLaw.SMOOTH or law == ContactLaw.COULOMB or law == ContactLaw.PERFECTLY_ROUGH


@compiled
def friction_in_contact(rules):
    """Give the coefficient of friction μ of a contact that lasts: 0 smooth, large perfectly rough."""
    if rules.law == ContactLaw.PERFECTLY_ROUGH:
        return _ROUGH
    return rules.friction if rules.law == ContactLaw.COULOMB else 0.0


@compiled
def contact_rate(body, mu, motion, side, y, dy):
    """Write the rate of change of the state y of a coin in contact into dy; both (13,)."""
    if motion == Motion.UPRIGHT:
        upright_rate(body, mu, y, dy)
        return
    derivative(body, y, dy)
    R, arm, K, b, v_A = contact(body, y, dy, side)
    F = force(K, b, v_A, mu, motion)
    turned = spin_gained(body, R, arm, F)
    for i in range(3):
        dy[3 + i] += F[i] / body.mass
        dy[10 + i] += turned[i]


@compiled
def contact_step(body, mu, motion, side, y, dt, stages, y_new):
    """Advance the state by one step in contact, and put it back on the floor.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        side: of the rim that is in contact.
        y: state at the start, (13,); the first row of `stages` must hold its rate of change.
        dt: length of the step [s].
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).
    """
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        contact_rate(body, mu, motion, side, y_new, stages[stage])
    end_point(y, dt, stages, y_new)
    normalise(y_new)
    put_on_floor(body, mu, motion, side, y_new)


@compiled
def put_on_floor(body, mu, motion, side, y):
    """Bring the lowest point to the floor, and an impulse there its velocity to what the motion allows.

    A point that sticks has none; one that slides none upward; one that creeps moves in the direction in
    which its slip grows.
    """
    if motion == Motion.UPRIGHT:
        put_upright(body, y)
        return
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    R, arm, K, b, v_A = contact(body, y, dy, side)
    y[2] = -arm[2]
    if motion == Motion.STICKING:
        S = holding_force(K, v_A)
    elif motion == Motion.CREEPING:
        s = slip_direction(K, b, mu)
        speed = math.hypot(v_A[0], v_A[1]) if v_A[0] * s[0] + v_A[1] * s[1] > 0 else 0.0
        S = holding_force(K, subtract(v_A, (speed * s[0], speed * s[1], 0.0)))
    else:
        S = sliding_force(K, v_A, mu, direction_of(v_A, mu))
    give_impulse(body, R, arm, S, y)


@compiled
def margin(body, mu, motion, side, y):
    """Tell how far a contact is from its end: positive in it, 0 or below past it.

    It ends when the floor would have to pull, when slip stops or is no longer slow, when friction can't hold
    a point that sticks, or holds one that creeps, when the coin comes upon its edge, so that the other rim
    lands, or upon a face.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        side: of the rim that is in contact.
        y: state, (13,).
    """
    if motion == Motion.UPRIGHT:
        return min(rim_forces(body, mu, y)) / (body.mass * body.gravity)
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    R, _, K, b, v_A = contact(body, y, dy, side)
    up, weight = R[2], body.mass * body.gravity
    slip = math.hypot(v_A[0], v_A[1]) / (body.gravity * body.radius) ** 0.5
    F = force(K, b, v_A, mu, motion)
    left = min(F[2] / weight, math.hypot(up[0], up[1]) / _FACE - 1)
    if body.thickness > 0:
        left = min(left, side * up[2])
    if motion == Motion.STICKING:
        return min(left, (mu * F[2] * (1 + _HOLD) - math.hypot(F[0], F[1])) / weight)
    # Where friction would press a point down that free flight lifts, it lifts off (Painlevé).
    left = min(left, -b[2] / body.gravity)
    if motion == Motion.CREEPING:
        return min(left, SLOW - slip) if not holds(mu, holding_force(K, b)) else 0.0
    return min(left, slip - SLOW / 2) if mu > 0 else left


@compiled
def accepted_contact_step(body, mu, motion, side, y, dt, stages, y_new):
    """Advance the state by a contact step whose error is within `TOLERANCE`, at most dt long.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        side: of the rim that is in contact.
        y: state at the start, (13,).
        dt: length to try first [s]; the coin's motion bounds it too, lest an end of the contact is passed by.
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made, and a length for the next [s].
    """
    contact_rate(body, mu, motion, side, y, stages[0])
    dt = min(8 * first_step(body, y), dt)
    while True:
        contact_step(body, mu, motion, side, y, dt, stages, y_new)
        error = step_error(body, y, dt, stages) / TOLERANCE
        if error <= 1:
            return dt, dt * step_factor(error)
        dt *= step_factor(error)
        if dt == 0:
            raise FloatingPointError("the contact leaves the range of floating-point numbers")


@compiled
def stay(body, mu, motion, y, dt):
    """Follow a contact for one step of the integrator, or to its end.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        y: state, (13,); advanced.
        dt: length of the step to try first [s]; infinite at the start of a contact.

    Returns:
        The time gone by, a length for the next step [s], and the `Verdict` on what comes next.
    """
    stages, y_new = np.empty((STAGES, STATE_SIZE)), np.empty(STATE_SIZE)
    side = side_of(y)
    high, dt = accepted_contact_step(body, mu, motion, side, y, dt, stages, y_new)
    if margin(body, mu, motion, side, y_new) > 0:
        y[:] = y_new
        return high, dt, Verdict.GOES_ON
    low, high = _bracket_end(body, mu, motion, side, y, high, stages, y_new)
    contact_step(body, mu, motion, side, y, high, stages, y_new)
    up_new = rotation_matrix(attitude_of(y_new))[2]
    onto_edge = body.thickness > 0 and motion != Motion.UPRIGHT and side * up_new[2] <= 0
    if onto_edge or math.hypot(up_new[0], up_new[1]) <= _FACE:
        # The other rim point is still to land: its velocity is that before the crossing.
        contact_step(body, mu, motion, side, y, low, stages, y_new)
        y[:] = y_new
        return low, dt, Verdict.LANDS
    y[:] = y_new
    return high, dt, Verdict.CHANGES


@compiled
def _bracket_end(body, mu, motion, side, y, longest, stages, y_new):
    """Bracket the end of a contact in a step, as tightly as `_HALVINGS` bisections of it would.

    By Chandrupatla's method (Adv. Eng. Softw. 28 (1997) 145).

    Args as `contact_step`'s, where at the end y_new of the step, `longest` [s], the contact is over.

    Returns:
        A length of the step at whose end the contact goes on, and one at which it does not [s].
    """
    low, high, tolerance = 0.0, longest, longest * 0.5**_HALVINGS
    old, old_value = low, margin(body, mu, motion, side, y)
    if not old_value > 0:
        return low, tolerance
    new, new_value, share = high, margin(body, mu, motion, side, y_new), 0.5
    for _ in range(_MOST_TRIES):
        tried = new + share * (old - new)
        contact_step(body, mu, motion, side, y, tried, stages, y_new)
        value = margin(body, mu, motion, side, y_new)
        if value > 0:
            low = tried
        else:
            high = tried
        # Of the three last lengths `new` and `old` bracket the end, `new` the one just tried.
        if (value > 0) == (new_value > 0):
            left, left_value = new, new_value
        else:
            left, left_value, old, old_value = old, old_value, new, new_value
        new, new_value = tried, value
        least = tolerance / (high - low)
        if least > 0.5:
            break
        share = min(max(_zero_between(new, new_value, old, old_value, left, left_value), least), 1 - least)
    return low, high


@compiled
def _zero_between(x_1, f_1, x_2, f_2, x_3, f_3):
    """Give the part of the way from x_1 to x_2 where the inverse parabola through all three passes zero.

    A half where that parabola would not be one-valued between them.
    """
    place, height = (x_1 - x_2) / (x_3 - x_2), (f_1 - f_2) / (f_3 - f_2)
    if not (height * height < place and (1 - height) * (1 - height) < 1 - place):
        return 0.5
    return f_1 / (f_2 - f_1) * f_3 / (f_2 - f_3) + (x_3 - x_1) / (x_2 - x_1) * f_1 / (f_3 - f_1) * f_2 / (
        f_3 - f_2
    )


@compiled
def next_motion(body, mu, motion, y):
    """Tell how a coin goes on whose lowest point is on the floor with v_Az = 0; stop slip where A sticks.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` up to here.
        y: state, (13,).
    """
    if motion == Motion.UPRIGHT:
        tip_over(body, mu, y)
    side, dy = side_of(y), np.empty(STATE_SIZE)
    derivative(body, y, dy)
    R, arm, K, b, v_A = contact(body, y, dy, side)
    if b[2] >= 0:
        return Motion.FLIGHT
    if mu == 0:
        return Motion.SLIDING
    slow = SLOW * (body.gravity * body.radius) ** 0.5
    # A motion that ends at its bound must not go on for rounding.
    least = (1 + _HOLD) * slow / 2 if motion == Motion.SLIDING else (1 - _HOLD) * slow
    if math.hypot(v_A[0], v_A[1]) > least:
        s = direction_of(v_A, mu)
        if dot(K[2], (-mu * s[0], -mu * s[1], 1.0)) > 0:
            return Motion.SLIDING
        # Painlevé: sliding presses the coin into the floor, until an impact without approach stops the slip.
        S = coulomb(K, (v_A[0], v_A[1], -1e-6 * slow), 0.0, mu, RestitutionKind.KINEMATIC)
        give_impulse(body, R, arm, S, y)
    going_on = Motion.STICKING if holds(mu, holding_force(K, b)) else Motion.CREEPING
    put_on_floor(body, mu, going_on, side, y)
    return going_on


@compiled
def sample_contact(body, mu, motion, start, start_time, times, states):
    """Write the states of one contact at `times` into `states`.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        start: state at the start of the contact, (13,).
        start_time: its time [s].
        times: increasing, none before start_time, (n,) [s].
        states: where they go, (n, 13).
    """
    stages, y, y_new = np.empty((STAGES, STATE_SIZE)), start.copy(), np.empty(STATE_SIZE)
    elapsed, side = 0.0, side_of(start)
    made, dt = accepted_contact_step(body, mu, motion, side, y, np.inf, stages, y_new)
    for i in range(len(times)):
        # The steps are those of `stay`: a time between them changes none.
        while times[i] - start_time > elapsed + made:
            elapsed += made
            y[:] = y_new
            made, dt = accepted_contact_step(body, mu, motion, side, y, dt, stages, y_new)
        contact_rate(body, mu, motion, side, y, stages[0])
        contact_step(body, mu, motion, side, y, times[i] - start_time - elapsed, stages, states[i])
