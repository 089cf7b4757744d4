"""What an impulse must not do, of impulses whose work is a closed form."""

import math

import numpy as np
import pytest

from cointoss.analytic.impact.breach import Breach, breach_of, work_of
from cointoss.models.body import EXACT, OwnCode
from tests.helpers.impacts import draw_contact
from tests.helpers.tuples import vector

ROUND = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""The K of a point mass: the work is S · v_A + S²/2."""
COUPLED = ((1.0, 0.0, -0.5), (0.0, 1.0, 0.0), (-0.5, 0.0, 1.0))
"""An impulse (-3, 0, 0) at v_A = (2, 0, -1) gives v_Az' = 1/2 and takes 3/2 of energy."""
FALL, FAST, SLIP = (0.0, 0.0, -1.0), (0.0, 0.0, -10.0), (2.0, 0.0, -1.0)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("part", [0.0, 0.6, 1.0, 1.3])
def test_the_work_of_an_impulse_is_the_energy_of_the_point_before_less_that_after(part, seed):
    """(e² - 1)/2 v_A · K⁻¹ v_A of S = -(1 + e) K⁻¹ v_A, after which v_A is -e of itself."""
    K, v_A = draw_contact(np.random.default_rng(seed))
    stopping = np.linalg.solve(np.array(K), v_A)
    energy = float(np.dot(v_A, stopping)) / 2
    work = work_of(K, v_A, vector(-(1 + part) * stopping))
    assert work == pytest.approx((part**2 - 1) * energy, rel=1e-12, abs=1e-13 * energy)


@pytest.mark.parametrize(
    ("K", "v_A", "S", "allowed", "breach"),
    [
        (ROUND, FALL, (math.nan, 0.0, 1.0), {}, Breach.NOT_FINITE),
        (ROUND, FALL, (0.0, math.inf, 1.0), {}, Breach.NOT_FINITE),
        (ROUND, FALL, (0.0, 0.0, 1 - 2 * EXACT), {}, Breach.SINKS),
        (ROUND, FALL, (0.0, 0.0, 1 - EXACT / 2), {}, Breach.NONE),
        (ROUND, FAST, (0.0, 0.0, 10 - 5 * EXACT), {}, Breach.NONE),
        (COUPLED, SLIP, (-3.0, 0.0, -6 * EXACT), {}, Breach.PULLS),
        (COUPLED, SLIP, (-3.0, 0.0, -6 * EXACT), {"may_add_energy": True}, Breach.PULLS),
        (COUPLED, SLIP, (-3.0, 0.0, -6 * EXACT), {"may_pull": True}, Breach.NONE),
        (COUPLED, SLIP, (-3.0, 0.0, -1.5 * EXACT), {}, Breach.NONE),
        (ROUND, FALL, (0.0, 0.0, 2 + 4 * EXACT), {}, Breach.ADDS_ENERGY),
        (ROUND, FALL, (0.0, 0.0, 2 + 4 * EXACT), {"may_pull": True}, Breach.ADDS_ENERGY),
        (ROUND, FALL, (0.0, 0.0, 2 + 4 * EXACT), {"may_add_energy": True}, Breach.NONE),
        (ROUND, FALL, (0.0, 0.0, 2 + EXACT), {}, Breach.NONE),
        # It adds 1e-9 of 10 in speed; of |S| |v_A| = 200 so much is rounding.
        (ROUND, FAST, (0.0, 0.0, 20 + 10 * EXACT), {}, Breach.NONE),
    ],
)
def test_an_impulse_beyond_a_condition_by_more_than_the_tolerance_breaks_it(K, v_A, S, allowed, breach):
    own = OwnCode(1, **{"may_add_energy": False, "may_pull": False, "tolerance": EXACT, **allowed})
    assert breach_of(own, K, v_A, S) == breach
