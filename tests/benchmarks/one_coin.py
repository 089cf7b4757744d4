"""The engine's mechanics of one coin, compiled as functions of its state alone.

The other integrators call these: what is compared is how they fly and find the touch. A call from Python
costs little so, as the whole body need not be passed.
"""

from collections.abc import Callable
from typing import NamedTuple

import numba
import numpy as np

from cointoss.analytic.contact.resets import hit
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.models.ending import final_face
from cointoss.models.geometry import evaluate_gap
from cointoss.models.records import IMPACT_ROW, Array, Ending
from cointoss.models.scenario import Scenario

LIFT = 1e-16
"""Above the floor at lift-off [m]: else that too would be a zero of the gap to the other integrators."""


class OneCoin(NamedTuple):
    """The mechanics of a scenario's coin; a state y, (13,), is that of its flight."""

    rate: Callable[[float, Array], Array]
    """Of (t, y): the rate of change of y in flight."""
    gap: Callable[[float, Array], float]
    """Of (t, y): height of the lowest point [m]."""
    gaps: Callable[[Array], Array]
    """Of many states, (n, 13): their gaps, (n,) [m]."""
    strike: Callable[[Array], tuple[int, bool]]
    """Of y at a touch, which becomes the state after the impact: the face up, and whether the toss ends."""


def mechanics(scenario: Scenario) -> OneCoin:
    """Compile the mechanics of a scenario's coin."""
    body, rules = scenario.body, scenario.rules
    compiled = numba.njit(error_model="numpy")

    @compiled
    def rate(_, y):
        dy = np.empty(STATE_SIZE)
        derivative(body, y, dy)
        return dy

    @compiled
    def gap(_, y):
        return evaluate_gap(body, state_of(y)).gap

    @compiled
    def gaps(states):
        heights = np.empty(len(states))
        for i in range(len(states)):
            heights[i] = evaluate_gap(body, state_of(states[i])).gap
        return heights

    @compiled
    def strike(y):
        row = np.zeros(1, dtype=IMPACT_ROW)
        ending = hit(body, rules, rules.restitution, y, row[0])
        y[2] += max(LIFT - evaluate_gap(body, state_of(y)).gap, 0.0)
        if ending == Ending.NONE:
            _, ending = final_face(body, rules, state_of(y), 0.0)
        return row[0].face, ending != Ending.NONE

    return OneCoin(rate, gap, gaps, strike)
