"""A flight into a hand: when the mass centre first comes down to the height of the catch."""

import numpy as np

from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import position_of, state_of
from cointoss.models.body import Body
from cointoss.models.catch import approach_hand
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled


@compiled
def fly_to_hand(body: Body, height: float, y: Array, longest: float) -> float:
    """Fly until the mass centre first comes down to a height, if it does before the coin touches the floor.

    Args:
        body: the coin.
        height: of the catch [m].
        y: state at the start, (13,); becomes the state at the catch, or stays where there is none.
        longest: the longest flight wanted [s].

    Returns:
        The time of flight [s]; infinite where the coin is not caught.
    """
    flying = y.copy()
    flown, elapsed, is_above = fly(body, flying, longest, False).time, 0.0, position_of(y)[2] > height
    copy_into(flying, y)
    while elapsed < flown:
        approach = approach_hand(body, height, is_above, state_of(flying), flown - elapsed)
        if approach.is_caught:
            copy_into(y, flying)
            return elapsed
        fly(body, flying, approach.step, False)
        is_above = approach.is_above
        elapsed += approach.step
    return np.inf
