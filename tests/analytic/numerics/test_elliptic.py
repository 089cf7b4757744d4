"""Complete elliptic integrals against SciPy's."""

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

from cointoss.analytic.numerics.elliptic import complete_elliptic


@pytest.mark.parametrize("m", [0.0, 1e-12, 1e-3, 0.3, 0.9, 0.999999, 1 - 1e-12])
def test_the_integrals_are_those_of_scipy(m):
    assert complete_elliptic(m) == pytest.approx((ellipk(m), ellipe(m)), rel=1e-14)


def test_at_one_both_are_finite():
    K, E = complete_elliptic(1.0)
    assert np.isfinite(K)
    assert pytest.approx(1.0, abs=1e-14) == E
