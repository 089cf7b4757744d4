"""How p is distributed over people: closed forms, and what was drawn is found again."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.special import betaln, comb, logsumexp
from scipy.stats import betabinom, halfnorm, uniform

from cointoss.compare.flips.counts import Flips
from cointoss.compare.flips.people import CAUGHT, People, crossing, log_binomial, log_likelihoods, wobbling


@pytest.mark.parametrize(("same", "flips"), [(55, 100), (520_000, 1_000_000)])
def test_the_likelihood_of_uniform_people_is_in_closed_form(same, flips):
    """The integral of p^k (1 - p)^(n - k) is a beta function; of many flips it is a narrow one."""
    family = People(uniform(), (0.0, 1.0), lambda _, latent: latent, start=(0.5,))
    found = log_likelihoods(Flips(same=[same], flips=[flips]), family, np.array([0.5]))
    assert found[0] == pytest.approx(betaln(same + 1, flips - same + 1), abs=1e-9 * flips**0.5)


def log_integral_over_the_angle(scatter, same, flips):
    """Return a person's log-likelihood by midpoints that are equal in asin √p, and beyond 45° in closed form.

    The same side comes up with p = 1/2 + asin(tan² φ)/π, and always beyond.
    """
    turned = np.linspace(np.pi / 4, np.pi / 2, 200_001)
    middles = (turned[1:] + turned[:-1]) / 2
    ends, angles = (
        np.arctan(np.sin(np.pi * (np.sin(at) ** 2 - 1 / 2)).clip(0) ** 0.5) for at in (turned, middles)
    )
    of_people = halfnorm.logpdf(angles, scale=scatter) + log_binomial(same, flips, np.sin(middles) ** 2)
    within: Any = logsumexp(of_people, b=np.diff(ends))
    return np.logaddexp(within, halfnorm.logsf(np.pi / 4, scale=scatter) + log_binomial(same, flips, 1.0))


@pytest.mark.parametrize("scatter", [0.2, 0.67, 1.5])
@pytest.mark.parametrize(
    ("same", "flips"),
    [
        (13_000, 25_000),
        (20_000, 25_000),
        (24_000, 25_000),
        (24_990, 25_000),
        (25_000, 25_000),
        (1600, 2000),
        (990_000, 1_000_000),
    ],
)
def test_the_likelihood_of_people_who_wobble_much_is_its_integral(same, flips, scatter):
    """However wide the scatter, and next to 45°, where p comes to 1 with an infinite slope."""
    found = log_likelihoods(Flips(same=[same], flips=[flips]), wobbling(CAUGHT), np.array([scatter]))
    assert found[0] == pytest.approx(log_integral_over_the_angle(scatter, same, flips), abs=1e-4)


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
