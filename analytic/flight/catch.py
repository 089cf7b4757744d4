"""A flight into a hand: when the mass centre first comes down to the height of the catch."""

import numpy as np

from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import position_of, spin_of, velocity_of
from cointoss.models.catch import approach_hand
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled


@compiled
def fly_to_hand(body, height, y, longest):
    """Fly until the mass centre first comes down to a height, if it does before the coin touches the floor.

    Args:
        body: the coin.
        height: of the catch [m].
        y: state at the start, (13,); becomes the state at the catch, or stays where there is none.
        longest: the longest flight wanted [s].

    Returns:
        The time of flight [s]; infinite where the coin is not caught.
    """
    state = y.copy()
    flown, elapsed, is_above = fly(body, state, longest)[0], 0.0, position_of(y)[2] > height
    copy_into(state, y)
    while elapsed < flown:
        z, v, w = position_of(state)[2], velocity_of(state), spin_of(state)
        caught, is_above, step = approach_hand(body, height, is_above, z, v, w, flown - elapsed)
        if caught:
            copy_into(y, state)
            return elapsed
        fly(body, state, step)
        elapsed += step
    return np.inf
