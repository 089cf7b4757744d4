"""Keller's map, Fig. 2: its axes, the coins that are tossed and caught in it, and n_z of any flight."""

import numpy as np

from cointoss import Scenario
from cointoss.study import Array, by_numba, sample_flight
from cointoss_reproduction.setups.releases import released

sample_flight = by_numba(sample_flight)

FASTEST, HIGHEST = 20.0, 0.25
"""Ends of the axes: ω_0/π [1/s] and v_0/g [s]."""


def middles(end: float, count: int) -> Array:
    """Return the middles of equal parts of an axis from 0 on: for an even count none lies on a boundary."""
    return (np.arange(count) + 0.5) * end / count


def thrown(scenario: Scenario, over: Array, up: Array) -> Array:
    """Return states flat, one radius above the floor, with ω_0/π [1/s] and v_0/g [s], (n, 13)."""
    velocity = np.outer(up * scenario.gravity, (0, 0, 1))
    heights = np.full(len(over), scenario.coin.radius)
    return released(heights, velocity, spin=np.outer(over * np.pi, (1, 0, 0)))


def caught(scenario: Scenario, starts: Array) -> Array:
    """Return n_z when coins would be back, in vacuum, at the height of their release, (n,)."""
    return np.array([flown(scenario, start, 2 * start[5:6] / scenario.gravity)[0] for start in starts])


def flown(scenario: Scenario, start: Array, times: Array) -> Array:
    """Return n_z of a flight by the analytic engine, (n,).

    Args:
        scenario: coin and air.
        start: state at release, (13,).
        times: (n,) [s].
    """
    states = np.empty((len(times), 13))
    sample_flight(scenario.body, start, 0.0, times, states)
    return 1 - 2 * (states[:, 7] ** 2 + states[:, 8] ** 2)
