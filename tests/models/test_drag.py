"""Linear drag against quadrature of the paper's integrals with one-sided pressure, and what it lifts."""

import numpy as np
import pytest

from cointoss.models.drag import linear_drag, sliding_share
from tests.helpers.referee import air_on_cylinder


@pytest.mark.parametrize("thickness", [0.0, 0.3, 2.5])
@pytest.mark.parametrize("seed", range(4))
def test_force_and_moment_are_the_papers_integrals(thickness, seed):
    rng = np.random.default_rng(seed)
    r, ln, lt = 1.3, 0.8, 0.2
    v, w = rng.normal(size=3), rng.normal(size=3)
    drag = linear_drag(r, thickness, ln, lt)
    closed = -np.array(
        [
            *(drag.force_tangential * v[:2]),
            drag.force_normal * v[2],
            *(drag.moment_tangential * w[:2]),
            drag.moment_normal * w[2],
        ]
    )
    integrated = air_on_cylinder(r, thickness, ln, lt, v, w)
    # One-sided pressure puts a kink into the integrand: the rectangle rule with 4096 points errs by ~1e-7.
    assert np.abs(closed - integrated).max() < 1e-6 * np.abs(closed).max()


@pytest.mark.parametrize(("thickness", "ratio"), [(0.0, 2.0), (2e-3, 1.0), (2e-3, 8.0)])
def test_the_sliding_share_of_a_balanced_coin_is_its_closed_form(thickness, ratio):
    drag = linear_drag(0.0125, thickness, 0.2 * ratio, 0.2)
    root = (drag.force_normal / drag.force_tangential) ** 0.5
    assert sliding_share(drag, 0.0) == pytest.approx(((root - 1) / (root + 1)) ** 2, abs=2e-9)
    assert sliding_share(drag, 1e-3) > sliding_share(drag, 0.0)
    assert sliding_share(linear_drag(0.0125, thickness, 0.0, 0.0), 0.0) == 1
