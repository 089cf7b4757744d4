"""A fit finds the exponent of a restitution that falls with the speed, from touches in closed form."""

import numpy as np
import pytest

from cointoss import Observed, fit
from cointoss.models.scenario import Scenario

G, HALF_MS = 9.81, 5e-4
FLAT = Scenario(
    coin={"mass": 0.005, "radius": 0.0125, "thickness": 0.002},
    floor={"restitution": 0.6, "contact": "smooth"},
    release={"position": [0, 0, 1.001]},
)
TRUE = {"floor.restitution": 0.7, "floor.restitution_exponent": 0.25, "release.position.z": 1.001}
SPANS = {
    "floor.restitution": (0.3, 0.9),
    "floor.restitution_exponent": (0.0, 0.6),
    "release.position.z": (0.8, 1.2),
}


def touches(chi: float, p: float, count: int) -> np.ndarray:
    """Return the times of a coin's touches that falls flat from 1 m, v(n) = v_e (v(0)/v_e)^((1 - p)^n)."""
    slowest, fastest = chi ** (1 / p), (2 * G) ** 0.5
    speeds = slowest * (fastest / slowest) ** ((1 - p) ** np.arange(count))
    return fastest / G + 2 / G * np.concatenate([[0], np.cumsum(speeds[1:])])


@pytest.mark.slow
def test_the_intervals_hold_both_restitution_and_exponent():
    errors = np.random.default_rng(1).normal(0, HALF_MS, 7)
    seen = Observed(touch_times=touches(0.7, 0.25, 7) + errors, touch_sd=HALF_MS)
    found = fit(seen, FLAT, SPANS, starts=256)
    assert found.is_possible
    for field, value in TRUE.items():
        low, high = found[field].interval or (value, value)
        assert low < value < high
        assert SPANS[field][0] < low < high < SPANS[field][1]
