"""The Runge-Kutta pair: its coefficients and a step's error are SciPy's, its sums those of the tableau."""

import numpy as np
import pytest
from scipy.integrate import DOP853

from cointoss.analytic.flight.runge_kutta import combined_error, end_point, stage_point, step_error
from cointoss.analytic.numerics.tableau import STAGES, TERMS, WEIGHTED, WEIGHTS, A, B
from tests.helpers.draws import ZLOTY, scenario


def test_the_coefficients_are_those_of_scipy_to_the_bit():
    theirs = np.vstack([DOP853.A, DOP853.B, DOP853.E5[:-1], DOP853.E3[:-1]])
    assert DOP853.E5[-1] == DOP853.E3[-1] == 0
    assert np.array_equal([*A, B], theirs[: STAGES + 1])
    for row, terms, weighted, weights in zip(theirs, TERMS, WEIGHTED, WEIGHTS, strict=True):
        assert np.array_equal(weighted[:terms], np.flatnonzero(row))
        assert np.array_equal(weights[:terms], row[row != 0])


def test_points_and_error_are_the_weighted_sums_of_the_slopes():
    rng = np.random.default_rng(8)
    body, dt = scenario().body, 1e-3
    y, stages, point = rng.normal(size=13), rng.normal(size=(STAGES, 13)), np.empty(13)
    for stage in range(STAGES):
        stage_point(y, dt, stages, stage, point)
        assert point[3:] == pytest.approx((y + dt * DOP853.A[stage] @ stages)[3:], rel=1e-14)
    end_point(y, dt, stages, point)
    assert point == pytest.approx(y + dt * DOP853.B @ stages, rel=1e-14)
    speed = (body.gravity * ZLOTY["radius"]) ** 0.5 + np.linalg.norm(y[3:6])
    spin = (body.gravity / ZLOTY["radius"]) ** 0.5 + np.linalg.norm(y[10:])
    scales = np.repeat([ZLOTY["radius"], speed, 1.0, spin], [3, 3, 4, 3])
    fifth, third = (sum(((row[:-1] @ stages) / scales) ** 2) for row in (DOP853.E5, DOP853.E3))
    # As SciPy combines them.
    error = dt * fifth / np.sqrt(13 * (fifth + 0.01 * third))
    assert step_error(body, y, dt, stages) == pytest.approx(error, rel=1e-13)


@pytest.mark.parametrize(
    ("sum_5", "sum_3"), [(1e300, 1e302), (1e304, 1e308), (1e306, np.inf), (np.inf, np.inf)]
)
def test_a_step_that_overflows_is_never_accepted(sum_5, sum_3):
    """The squares of its slopes leave the range of floating-point numbers one after the other."""
    assert not combined_error(1e-3, sum_5, sum_3, 13) <= 1
