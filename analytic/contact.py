"""A coin that stays in contact with the floor at one rim point: it slides, creeps, or sticks and rolls.

The rim point A that is lowest moves round the rim; v_A is the velocity of the coin's matter there. With a
force F at A, dv_A/dt = b + K F, K the mobility of A as in an impact and b what free flight gives. The floor
holds v_Az at 0; where A sticks, it holds all of v_A.
"""

import math
from enum import IntEnum

import numpy as np

from analytic.coulomb import coulomb
from analytic.flight import (
    STATE_SIZE,
    TOLERANCE,
    attitude_of,
    derivative,
    first_step,
    spin_of,
    step_error,
    velocity_of,
)
from analytic.impact import mobility, spin_gained
from analytic.rotation import quaternion_rate
from analytic.runge_kutta import STAGES, end_point, stage_point, step_factor
from models.attitude import rotation_matrix
from models.compiled import compiled
from models.laws import ContactLaw, RestitutionKind
from models.vectors import add, apply, cross, dot, scale, solve, subtract


class Motion(IntEnum):
    """How a coin moves between two events."""

    FLIGHT = 0
    SLIDING = 1
    """In contact; friction acts against the slip."""
    CREEPING = 2
    """In contact; slip starts, or hardly goes on. Its direction, of which friction makes much, is that in
    which it grows."""
    STICKING = 3
    """In contact, without slip."""


class Verdict(IntEnum):
    """How a contact goes on after a step."""

    GOES_ON = 0
    CHANGES = 1
    """It starts or stops to slip, or lifts off."""
    LANDS = 2
    """Another rim point touches: of the other face's rim, or opposite on this one."""


# Below this sine of the tilt the rim turns under the coin too fast to follow: a face lands.
_FACE = 1e-7
# Against √(g r). Slip slower than this is stopped where friction can hold it, and creeps elsewhere: friction
# would turn it in the time of slip/(μ g). Sliding is kept down to half of it.
_CREEP = 1e-3
# Friction holds a little more than it starts with, or a coin on the border would for ever start and stop.
_HOLD = 1e-6
# The angle by which a coin on its edge is tried on either rim.
_TIP = 1e-9
# In so many phases of its roll a coin on its edge is tried.
_PHASES = 48
_HALVINGS = 50
_DIRECTIONS = 24


@compiled
def keeps_contact(law):
    """Tell whether a contact is followed: on a smooth, a Coulomb or a perfectly rough floor."""
    return law == ContactLaw.SMOOTH or law == ContactLaw.COULOMB or law == ContactLaw.PERFECTLY_ROUGH


@compiled
def friction_in_contact(rules):
    """Give the coefficient of friction μ of a contact that lasts: 0 smooth, infinite perfectly rough."""
    if rules.law == ContactLaw.PERFECTLY_ROUGH:
        return np.inf
    return rules.friction if rules.law == ContactLaw.COULOMB else 0.0


@compiled
def contact(body, y, dy, side):
    """Give what the floor's force at the lowest point of a face's rim meets.

    Args:
        body: the coin.
        y: state, (13,), not flat.
        dy: its rate of change in free flight, (13,).
        side: 1 where that face is tails, below a coin with heads up, -1 where it is heads.

    Returns:
        R: rotation matrix, body to space.
        arm: from C to A, space frame, (3,) [m].
        K: mobility of A, space frame [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
        v_A: space frame, (3,) [m/s].
    """
    w, R = spin_of(y), rotation_matrix(attitude_of(y))
    up = R[2]
    up_rate = cross(up, w)
    sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    sine_rate = (up[0] * up_rate[0] + up[1] * up_rate[1]) / sine
    r = body.radius
    a = subtract((-r * up[0] / sine, -r * up[1] / sine, -side * body.thickness / 2), body.center)
    a_rate = (
        -r * (up_rate[0] * sine - up[0] * sine_rate) / (sine * sine),
        -r * (up_rate[1] * sine - up[1] * sine_rate) / (sine * sine),
        0.0,
    )
    turn = cross(w, a)
    turn_rate = add(cross((dy[10], dy[11], dy[12]), a), cross(w, add(turn, a_rate)))
    arm = apply(R, a)
    b = add((dy[3], dy[4], dy[5]), apply(R, turn_rate))
    return R, arm, mobility(body, R, arm), b, add(velocity_of(y), apply(R, turn))


@compiled
def side_of(y):
    """Give the side of the rim that is lowest: 1 with heads up, -1 with tails up."""
    return 1.0 if rotation_matrix(attitude_of(y))[2][2] > 0 else -1.0


@compiled
def force(K, b, v_A, mu, motion):
    """Give the floor's force at A that keeps the contact, space frame, (3,) [N].

    Args:
        K: mobility of A [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
        v_A: space frame, (3,) [m/s].
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
    """
    if motion == Motion.STICKING:
        return holding_force(K, b)
    slip = slip_direction(K, b, mu) if motion == Motion.CREEPING else direction_of(v_A, mu)
    return sliding_force(K, b, mu, slip)


@compiled
def holding_force(K, b):
    """Give the force at A that holds all of v_A, (3,) [N].

    Of v_A in the place of b it gives the impulse that stops A.
    """
    return solve(K, scale(-1.0, b))


@compiled
def sliding_force(K, b, mu, slip):
    """Give the force at A, against a slip in the direction `slip`, (2,), that holds v_Az, (3,) [N].

    Of v_A in the place of b it gives the impulse that stops v_Az.
    """
    direction = (-mu * slip[0], -mu * slip[1], 1.0)
    return scale(-b[2] / dot(K[2], direction), direction)


@compiled
def direction_of(v_A, mu):
    """Give the direction of the slip of A, (2,); none on a smooth floor."""
    speed = math.hypot(v_A[0], v_A[1])
    if mu == 0 or speed == 0:
        return 0.0, 0.0
    return v_A[0] / speed, v_A[1] / speed


@compiled
def holds(mu, F):
    """Tell whether friction holds with the force F at A."""
    return F[2] > 0 and math.hypot(F[0], F[1]) <= mu * F[2]


@compiled
def slip_direction(K, b, mu):
    """Give the direction in which a point starts to slip that friction can't hold, (2,).

    Slip keeps the direction s that its own acceleration has, b_t + N (K_tz - μ K_tt s) = λ s, with the N
    that holds v_Az; against all others friction turns it at once. A Newton iteration for the angle of s,
    from the best of a few angles.
    """
    best, angle = -np.inf, 0.0
    for i in range(_DIRECTIONS):
        tried = 2 * math.pi * i / _DIRECTIONS
        turning, _, growth = _slip_turning(K, b, mu, tried)
        if growth - abs(turning) > best:
            best, angle = growth - abs(turning), tried
    for _ in range(30):
        turning, slope, _ = _slip_turning(K, b, mu, angle)
        change = -turning / slope if slope < 0 else math.copysign(0.1, turning)
        angle += min(max(change, -0.2), 0.2)
        if abs(change) < 1e-14:
            break
    return math.cos(angle), math.sin(angle)


@compiled
def _slip_turning(K, b, mu, angle):
    """Give s × q, its derivative, and s · q for the slip's direction s at this angle.

    q = D a_t, D = K_zz - μ K_zt · s: the acceleration of the slip, cleared of N's denominator.
    """
    s, t = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    D = K[2][2] - mu * (K[2][0] * s[0] + K[2][1] * s[1])
    D_rate = -mu * (K[2][0] * t[0] + K[2][1] * t[1])
    q = (
        D * b[0] - b[2] * (K[0][2] - mu * (K[0][0] * s[0] + K[0][1] * s[1])),
        D * b[1] - b[2] * (K[1][2] - mu * (K[1][0] * s[0] + K[1][1] * s[1])),
    )
    q_rate = (
        D_rate * b[0] + mu * b[2] * (K[0][0] * t[0] + K[0][1] * t[1]),
        D_rate * b[1] + mu * b[2] * (K[1][0] * t[0] + K[1][1] * t[1]),
    )
    turning = s[0] * q[1] - s[1] * q[0]
    slope = t[0] * q[1] - t[1] * q[0] + s[0] * q_rate[1] - s[1] * q_rate[0]
    return turning, slope, s[0] * q[0] + s[1] * q[1]


@compiled
def contact_rate(body, mu, motion, side, y, dy):
    """Write the rate of change of the state y of a coin in contact into dy; both (13,)."""
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
    size = (y_new[6] ** 2 + y_new[7] ** 2 + y_new[8] ** 2 + y_new[9] ** 2) ** 0.5
    for i in range(6, 10):
        y_new[i] /= size
    put_on_floor(body, mu, motion, side, y_new)


@compiled
def put_on_floor(body, mu, motion, side, y):
    """Bring the lowest point to the floor, and an impulse there its velocity to what the motion allows.

    A point that sticks has none; one that slides none upward; one that creeps moves in the direction in
    which its slip grows.
    """
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
    strike(body, R, arm, S, y)


@compiled
def strike(body, R, arm, S, y):
    """Change the velocities of the state y by an impulse S at A, space frame, (3,) [N s]."""
    turned = spin_gained(body, R, arm, S)
    for i in range(3):
        y[3 + i] += S[i] / body.mass
        y[10 + i] += turned[i]


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
    if motion == Motion.CREEPING:
        return min(left, _CREEP - slip) if not holds(mu, holding_force(K, b)) else 0.0
    return min(left, slip - _CREEP / 2) if mu > 0 else left


@compiled
def accepted_contact_step(body, mu, motion, side, y, longest, stages, y_new):
    """Advance the state by a contact step whose error is within `TOLERANCE`.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        side: of the rim that is in contact.
        y: state at the start, (13,).
        longest: the longest step wanted [s].
        stages: work space, (12, 13).
        y_new: where the state at the end goes, (13,).

    Returns:
        The length of the step made [s].
    """
    contact_rate(body, mu, motion, side, y, stages[0])
    dt = min(8 * first_step(body, y), longest)
    while True:
        contact_step(body, mu, motion, side, y, dt, stages, y_new)
        error = step_error(body, y, dt, stages) / TOLERANCE
        if error <= 1:
            return dt
        dt *= step_factor(error)
        if dt == 0:
            raise FloatingPointError("the contact leaves the range of floating-point numbers")


@compiled
def stay(body, mu, motion, y, longest):
    """Follow a contact for one step of the integrator, or to its end.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        motion: `Motion` in contact.
        y: state, (13,); advanced.
        longest: the longest step wanted [s].

    Returns:
        The time gone by [s], and the `Verdict` on what comes next.
    """
    stages, y_new = np.empty((STAGES, STATE_SIZE)), np.empty(STATE_SIZE)
    side = side_of(y)
    high = accepted_contact_step(body, mu, motion, side, y, longest, stages, y_new)
    if margin(body, mu, motion, side, y_new) > 0:
        y[:] = y_new
        return high, Verdict.GOES_ON
    low = 0.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        contact_step(body, mu, motion, side, y, middle, stages, y_new)
        if margin(body, mu, motion, side, y_new) > 0:
            low = middle
        else:
            high = middle
    contact_step(body, mu, motion, side, y, high, stages, y_new)
    up_new = rotation_matrix(attitude_of(y_new))[2]
    if math.hypot(up_new[0], up_new[1]) <= _FACE or (body.thickness > 0 and side * up_new[2] <= 0):
        # The other rim point is still to land: its velocity is that before the crossing.
        contact_step(body, mu, motion, side, y, low, stages, y_new)
        y[:] = y_new
        return low, Verdict.LANDS
    y[:] = y_new
    return high, Verdict.CHANGES


@compiled
def next_motion(body, mu, motion, y):
    """Tell how a coin goes on whose lowest point is on the floor with v_Az = 0; stop slip where A sticks.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` up to here.
        y: state, (13,).
    """
    side, dy = side_of(y), np.empty(STATE_SIZE)
    derivative(body, y, dy)
    R, arm, K, b, v_A = contact(body, y, dy, side)
    if b[2] >= 0:
        return Motion.FLIGHT
    if mu == 0:
        return Motion.SLIDING
    slow = _CREEP * (body.gravity * body.radius) ** 0.5
    # A motion that ends at its bound must not go on for rounding.
    least = (1 + _HOLD) * slow / 2 if motion == Motion.SLIDING else (1 - _HOLD) * slow
    if math.hypot(v_A[0], v_A[1]) > least:
        s = direction_of(v_A, mu)
        if dot(K[2], (-mu * s[0], -mu * s[1], 1.0)) > 0:
            return Motion.SLIDING
        # Painlevé: sliding presses the coin into the floor, until an impact without approach stops the slip.
        S = coulomb(K, (v_A[0], v_A[1], -1e-6 * slow), 0.0, mu, RestitutionKind.KINEMATIC)
        strike(body, R, arm, S, y)
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
    made = accepted_contact_step(body, mu, motion, side, y, np.inf, stages, y_new)
    for i in range(len(times)):
        # The steps are those of `stay`: a time between them changes none.
        while times[i] - start_time > elapsed + made:
            elapsed += made
            y[:] = y_new
            made = accepted_contact_step(body, mu, motion, side, y, np.inf, stages, y_new)
        contact_rate(body, mu, motion, side, y, stages[0])
        contact_step(body, mu, motion, side, y, times[i] - start_time - elapsed, stages, states[i])


@compiled
def stands(body, mu, motion, y):
    """Tell whether a coin on its edge is held there however it rolls on.

    Rolling brings C up and down, and so changes the roll rate: the floor must hold the coin in every phase
    that it can reach, at rest and at the largest roll rate that its energy of turning leaves there. It turns
    about the vertical as L_z has it.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state of a coin on its edge, (13,).
    """
    J, weight = body.inertia, body.mass * body.gravity
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    L_z, energy = dot(up, apply(J, w)), dot(w, apply(J, w)) / 2 + weight * y[2]
    if not held_on_edge(body, mu, motion, y):
        return False
    phase = y.copy()
    e0, e1, e2, e3 = attitude_of(y)
    for i in range(_PHASES):
        c, s = math.cos(math.pi * i / _PHASES), math.sin(math.pi * i / _PHASES)
        phase[6], phase[7] = c * e0 - s * e3, c * e1 + s * e2
        phase[8], phase[9] = c * e2 - s * e1, c * e3 + s * e0
        up = rotation_matrix(attitude_of(phase))[2]
        phase[2] = body.radius * math.hypot(up[0], up[1]) + dot(up, body.center)
        moment = dot(up, apply(J, up))
        left = energy - weight * phase[2] - L_z * L_z / (2 * moment)
        fastest = (2 * max(left, 0.0) / J[2][2]) ** 0.5
        for rolling in (-fastest, 0.0, fastest):
            for k in range(3):
                phase[10 + k] = L_z / moment * up[k]
            phase[12] += rolling
            if left > -1e-9 * weight * body.radius and not held_on_edge(body, mu, motion, phase):
                return False
    return True


@compiled
def held_on_edge(body, mu, motion, y):
    """Tell whether the floor's force on either rim turns a coin on its edge back to the other now.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state of a coin on its edge, (13,).
    """
    dy, tipped = np.empty(STATE_SIZE), y.copy()
    R = rotation_matrix(attitude_of(y))
    for side in (-1.0, 1.0):
        # Turn the coin a little to the side, about the horizontal axis in its plane.
        axis = cross(R[2], (0.0, 0.0, 1.0))
        turn = quaternion_rate(attitude_of(y), scale(side * 2 * _TIP, axis))
        for i in range(4):
            tipped[6 + i] = y[6 + i] + turn[i]
        contact_rate(body, mu, motion, side_of(tipped), tipped, dy)
        up, w = rotation_matrix(attitude_of(tipped))[2], spin_of(tipped)
        up_rate = cross(up, w)
        n_z_acceleration = cross(up_rate, w)[2] + cross(up, (dy[10], dy[11], dy[12]))[2]
        if n_z_acceleration * up[2] >= 0:
            return False
    return True
