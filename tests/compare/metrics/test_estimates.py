"""Shares, their intervals and their words, against other programs and in closed form; and enough to tell."""

import math

import numpy as np
import pytest
from scipy.stats import binomtest

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import chance_alike, in_words, percent, share, share_of, wilson


@pytest.mark.parametrize(
    ("met", "count"), [(0, 500), (1, 3), (7, 20), (20, 20), (52, 100), (990_000, 1_000_000)]
)
def test_an_interval_is_wilsons_as_scipy_has_it(met, count):
    due = binomtest(met, count).proportion_ci(0.99, method="wilson")
    found = share(np.arange(count) < met, "impacts")
    assert found.ends == pytest.approx((met / count, due.low, due.high), rel=1e-9, abs=1e-15)
    assert (found.count, found.counted) == (count, "impacts")
    assert share_of(met, count, "impacts") == found


def test_a_share_of_all_reaches_1_and_one_of_no_trials_may_be_anything():
    counts = np.arange(1, 1000)
    assert (wilson(counts, counts)[2] == 1).all()
    none = share_of(0, 0)
    assert none.ends == pytest.approx((math.nan, 0, 1), nan_ok=True)
    with pytest.raises(ValueError, match="accepted: a number from 0 to the count"):
        share_of(1, 0)


@pytest.mark.parametrize(
    ("changed", "ends"),
    [
        (lambda one: one - 0.25, (0.25, 0.0, 0.5)),
        (lambda one: one * 2, (1.0, 0.5, 1.5)),
        (lambda one: one / 2, (0.25, 0.125, 0.375)),
    ],
)
def test_an_interval_goes_with_its_value(changed, ends):
    assert changed(Estimate(0.5, 0.25, 0.75, 9)) == Estimate(ends[0], ends[1], ends[2], 9)


@pytest.mark.parametrize(
    ("counts", "chance"),
    [
        # Of one degree of freedom, by Yates: χ² = 4 · 4.5² / 15.
        ([[10, 20, 0], [20, 10, 0]], math.erfc((4 * 4.5**2 / 15 / 2) ** 0.5)),
        # Of two: χ² = 2 (25/15 + 4/18 + 9/3).
        ([[10, 20, 6], [20, 16, 0]], math.exp(-(25 / 15 + 4 / 18 + 9 / 3))),
    ],
)
def test_the_chance_that_counts_are_alike_is_that_of_chi_square(counts, chance):
    assert chance_alike(counts) == pytest.approx(chance, rel=1e-12)


@pytest.mark.parametrize(
    ("ends", "said"),
    [
        ((0.5, 0.1, 0.75), "50.0 % [10.0, 75.0]"),
        ((0.02, 0.0, 0.0999), "2.00 % [0.00, 9.99]"),
        ((0.002, 0.001, 0.0099), "0.200 % [0.100, 0.990]"),
    ],
)
def test_a_small_share_has_more_digits(ends, said):
    estimate = Estimate(ends[0], ends[1], ends[2], 100)
    assert percent(estimate) == said
    assert in_words(estimate, ".4g", 100).replace("[", "").split()[0] == f"{100 * ends[0]:.4g}"
