"""Many impacts, each by itself: one coin, one contact law, and the states in which the coin touches."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss import Impacts
from cointoss.study import IMPACT_ROW, Array, Body, Rules, strike_each


def strike(
    body: Body, rules: Rules, states: Array, *, restitution: ArrayLike, friction: ArrayLike
) -> tuple[Impacts, NDArray[np.bool_]]:
    """Let the floor act once on the coin in each of many states, as it would in a toss.

    Args:
        body: the coin.
        rules: of the floor, but for the next two.
        states: of the coin as it touches, (n, 13): position and velocity of C, Euler parameters, and ω.
        restitution: χ at any speed, one number or (n,).
        friction: μ, one number or (n,).

    Returns:
        The impacts, all at time 0, and whether the contact law has a solution there, (n,). Where it has none
        nothing is changed.
    """
    after, rows = np.array(states, dtype=float), np.zeros(len(states), dtype=IMPACT_ROW)
    chi, mu = (np.ascontiguousarray(np.broadcast_to(x, len(rows)), float) for x in (restitution, friction))
    solved = strike_each(body, rules, chi, mu, after, rows)
    return Impacts.from_rows(rows), solved
