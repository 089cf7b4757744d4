"""The floor's force on a rim point A that keeps its height: with slip, where slip starts, and without.

The floor holds v_Az at 0; where A sticks, it holds all of v_A. Each force is linear in the acceleration b
that it opposes; with v_A in place of b it is the impulse that stops the motion.
"""

import math
from typing import NamedTuple

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
def horizontal_size(a: Vector) -> float:
    """Return the length of the horizontal part of a vector in the space frame."""
    return math.sqrt(a[0] * a[0] + a[1] * a[1])


@compiled
def friction_holds(mu: float, F: Vector) -> bool:
    """Return whether a force F at A presses and lies in the friction cone."""
    return F[2] > 0 and horizontal_size(F) <= mu * F[2]


@compiled
def slip_direction(v_A: Vector, mu: float) -> tuple[float, float]:
    """Return the direction of the slip of A, (2,); none on a smooth floor."""
    if mu == 0:
        return 0.0, 0.0
    speed = horizontal_size(v_A)
    if speed == 0:
        return 0.0, 0.0
    return v_A[0] / speed, v_A[1] / speed


class SlipGrowth(NamedTuple):
    """How a slip in the direction s grows: its acceleration times N's denominator is q = c + M s."""

    c: tuple[float, float]
    M: tuple[tuple[float, float], tuple[float, float]]


@compiled
def starting_slip(K: Matrix, b: Vector, mu: float) -> tuple[float, float]:
    """Return the direction in which a point starts to slip that friction cannot hold, (2,).

    Slip keeps a direction s in which it also accelerates, b_t + N (K_tz - μ K_tt s) = λ s, with the N that
    holds v_Az; friction turns it out of every other direction at once. A Newton iteration finds s, starting
    from the best of a few directions.

    Args:
        K: Delassus matrix of A [1/kg].
        b: dv_A/dt of free flight, space frame, (3,) [m/s²].
        mu: coefficient of friction μ.
    """
    of = slip_growth(K, b, mu)
    return kept_direction(of, best_of_few(of))


@compiled
def growing_slip(K: Matrix, b: Vector, mu: float, v_A: Vector) -> tuple[float, float]:
    """Return the direction of `starting_slip`, (2,), sought from that of a slip v_A, (3,), if it is near."""
    of, s = slip_growth(K, b, mu), slip_direction(v_A, mu)
    turning, growth = turning_and_growth(of, s)
    return kept_direction(of, s if abs(turning) < growth / 2 else best_of_few(of))


@compiled
def best_of_few(of: SlipGrowth) -> tuple[float, float]:
    """Return the best of a few directions from which to seek one that slip keeps, (2,)."""
    best, s = -np.inf, (1.0, 0.0)
    for i in range(len(_COSINES)):
        tried = (_COSINES[i], _SINES[i])
        turning, growth = turning_and_growth(of, tried)
        if growth - abs(turning) > best:
            best, s = growth - abs(turning), tried
    return s


@compiled
def kept_direction(of: SlipGrowth, s: tuple[float, float]) -> tuple[float, float]:
    """Return the direction that slip keeps, (2,), by Newton's method from the direction s."""
    for _ in range(30):
        turning, growth = turning_and_growth(of, s)
        slope = slope_of_turning(of, s, growth)
        change = -turning / slope if slope < 0 else math.copysign(0.1, turning)
        step = min(max(change, -0.2), 0.2)
        # Of the vector, not of an angle in a turn that starts somewhere: the mirror image is rounded alike.
        s = towards_unit((s[0] - step * s[1], s[1] + step * s[0]))
        # The iteration squares its error.
        if abs(change) < 3e-8:
            break
    return s


@compiled
def slip_growth(K: Matrix, b: Vector, mu: float) -> SlipGrowth:
    """Return the `SlipGrowth` of a point; args as `starting_slip`'s.

    q = D b_t - b_z (K_tz - μ K_tt s), with N = -b_z/D and D = K_zz - μ K_zt · s.
    """
    z, b_z = K[2], b[2]
    return SlipGrowth(
        (z[2] * b[0] - b_z * K[0][2], z[2] * b[1] - b_z * K[1][2]),
        (
            (mu * (b_z * K[0][0] - b[0] * z[0]), mu * (b_z * K[0][1] - b[0] * z[1])),
            (mu * (b_z * K[1][0] - b[1] * z[0]), mu * (b_z * K[1][1] - b[1] * z[1])),
        ),
    )


@compiled
def turning_and_growth(of: SlipGrowth, s: tuple[float, float]) -> tuple[float, float]:
    """Return s × q and s · q, q for the slip's direction s."""
    q_x = of.c[0] + (of.M[0][0] * s[0] + of.M[0][1] * s[1])
    q_y = of.c[1] + (of.M[1][0] * s[0] + of.M[1][1] * s[1])
    return s[0] * q_y - s[1] * q_x, s[0] * q_x + s[1] * q_y


@compiled
def towards_unit(s: tuple[float, float]) -> tuple[float, float]:
    """Return a vector of about the length 1, (2,), with the square of its error: a step of Newton's to it."""
    share = (3 - (s[0] * s[0] + s[1] * s[1])) / 2
    return share * s[0], share * s[1]


@compiled
def slope_of_turning(of: SlipGrowth, s: tuple[float, float], growth: float) -> float:
    """Return the derivative of s × q by the angle of s, (s × M t) - s · q with t across s."""
    x = of.M[0][1] * s[0] - of.M[0][0] * s[1]
    y = of.M[1][1] * s[0] - of.M[1][0] * s[1]
    return (s[0] * y - s[1] * x) - growth
