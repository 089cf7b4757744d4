"""Random releases of hands: each has its habit, from which its tosses differ a little."""

import numpy as np

from cointoss.study import Array, quaternion_from_angles
from cointoss_reproduction.setups.releases import released

LEAN = np.radians(7)
"""The coin is released heads up and this far from flat, as that of Fig. 24 [rad]."""
HEIGHTS, SPEEDS, SPINS = (0.8, 1.2), (1.0, 3.0), (20.0, 60.0)
"""Ranges of the habits: height [m], speed upwards [m/s], and spin about η [rad/s]."""


def states_of_hands(
    rng: np.random.Generator, hands: int, each: int = 1, *, spread: float = 0.0, aside: float
) -> Array:
    """Draw the states at release of some hands, (hands each, 13).

    Args:
        rng: the source of chance.
        hands: how many.
        each: tosses of each hand.
        spread: standard deviation of each quantity of a release, relative to the hand's habit.
        aside: the largest of the habit's spins about ξ and ζ [rad/s].
    """
    habits = np.column_stack(
        [rng.uniform(low, high, hands) for low, high in (HEIGHTS, SPEEDS, (-aside, aside), SPINS)]
        + [rng.uniform(-aside, aside, hands)]
    )
    drawn = np.repeat(habits, each, axis=0)
    drawn *= 1 + spread * rng.normal(size=drawn.shape)
    velocity, attitude = np.outer(drawn[:, 1], (0, 0, 1)), quaternion_from_angles((0.0, float(LEAN), 0.0))
    return released(drawn[:, 0], velocity, attitude, drawn[:, 2:])
