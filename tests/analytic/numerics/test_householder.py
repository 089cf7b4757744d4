"""Householder's reflections: the covariance is kept, and so are exact zeros."""

import numpy as np
import pytest

from cointoss.analytic.numerics.householder import reflect_to_triangle


def test_a_triangle_has_the_covariance_of_all_rows():
    """Of sizes from 1e-30 to 1, as errors in a chatter have; the covariance itself could not hold them."""
    rng = np.random.default_rng(1)
    for _ in range(50):
        rows = rng.normal(size=(35, 12)) * 10.0 ** rng.uniform(-30, 0, (1, 12))
        triangle = rows.copy()
        reflect_to_triangle(triangle)
        assert np.all(np.tril(triangle, -1) == 0)
        sizes = np.linalg.norm(rows, axis=0)
        covariance, expected = (A.T @ A / np.outer(sizes, sizes) for A in (triangle, rows))
        assert covariance == pytest.approx(expected, abs=1e-13)


def test_columns_of_zeros_stay_zero_exactly():
    rows = np.random.default_rng(2).normal(size=(9, 4))
    rows[:, [0, 2]] = 0
    reflect_to_triangle(rows)
    assert np.all(rows[:, [0, 2]] == 0)


@pytest.mark.parametrize("below", [0.0, 1e-12, 1e-8])
def test_what_is_nearly_a_triangle_loses_no_digits(below):
    """As the errors carried from the impact before are: a reflection takes no difference of near numbers."""
    rng = np.random.default_rng(3)
    rows = below * rng.normal(size=(9, 5))
    rows[:5] += np.triu(rng.uniform(1, 2, (5, 5)))
    triangle = rows.copy()
    reflect_to_triangle(triangle)
    assert triangle.T @ triangle == pytest.approx(rows.T @ rows, rel=1e-14)
