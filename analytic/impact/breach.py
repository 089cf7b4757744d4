"""The conditions that every impulse of a contact law of one's own must meet."""

import math
from enum import IntEnum

from cointoss.models.body import OwnCode
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, apply, dot, norm


class Breach(IntEnum):
    """A condition that an impulse does not meet."""

    NONE = 0
    NOT_FINITE = 1
    SINKS = 2
    PULLS = 3
    ADDS_ENERGY = 4


@compiled
def work_of(K: Matrix, v_A: Vector, S: Vector) -> float:
    """Return the work of an impulse S at A, S · (v_A + K S/2): what it adds to the coin's energy [J]."""
    return dot(S, v_A) + dot(S, apply(K, S)) / 2


@compiled
def breach_of(own: OwnCode, K: Matrix, v_A: Vector, S: Vector) -> Breach:
    """Return the first condition that an impulse does not meet to the law's tolerance.

    Args:
        own: the law, and what it may do.
        K: Delassus matrix of A, space frame, a tuple of rows [1/kg].
        v_A: velocity of A before the impact, space frame, (3,) [m/s].
        S: impulse, space frame, (3,) [N s].
    """
    gained, size, tolerance = apply(K, S), norm(S), own.tolerance
    if not size < math.inf:  # nor is it NaN
        return Breach.NOT_FINITE
    if v_A[2] + gained[2] < -tolerance * norm(gained):
        return Breach.SINKS
    if S[2] < -tolerance * size and not own.may_pull:
        return Breach.PULLS
    if work_of(K, v_A, S) > tolerance * size * norm(v_A) and not own.may_add_energy:
        return Breach.ADDS_ENERGY
    return Breach.NONE
