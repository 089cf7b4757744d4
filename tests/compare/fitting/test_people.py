"""How p is distributed over people: closed forms, and what was drawn is found again."""

import math

import numpy as np
import pytest
from scipy.special import betaln, comb
from scipy.stats import betabinom, uniform

from cointoss.compare.fitting.flips import Flips
from cointoss.compare.fitting.people import (
    WOBBLING,
    People,
    crossing,
    log_binomial,
    log_likelihoods,
    quantiles,
)


def test_the_spread_of_psi_is_the_root_of_its_mean_square():
    """p = 1/2 + asin(tan² φ)/π, solved for φ = 90° - ψ."""
    p = quantiles(WOBBLING, np.array([0.1]), (np.arange(4000) + 0.5) / 4000)
    off = np.arctan(np.sqrt(np.sin(np.pi * (p - 0.5))))
    assert np.sqrt(np.mean(off**2)) == pytest.approx(0.1, rel=1e-3)


@pytest.mark.parametrize(("same", "flips"), [(55, 100), (520_000, 1_000_000)])
def test_the_likelihood_of_uniform_people_is_in_closed_form(same, flips):
    """The integral of p^k (1 - p)^(n - k) is a beta function; of many flips it is a narrow one."""
    family = People(uniform(), (0.0, 1.0), lambda _, latent: latent, start=(0.5,))
    found = log_likelihoods(Flips(same=[same], flips=[flips]), family, np.array([0.5]))
    assert found[0] == pytest.approx(betaln(same + 1, flips - same + 1), abs=1e-9 * flips**0.5)


def test_counts_of_a_simulated_probability_are_beta_binomial():
    found = log_binomial([3, 60], [10, 100], 0.6, 50)
    expected = [betabinom.logpmf(same, n, 30.5, 20.5) for same, n in ((3, 10), (60, 100))]
    assert found == pytest.approx(expected - np.log(comb([10, 100], [3, 60])), rel=1e-9)
    assert log_binomial(60, 100, 0.6, 1e7) == pytest.approx(log_binomial(60, 100, 0.6), abs=100**2 / 1e7)


def test_an_interval_reaches_to_the_last_fall_of_a_likelihood():
    def two_peaks(x):
        return math.cos(x) - 0.5

    assert crossing(two_peaks, 0.0, 9.0, 30) == pytest.approx(7 * math.pi / 3, abs=1e-5)
    assert crossing(two_peaks, 0.0, 6.5, 30) == 6.5
    assert crossing(two_peaks, 0.0, 2.0) == pytest.approx(math.pi / 3, abs=1e-5)
