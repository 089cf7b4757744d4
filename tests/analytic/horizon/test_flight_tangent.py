"""The tangent map of a toss: against differences of the engine itself, and what is known of it."""

from itertools import product

import numpy as np
import pytest

from cointoss.analytic.flight.flying import sample
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.horizon.flight_tangent import COARSE, FINE, flight_tangent
from cointoss.analytic.runs import event_tangent, run
from cointoss.analytic.toss import state_at_release
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.laws import ContactLaw
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_release, scenario

flight_tangent = by_numba(flight_tangent)
sample = by_numba(sample)

SIZES = np.array([1e-2, 1e-2, 1e-2, *[1.0] * 7, *[50.0] * 3])
"""Of the components of a state: length, speed, attitude, spin."""
QUADRATURES = {"normal": 2.0, "tangential": 0.5, "exponent": 0.5}
THICKNESSES_AND_OFFSETS = [
    (0.0, [0.0, 0.0, 0.0]),
    (2e-3, [0.0, 0.0, 0.0]),
    (0.0, [*PAPER_OFFSET[:2], 0.0]),
    (2e-3, PAPER_OFFSET),
]


def flown(case: Scenario, start: np.ndarray, duration: float) -> np.ndarray:
    """Give the state at the end of a flight."""
    states = np.empty((1, 13))
    sample(case.body, start, 0.0, np.array([duration]), states)
    return states[0]


def tangent_of(case: Scenario, start: np.ndarray, duration: float, accuracy: float = FINE) -> np.ndarray:
    """Give the tangent map of a flight."""
    changes, end = np.eye(13), flown(case, start, duration)
    flight_tangent(case.body, state_of(start), state_of(end), duration, accuracy, changes)
    return changes.T


def directions(start: np.ndarray) -> np.ndarray:
    """Give one change of a state in each row, which keep the quaternion's norm, (12, 13)."""
    rows = np.delete(np.diag(SIZES), 9, axis=0)
    e = start[6:10]
    a, b, c, d = e
    rows[6:9, 6:10] = [[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]]
    return rows


def strayed(case: Scenario, start: np.ndarray, duration: float, accuracy: float) -> list[float]:
    """Give how far the tangent map is off central differences of the flight, of each change's growth."""
    tangent, small, off = tangent_of(case, start, duration, accuracy), 1e-5, []
    for change in directions(start):
        ends = [flown(case, start + sign * small * change, duration) for sign in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * small) / SIZES
        off.append(np.abs((tangent @ change) / SIZES - difference).max() / np.abs(difference).max())
    return off


FLIGHTS = [
    *product(THICKNESSES_AND_OFFSETS, ({}, AIR), (0.0, 0.4), [0.2], [1e-6]),
    pytest.param(THICKNESSES_AND_OFFSETS[-1], QUADRATURES, 0.0, 0.02, 1e-4, marks=pytest.mark.slow),
]
"""Thickness and offset of coins, airs, slopes, durations [s], and what the differences err by."""


@pytest.mark.parametrize(("coin", "air", "slope", "duration", "error"), FLIGHTS)
def test_a_flight_s_tangent_map_is_its_derivative(coin, air, slope, duration, error):
    """To what the differences err by, or as coarsely as the horizon wants it, or nearly so."""
    thickness, offset = coin
    coin = {**ZLOTY, "thickness": thickness, "center_of_mass": offset}
    floor = {"contact": "smooth", "slope": slope}
    case = scenario(coin=coin, air=air, floor=floor, release=draw_release(np.random.default_rng(41)))
    start = state_at_release(case.release)
    assert max(strayed(case, start, duration, FINE)) < error
    assert max(strayed(case, start, duration, COARSE)) < 3 * COARSE


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("number", range(4))
def test_the_tangent_map_of_impacts_is_their_derivative(law, number):
    """From release to after the third impact: the state there and its time, against central differences."""
    rng = np.random.default_rng([43, int(law), number])
    thickness, offset = THICKNESSES_AND_OFFSETS[number]
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        air=AIR if number % 2 else {},
        floor={"contact": str(law), "friction": 0.2, "restitution": 0.7},
        release=draw_release(rng),
        ending={"max_impacts": 3, "test": "paper"},
    )
    body, rules, start = case.body, case.rules, state_at_release(case.release)
    toss = run(body, rules, start)
    assert len(toss.rows) == 3
    tangent = np.eye(14)
    for i in range(3):
        tangent = event_tangent(body, rules, toss, i) @ tangent

    def event(change: np.ndarray) -> np.ndarray:
        moved = run(body, rules, start + change)
        assert np.array_equal(moved.rows["face"], toss.rows["face"])
        return np.append(moved.started.states[3], moved.started.times[3])

    for change in directions(start):
        expected = (tangent @ np.append(change, 0)) / np.append(SIZES, 1)
        grown = np.abs(expected).max()
        errors = []
        for at_end in (1e-5, 1e-6, 1e-7):
            size = at_end / grown
            difference = (event(size * change) - event(-size * change)) / (2 * size) / np.append(SIZES, 1)
            errors.append(np.abs(difference - expected).max() / grown)
        # Large differences suffer from curvature, small ones from rounding.
        assert min(errors) < 2e-4
