"""Random releases of hands: each has its habit, from which its tosses differ a little."""

import numpy as np

from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.records import Array
from cointoss.models.releases import Releases

LEAN = np.radians(7)
"""The coin is released heads up and this far from flat, as that of Fig. 24 [rad]."""
HEIGHTS, SPEEDS, SPINS = (0.8, 1.2), (1.0, 3.0), (20.0, 60.0)
"""Ranges of the habits: height [m], speed upwards [m/s], and spin about η [rad/s]."""


def releases_of_hands(
    rng: np.random.Generator, hands: int, each: int = 1, *, spread: float = 0.0, aside: float
) -> Releases:
    """Draw the releases of some hands, (hands each).

    Args:
        rng: the source of chance.
        hands: how many.
        each: tosses of each hand.
        spread: standard deviation of each quantity of a release, relative to the hand's habit.
        aside: the habit's spins about ξ and ζ are up to so much [rad/s].
    """
    habits = np.column_stack(
        [rng.uniform(low, high, hands) for low, high in (HEIGHTS, SPEEDS, (-aside, aside), SPINS)]
        + [rng.uniform(-aside, aside, hands)]
    )
    drawn = np.repeat(habits, each, axis=0)
    drawn *= 1 + spread * rng.normal(size=drawn.shape)
    upright = _along_z(drawn[:, 0]), _along_z(drawn[:, 1])
    attitude = np.tile(quaternion_from_angles((0.0, float(LEAN), 0.0)), (len(drawn), 1))
    return Releases(
        position=upright[0], velocity=upright[1], quaternion=attitude, angular_velocity=drawn[:, 2:]
    )


def _along_z(values: Array) -> Array:
    return values[:, None] * np.array([0.0, 0.0, 1.0])
