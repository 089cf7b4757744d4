"""Random impacts of a coin: the states in which it comes down on its rim."""

import numpy as np

from cointoss.study import Array, Body, Rules
from cointoss_reproduction.setups.releases import directions, released
from cointoss_reproduction.studies.contact_laws.single_impacts import strike

SPEED = 1.0
"""The largest velocity of C along each axis [m/s]."""
SPIN = 100.0
"""The largest spin about each axis of the body [rad/s]."""


def draw_states(body: Body, rules: Rules, count: int, rng: np.random.Generator) -> Array:
    """Draw states of a coin that touches the floor, its lowest point moving down.

    Every attitude is equally likely, and so is every velocity of C and every ω within `SPEED` and `SPIN`; of
    these states each is kept with a probability that grows as the speed at which its lowest point comes down,
    for the floor meets a fast point more often.

    Args:
        body: the coin.
        rules: of any floor.
        count: how many states.
        rng: the source of chance.

    Returns:
        States, (count, 13). C is at height 0: an impact does not depend on where it is.
    """
    states = np.empty((0, 13))
    while len(states) < count:
        attitude = directions(rng, count)
        velocity, spin = (rng.uniform(-most, most, (count, 3)) for most in (SPEED, SPIN))
        drawn = released(np.zeros(count), velocity, attitude, spin)
        impacts, _ = strike(body, rules, drawn, restitution=0.0, friction=0.0)
        closing = -impacts.contact_velocity_before[:, 2]
        states = np.vstack([states, drawn[closing > rng.uniform(0, closing.max(), count)]])
    return states[:count]
