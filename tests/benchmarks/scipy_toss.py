"""The toss by SciPy's solve_ivp: an event for the touch, and gap evaluations between its steps."""

from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from cointoss.analytic.toss import state_at_release
from cointoss.models.scenario import Scenario
from tests.benchmarks.one_coin import OneCoin

EVALUATED_EVERY = 1e-4
"""Time between two gap evaluations [s]; solve_ivp itself makes them only at the ends of its steps."""


def toss(scenario: Scenario, coin: OneCoin) -> tuple[list[float], list[int]]:
    """Give the times of the impacts [s] and the faces that are up at them.

    Raises:
        RuntimeError: if the coin sinks into the floor between two steps, where no event can see it.
    """
    time, y = 0.0, state_at_release(scenario.release)
    times, faces, ended = [], [], False
    while not ended:
        time, y = _first_touch(coin, time, y, scenario.ending.max_time)
        face, ended = coin.strike(y)
        times.append(time)
        faces.append(face)
    return times, faces


def _first_touch(coin: OneCoin, start: float, y: np.ndarray, latest: float) -> tuple[float, np.ndarray]:
    touch: Any = partial(coin.gap)
    touch.terminal, touch.direction = True, -1
    flight = solve_ivp(
        coin.rate,
        (start, latest),
        y,
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        events=touch,
        dense_output=True,
    )
    end = flight.t[-1]
    evaluated = np.linspace(start, end, int((end - start) / EVALUATED_EVERY) + 3)[1:-1]
    if (coin.gaps(np.ascontiguousarray(flight.sol(evaluated).T)) < 0).any():
        raise RuntimeError("a touch went unseen between two steps")
    return end, flight.y[:, -1].copy()
