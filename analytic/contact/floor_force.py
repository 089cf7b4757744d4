"""The floor's force on the one rim point at which a coin stays in contact.

The rim point A that is lowest moves round the rim; v_A is the velocity of the coin's matter there. With a
force F at A, dv_A/dt = b + K F, K the mobility of A as in an impact and b what free flight gives. The floor
holds v_Az at 0; where A sticks, it holds all of v_A.
"""

import math
from enum import IntEnum

import numpy as np

from analytic.flight.equations_of_motion import attitude_of, spin_of, velocity_of
from analytic.impact.laws import mobility, spin_gained
from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, cross, dot, scale, solve, subtract

SLOW = 1e-3
"""Against √(g r): slip slower than this is stopped where friction can hold it, and creeps elsewhere, for
there friction would turn it in the time of slip/(μ g). Sliding is kept down to half of it."""
# The direction of slip is sought from the best of so many.
_DIRECTIONS = 24


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
    UPRIGHT = 4
    """In contact at both rims."""


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
def give_impulse(body, R, arm, S, y):
    """Change the velocities of the state y by an impulse S at A, space frame, (3,) [N s]."""
    turned = spin_gained(body, R, arm, S)
    for i in range(3):
        y[3 + i] += S[i] / body.mass
        y[10 + i] += turned[i]


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
