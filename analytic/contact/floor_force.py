"""The floor's force on a rim point A that keeps its height: with slip, where slip starts, and without.

The floor holds v_Az at 0; where A sticks, it holds all of v_A. Each force is linear in the acceleration b
that it meets: of v_A in the place of b it is the impulse that stops the motion.
"""

import math

import numpy as np

from cointoss.models.kernel.circle import on_circle
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, dot, scale, solve

# The direction in which slip starts is sought from the best of these.
_COSINES, _SINES = on_circle(24, 24)


@compiled
def holding_force(K: Matrix, b: Vector) -> Vector:
    """Return the force at A that holds all of v_A, space frame, (3,) [N].

    Args:
        K: Delassus matrix of A [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
    """
    return solve(K, scale(-1.0, b))


@compiled
def sliding_force(K: Matrix, b: Vector, mu: float, slip: tuple[float, float]) -> Vector:
    """Return the force at A, against a slip in the direction `slip`, (2,), that holds v_Az, (3,) [N].

    Args:
        K: Delassus matrix of A [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
        mu: coefficient of friction μ, 0 on a smooth floor.
        slip: unit vector, (2,).
    """
    direction = (-mu * slip[0], -mu * slip[1], 1.0)
    return scale(-b[2] / dot(K[2], direction), direction)


@compiled
def friction_holds(mu: float, F: Vector) -> bool:
    """Return whether a force F at A presses and lies in the friction cone."""
    return F[2] > 0 and math.hypot(F[0], F[1]) <= mu * F[2]


@compiled
def slip_direction(v_A: Vector, mu: float) -> tuple[float, float]:
    """Return the direction of the slip of A, (2,); none on a smooth floor."""
    if mu == 0:
        return 0.0, 0.0
    speed = math.hypot(v_A[0], v_A[1])
    if speed == 0:
        return 0.0, 0.0
    return v_A[0] / speed, v_A[1] / speed


@compiled
def starting_slip(K: Matrix, b: Vector, mu: float) -> tuple[float, float]:
    """Return the direction in which a point starts to slip that friction cannot hold, (2,).

    Slip keeps the direction s that its own acceleration has, b_t + N (K_tz - μ K_tt s) = λ s, with the N
    that holds v_Az; against all others friction turns it at once. A Newton iteration for the direction,
    from the best of a few.

    Args:
        K: Delassus matrix of A [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
        mu: coefficient of friction μ.
    """
    best, s = -np.inf, (1.0, 0.0)
    for i in range(len(_COSINES)):
        tried = (_COSINES[i], _SINES[i])
        turning, _, growth = _slip_turning(K, b, mu, tried)
        if growth - abs(turning) > best:
            best, s = growth - abs(turning), tried
    for _ in range(30):
        turning, slope, _ = _slip_turning(K, b, mu, s)
        change = -turning / slope if slope < 0 else math.copysign(0.1, turning)
        step = min(max(change, -0.2), 0.2)
        # Of the vector, not of an angle in a turn that starts somewhere: the mirror image is rounded alike.
        length = math.hypot(1.0, step)
        s = ((s[0] - step * s[1]) / length, (s[1] + step * s[0]) / length)
        if abs(change) < 1e-14:
            break
    return s


@compiled
def _slip_turning(K: Matrix, b: Vector, mu: float, s: tuple[float, float]) -> Vector:
    """Return s × q, its derivative by the angle of s, and s · q for the slip's direction s.

    q = D a_t, D = K_zz - μ K_zt · s: the acceleration of the slip, cleared of N's denominator.
    """
    t = (-s[1], s[0])
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
