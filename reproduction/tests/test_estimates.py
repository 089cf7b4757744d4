"""Estimates of means, quantiles and quotients: closed forms of their intervals, and how often these hold."""

import numpy as np
import pytest

from cointoss.study import LEVEL, Estimate, share, share_of
from cointoss_reproduction.setups.estimates import (
    difference,
    jackknife,
    mean,
    mean_share,
    quantile,
    quotient,
    ratio_of_medians,
    scatter_of_shares,
)

FIVE = np.arange(1.0, 6.0)
NORMAL, STUDENT = 2.575829, 4.604095
"""Half of 99 % of a normal distribution, and of Student's with four degrees of freedom."""


def of_mean(kept):
    return FIVE[kept].mean()


@pytest.mark.parametrize(
    ("found", "expected", "count"),
    [
        # Of 1 to 5 the variance is 5/2, by n - 1.
        (mean(FIVE), (3, 3 - STUDENT / 2**0.5, 3 + STUDENT / 2**0.5), 5),
        # Of a mean the jackknife that leaves out one after another is Student's interval.
        (jackknife(of_mean, 5, parts=5), (3, 3 - STUDENT / 2**0.5, 3 + STUDENT / 2**0.5), 5),
        # Variances of 1 and 8, by n - 1.
        (
            difference([1, 2, 3], [-1, 3]),
            (1, 1 - NORMAL * (1 / 3 + 8 / 2) ** 0.5, 1 + NORMAL * (1 / 3 + 8 / 2) ** 0.5),
            2,
        ),
        # Errors of the logarithms: a factor of 2, but for 4 above in the second.
        (
            quotient(Estimate(4, 2, 8, 10), Estimate(2, 1, 8, 6)),
            (2, 2 * 2 ** -(5**0.5), 2 * 2 ** (2**0.5)),
            6,
        ),
        # Below the median lie all nine, or none, with 1/512 each; one with 9/512, more than half a percent.
        (quantile(np.arange(9.0, 0.0, -1), 0.5), (5, 1, 9), 9),
        (quantile([1.0, 2.0, np.inf], 0.5), (2, -np.inf, np.inf), 3),
        # Shares that scatter have Student's interval; of equal ones, between 0 and 1 of 3 in Wilson's.
        (mean_share(FIVE / 10), (0.3, 0.3 - STUDENT / 200**0.5, 0.3 + STUDENT / 200**0.5), 5),
        (mean_share([0.3] * 3), (0.3, share_of(0, 3).low, share_of(1, 3).high), 3),
        (mean_share([0.5] * 40), share_of(20, 40).ends, 40),
        (mean_share([]), (np.nan, 0, 1), 0),
        (quotient(share_of(0, 0), share_of(3, 9)), (np.nan, 0, np.inf), 0),
        (quotient(share_of(0, 50), share_of(9, 50)), (np.nan, 0, np.inf), 50),
        (ratio_of_medians(FIVE, 2 * FIVE, np.random.default_rng(0)), (0.5, 0, np.inf), 5),
    ],
)
def test_an_interval_is_its_closed_form(found, expected, count):
    assert found.ends == pytest.approx(expected, rel=1e-6, nan_ok=True)
    assert found.count == count


KINDS = {
    "share": (0.3, lambda rng: share(rng.random(200) < 0.3)),
    "ratio": (2.0, lambda rng: ratio_of_medians(rng.exponential(2, 150), rng.exponential(1, 150), rng)),
    "quantile": (0.1, lambda rng: quantile(rng.uniform(size=120), 0.1)),
}


@pytest.mark.parametrize("kind", KINDS)
def test_an_interval_holds_the_truth_as_often_as_its_level_says(kind):
    truth, draw = KINDS[kind]
    rng = np.random.default_rng(0)
    found = [draw(rng) for _ in range(400)]
    held = np.mean([one.low <= truth <= one.high for one in found])
    # Four standard errors of the count, and a hundredth for what an approximate interval may lack.
    scatter = 4 * np.sqrt(LEVEL * (1 - LEVEL) / len(found))
    assert LEVEL - scatter - 0.01 < held < min(LEVEL + scatter, 1.001)
    assert np.mean([one.value for one in found]) == pytest.approx(truth, rel=0.03)


def test_the_bias_of_hands_is_freed_of_chance():
    """Of five tosses a half scatters by 1/16, and all alike by nothing."""
    assert scatter_of_shares(np.array([0.5, 1.0]), 5) == pytest.approx(((0 - 1 / 16 + 1 / 4) / 2) ** 0.5)
    assert scatter_of_shares(np.array([0.5]), 5) == 0
