"""Many impacts, each by itself: one coin, one contact law, and the states in which the coin touches."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.analytic.contact.resets import hit
from cointoss.models.body import Body, Rules
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW, Array, Ending, Impacts


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
    solved = _strike_each(body, rules, chi, mu, after, rows)
    return Impacts.from_rows(rows), solved


@compiled
def _strike_each(
    body: Body, rules: Rules, chi: Array, mu: Array, states: Array, rows: NDArray[Any]
) -> NDArray[np.bool_]:
    solved = np.empty(len(rows), dtype=np.bool_)
    for i in range(len(rows)):
        floor = rules_at(rules, chi[i], mu[i])
        solved[i] = hit(body, floor, chi[i], states[i], rows[i]) == Ending.NONE
    return solved


@compiled
def rules_at(rules: Rules, chi: float, mu: float) -> Rules:
    """Return the same rules with another restitution χ and friction μ."""
    return Rules(
        rules.law,
        rules.own,
        chi,
        rules.restitution_threshold,
        rules.restitution_kind,
        mu,
        rules.rolling_friction,
        rules.pivoting_friction,
        rules.test,
        rules.max_impacts,
        rules.max_time,
        rules.caught,
    )
