"""The coefficients of the Runge-Kutta pair are SciPy's."""

import numpy as np
from scipy.integrate import DOP853

from analytic.numerics import tableau


def test_the_coefficients_are_those_of_scipy_to_the_bit():
    for name in ("A", "B", "E3", "E5"):
        ours, theirs = getattr(tableau, name), getattr(DOP853, name)
        assert np.array_equal(ours, theirs[..., : tableau.STAGES])
        assert not theirs[..., tableau.STAGES :].any()


def test_the_packed_weights_are_the_rows_without_the_zeros():
    rows = [*tableau.A, tableau.B, tableau.E5, tableau.E3]
    for row, terms, weighted, weights in zip(
        rows, tableau.TERMS, tableau.WEIGHTED, tableau.WEIGHTS, strict=True
    ):
        assert np.array_equal(weighted[:terms], np.flatnonzero(row))
        assert np.array_equal(weights[:terms], row[row != 0])
