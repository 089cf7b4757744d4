"""What an impulse must not do, of impulses whose work is a closed form."""

import numpy as np
import pytest

from cointoss.analytic.impact.breach import Breach, breach_of, work_of
from cointoss.models.body import EXACT, OwnCode
from tests.helpers.impacts import draw_contact
from tests.helpers.tuples import vector

BOUND = OwnCode(1, may_add_energy=False, may_pull=False, tolerance=EXACT)


def giving_back(part, seed):
    """Return K, v_A and the impulse after which v_A is minus a part of itself: S = -(1 + e) K⁻¹ v_A."""
    K, v_A = draw_contact(np.random.default_rng(seed))
    return K, v_A, vector(-(1 + part) * np.linalg.solve(np.array(K), v_A))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("part", [0.0, 0.6, 1.0, 1.3])
def test_the_work_of_an_impulse_is_the_energy_of_the_point_before_less_that_after(part, seed):
    """(e² - 1)/2 v_A · K⁻¹ v_A."""
    K, v_A, S = giving_back(part, seed)
    energy = float(np.dot(v_A, np.linalg.solve(np.array(K), v_A))) / 2
    assert work_of(K, v_A, S) == pytest.approx((part**2 - 1) * energy, rel=1e-12, abs=1e-13 * energy)


def test_an_impulse_that_gives_back_more_than_all_adds_energy_unless_it_may():
    for seed in range(20):
        K, v_A, S = giving_back(1 + 1e-6, seed)
        pulls = S[2] < 0
        assert breach_of(BOUND, K, v_A, S) == (Breach.PULLS if pulls else Breach.ADDS_ENERGY)
        assert breach_of(BOUND._replace(may_pull=True), K, v_A, S) == Breach.ADDS_ENERGY
        assert breach_of(BOUND._replace(may_add_energy=True, may_pull=True), K, v_A, S) == Breach.NONE
        K, v_A, S = giving_back(1.0, seed)
        assert breach_of(BOUND._replace(may_pull=True), K, v_A, S) == Breach.NONE


def test_an_impulse_that_leaves_the_point_on_its_way_down_sinks():
    for seed in range(20):
        K, v_A, S = giving_back(-1e-6, seed)
        assert breach_of(BOUND._replace(may_pull=True), K, v_A, S) == Breach.SINKS
        K, v_A, S = giving_back(0.0, seed)
        assert breach_of(BOUND._replace(may_pull=True), K, v_A, S) == Breach.NONE
