"""How p is distributed over people: closed forms, and what was drawn is found again."""

import numpy as np
import pytest
from scipy.special import betaln
from scipy.stats import uniform

from cointoss.compare.fitting.flips import Flips
from cointoss.compare.fitting.people import WOBBLING, People, log_likelihoods, quantiles


def test_the_spread_of_psi_is_the_root_of_its_mean_square():
    """p = 1/2 + asin(tan² φ)/π, solved for φ = 90° - ψ."""
    p = quantiles(WOBBLING, np.array([0.1]), (np.arange(4000) + 0.5) / 4000)
    off = np.arctan(np.sqrt(np.sin(np.pi * (p - 0.5))))
    assert np.sqrt(np.mean(off**2)) == pytest.approx(0.1, rel=1e-3)


def test_the_likelihood_of_uniform_people_is_in_closed_form():
    """The integral of p^k (1 - p)^(n - k) is a beta function."""
    family = People(uniform(), (0.0, 1.0), lambda _, latent: latent, start=(0.5,))
    flips = Flips(same=[55], flips=[100])
    found = log_likelihoods(flips, family, np.array([0.5]))
    assert found[0] == pytest.approx(betaln(56, 46), abs=1e-9)
