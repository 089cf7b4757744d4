"""States of coins at release: position and velocity of C, Euler parameters, and angular velocity."""

import numpy as np
from numpy.typing import ArrayLike

from cointoss.study import Array


def released(
    heights: Array,
    velocity: ArrayLike = (0, 0, 0),
    attitude: ArrayLike = (1, 0, 0, 0),
    spin: ArrayLike = (0, 0, 0),
) -> Array:
    """Return states of coins above the origin, (n, 13): flat, heads up and at rest but for what is given.

    Args:
        heights: of C, (n,) [m].
        velocity: of C, space frame, (n, 3), or one for all, (3,) [m/s].
        attitude: Euler parameters, (n, 4) or (4,).
        spin: angular velocity, body frame, (n, 3) or (3,) [rad/s].
    """
    parts = np.outer(heights, (0, 0, 1)), velocity, attitude, spin
    return np.hstack([np.broadcast_to(part, (len(heights), np.shape(part)[-1])) for part in parts])


def directions(rng: np.random.Generator, count: int, size: int = 4) -> Array:
    """Draw unit vectors, each direction as likely, (count, size): of 4, Euler parameters of any attitude."""
    drawn = rng.normal(size=(count, size))
    return drawn / np.linalg.norm(drawn, axis=1, keepdims=True)
