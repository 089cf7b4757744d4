"""The gap's sign as a polynomial: F against its definition, and polynomials whose zeros are known."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from cointoss.analytic.flight.gap_polynomials import (
    DEGREE,
    GapPolynomials,
    TimeWindow,
    gap_polynomials,
    time_surely_clear,
)
from cointoss.analytic.flight.power_series import COLUMNS, ROWS, expand_flight, state_in_flight
from cointoss.analytic.toss import state_at_release
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import AIR, IMPERFECT, THIN, draw_release, scenario

ROUNDING = 1e-15


@pytest.mark.parametrize("seed", range(3))
def test_both_polynomials_are_those_of_tails_rim_and_of_heads(seed):
    """F = q² - r² sin², q the height of the middle of the face, at times within a step."""
    case = scenario(coin=IMPERFECT, air=AIR, release=draw_release(np.random.default_rng([seed, 1])))
    body, y, now = case.body, state_at_release(case.release), np.empty(13)
    series, coefficients = np.empty((ROWS, COLUMNS)), np.empty((2, DEGREE + 1))
    length, order = expand_flight(body, y, 1e-2, series)
    found = gap_polynomials(body, series, order, length, coefficients)
    for t in np.linspace(0, length, 5):
        state_in_flight(body, series, order, t, y, now)
        up = np.array(rotation_matrix(tuple(now[6:10]))[2])
        for rim, side in enumerate((-1, 1)):
            q = now[2] + up @ ([0, 0, side * body.thickness / 2] - np.array(body.center))
            F = q**2 - body.radius**2 * (up[0] ** 2 + up[1] ** 2)
            value = Polynomial(found.coefficients[rim, : found.degree + 1])(t)
            assert value == pytest.approx(F, abs=2 * found.rounding)
    assert abs(found.coefficients[0, 0] - found.coefficients[1, 0]) > 1e3 * found.rounding


def clear_of(polynomial: Polynomial, rim: int = 0) -> float:
    """Return for how long of a time 1 a coin is surely clear whose one rim has this polynomial."""
    coefficients = np.zeros((2, DEGREE + 1))
    coefficients[:, 0] = 1.0
    coefficients[rim] = np.pad(polynomial.coef, (0, DEGREE + 1 - len(polynomial.coef)))
    body = scenario(coin=THIN).body if rim == 0 else scenario().body
    rims = GapPolynomials(coefficients, polynomial.degree(), ROUNDING)
    return time_surely_clear(body, rims, 0.0, TimeWindow(0.0, 1.0, 1e-9))


@pytest.mark.parametrize("rim", [0, 1])
def test_no_two_zeros_close_together_are_passed_and_one_is_found(rim):
    rng, proved = np.random.default_rng(2), 0
    for _ in range(200):
        others = Polynomial.fromroots(rng.uniform(1.5, 4, rng.integers(1, 6)))
        far = others * np.sign(others(0.0))
        first, apart = rng.uniform(0.05, 0.9), 10.0 ** rng.uniform(-4, -1)
        proved += clear_of(far * Polynomial([first, -1.0]), rim) == pytest.approx(first, rel=1e-9)
        assert clear_of(far * Polynomial.fromroots([first, first + apart]), rim) < first
    assert proved > 150
