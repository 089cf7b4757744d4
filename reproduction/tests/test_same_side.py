"""The side a coin started from: the fit to people's flips."""

from inspect import getfile
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from cointoss import Flips, flips
from cointoss.study import PeopleFit, chance_of_spread, fit_people, log_likelihoods, spread_interval
from cointoss_reproduction.studies.same_side.people import (
    EXPONENTIAL,
    NORMAL,
    WOBBLING,
    quantiles,
    read_flips,
    read_started,
    spread_of,
    without,
)
from tests.helpers.command_line import cointoss

TABLE = Path(getfile(read_flips)).with_name("same_side_flips.csv")


def drawn(family, parameters, people=200, count=7000, seed=3):
    rng = np.random.default_rng(seed)
    counts = np.full(people, count)
    p = quantiles(family, np.array(parameters), rng.random(people))
    return Flips(same=rng.binomial(counts, p), flips=counts)


def test_the_command_finds_the_scatter_of_the_page():
    answered = cointoss("flips", TABLE)
    assert answered.exit_code == 0, answered.stderr
    assert "90 with a scatter of 10.0 [7.6, 13.5] over 48 people" in answered.stdout
    found, counts = flips(TABLE), read_flips()
    assert found.flips.same.tolist() == counts.same.tolist()
    assert found.flips.flips.tolist() == counts.flips.tolist()


def test_the_counts_are_those_published():
    counted = read_flips()
    assert (counted.same.sum(), counted.flips.sum(), len(counted.flips)) == (178_078, 350_757, 48)
    assert [int(one.flips.sum()) for one in read_started()] == [174_915, 175_842]
    assert [int(one.same.sum()) for one in read_started()] == [88_828, 89_250]


@pytest.mark.parametrize(
    ("family", "parameters", "part", "p", "spread"),
    [
        (NORMAL, (0.02, 0.49), 0.8413447, 0.51, 0.02),
        (EXPONENTIAL, (0.012,), 1 - 1 / np.e, 0.512, 0.012),
    ],
    ids=["normal", "exponential"],
)
def test_p_is_spread_over_people_by_its_closed_form(family, parameters, part, p, spread):
    """One standard deviation above a normal's mean; an exponential's mean, which is its deviation too."""
    given = np.array(parameters)
    assert quantiles(family, given, np.array([part])) == pytest.approx(p, abs=1e-7)
    assert spread_of(PeopleFit(family, given, np.zeros(1))) == pytest.approx(spread, rel=1e-6)


def test_the_spread_of_psi_is_the_root_of_its_mean_square():
    """p = 1/2 + asin(tan² φ)/π, solved for φ = 90° - ψ."""
    p = quantiles(WOBBLING, np.array([0.1]), (np.arange(4000) + 0.5) / 4000)
    off = np.arctan(np.sqrt(np.sin(np.pi * (p - 0.5))))
    assert np.sqrt(np.mean(off**2)) == pytest.approx(0.1, rel=1e-3)


def log_integral(family, parameters, same, count):
    """Return the logarithm of a person's likelihood by an adaptive quadrature, cut where it is not small."""

    def log_integrand(latent):
        p = np.clip(family.probability(np.array(parameters), latent), 1e-12, 1 - 1e-12)
        return same * np.log(p) + (count - same) * np.log1p(-p) + family.latent.logpdf(latent)

    low, high = family.ends
    grid = np.linspace(low, high, 20_001)
    values = log_integrand(grid)
    top, within = values.max(), grid[values > values.max() - 60]
    edges = np.linspace(within[0] - 1e-3, within[-1] + 1e-3, 30).clip(*family.ends)
    total = sum(
        quad(lambda x: np.exp(log_integrand(x) - top), *ends, epsabs=0, epsrel=1e-10)[0]
        for ends in pairwise(edges)
        if ends[0] < ends[1]
    )
    return top + np.log(total)


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("family", "parameters"),
    [
        (WOBBLING, (0.17,)),
        (WOBBLING, (0.04,)),
        (WOBBLING, (0.7,)),
        (NORMAL, (0.0156, 0.51)),
        (NORMAL, (0.004, 0.5)),
        (NORMAL, (0.07, 0.52)),
        (EXPONENTIAL, (0.011,)),
        (EXPONENTIAL, (0.003,)),
    ],
)
def test_the_likelihood_of_each_person_is_its_integral(family, parameters):
    """By an adaptive quadrature in p about where each lies; one person lies 5.8 standard deviations away."""
    counted = read_flips()
    found = log_likelihoods(counted, family, np.array(parameters))
    # The last of them is the one who lies farthest out.
    for person in range(5, len(found), 6):
        expected = log_integral(family, parameters, counted.same[person], counted.flips[person])
        assert found[person] == pytest.approx(expected, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("family", "truth", "others"),
    [
        (WOBBLING, (np.radians(12),), (NORMAL, EXPONENTIAL)),
        (NORMAL, (0.02, 0.49), ()),
        (EXPONENTIAL, (0.012,), (WOBBLING,)),
    ],
)
def test_a_spread_over_people_is_found_again_within_its_interval(family, truth, others):
    counted = drawn(family, truth)
    found = fit_people(counted, family)
    low, high = spread_interval(counted, found)
    assert low < truth[0] < high
    assert 0.1 < (high - low) / truth[0] < 0.6
    assert found.parameters[1:] == pytest.approx(truth[1:], abs=0.004)
    if family is not WOBBLING:
        assert spread_of(found) == pytest.approx(found.parameters[0], rel=1e-6)
    assert all(found.log_likelihood > fit_people(counted, other).log_likelihood for other in others)


def test_one_person_left_out_leaves_the_others():
    counted = read_flips()
    left = without(counted, 46)
    assert left.same.tolist() == np.delete(counted.same, 46).tolist()
    assert (left.flips == np.delete(counted.flips, 46)).all()


def test_people_who_differ_too_much_have_no_chance():
    counted, rng = drawn(WOBBLING, [0.2]), np.random.default_rng(4)
    found = fit_people(counted, WOBBLING)
    assert 0.05 < chance_of_spread(counted, found, rng) < 0.95
    halved = PeopleFit(WOBBLING, found.parameters / 2, found.log_likelihoods)
    assert chance_of_spread(counted, halved, rng) < 0.01
