"""Confidence intervals of estimates hold what was estimated as often as they say."""

import numpy as np
import pytest

from cointoss.study import LEVEL, share, share_of
from cointoss_reproduction.setups.estimates import (
    difference,
    jackknife,
    mean,
    mean_share,
    quotient,
    ratio_of_medians,
    scatter_of_shares,
)

RUNS = 400
KINDS = {
    "share": (0.3, lambda rng: share(rng.random(200) < 0.3)),
    "mean": (2.0, lambda rng: mean(rng.exponential(2.0, 400))),
    "difference": (1.0, lambda rng: difference(rng.normal(3, 1, 60), rng.normal(2, 3, 200))),
    "jackknife": (2.0, lambda rng: _spread(rng.normal(0, 2, 400))),
    "quotient": (2.0, lambda rng: quotient(share(rng.random(900) < 0.4), share(rng.random(900) < 0.2))),
    "ratio": (2.0, lambda rng: ratio_of_medians(rng.exponential(2, 150), rng.exponential(1, 150), rng)),
}


def _spread(drawn):
    return jackknife(lambda kept: float(np.sqrt(np.mean(drawn[kept] ** 2))), len(drawn))


@pytest.mark.parametrize("kind", KINDS)
def test_an_interval_holds_the_truth_as_often_as_its_level_says(kind):
    truth, draw = KINDS[kind]
    rng = np.random.default_rng(0)
    found = [draw(rng) for _ in range(RUNS)]
    held = np.mean([one.low <= truth <= one.high for one in found])
    # Four standard errors of the count, and a hundredth for what an approximate interval may lack.
    scatter = 4 * np.sqrt(LEVEL * (1 - LEVEL) / RUNS)
    assert LEVEL - scatter - 0.01 < held < min(LEVEL + scatter, 1.001)
    assert np.mean([one.value for one in found]) == pytest.approx(truth, rel=0.03)


@pytest.mark.parametrize("shares", [[0.7], [0.3, 0.3, 0.3], [0.5] * 40])
def test_equal_shares_have_their_mean_and_an_interval_about_it(shares):
    same = mean_share(shares)
    assert same.value == shares[0]
    assert 0 <= same.low < same.value < same.high <= 1
    assert same.high - same.low > 0.3 / len(shares)


def test_a_mean_of_no_shares_and_a_quotient_of_none_may_be_anything():
    none = mean_share([], "spins")
    assert np.isnan(none.value)
    assert (none.low, none.high, none.count, none.counted) == (0, 1, 0, "spins")
    found = quotient(share_of(0, 0), share_of(3, 9))
    assert np.isnan(found.value)
    assert (found.low, found.high) == (0, np.inf)


def test_a_quotient_of_none_may_be_anything():
    found = quotient(share(np.zeros(50, dtype=bool)), share(np.arange(50) < 9))
    assert np.isnan(found.value)
    assert (found.low, found.high) == (0, np.inf)


@pytest.mark.parametrize(("p", "bias"), [(0.5, 0.0), (0.9, 0.4)])
def test_the_bias_of_hands_is_freed_of_chance(p, bias):
    each = 10
    shares = np.random.default_rng(0).binomial(each, p, 20_000) / each
    assert scatter_of_shares(shares, each) == pytest.approx(bias, abs=0.02)
    # Chance alone would look like a bias of 0.16.
    assert np.sqrt(np.mean((shares - p) ** 2)) > 0.09
