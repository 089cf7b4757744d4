"""The side a coin started from: the fit to people's flips, what bounces leave, and the command."""

import json
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import betaln
from scipy.stats import uniform

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.first_side import caught_side, first_side
from cointoss.models.batch import rows_from_states
from cointoss.models.hand import Hand, same_side_probability
from cointoss.models.reading import load
from cointoss_reproduction.studies.same_side.people import (
    EXPONENTIAL,
    NORMAL,
    WOBBLING,
    Flips,
    People,
    PeopleFit,
    chance_of_spread,
    fit,
    interval,
    log_likelihoods,
    quantiles,
    read_flips,
    spread_of,
    without,
)
from tests.helpers.command_line import cointoss


def drawn(family, parameters, people=200, flips=7000, seed=3):
    rng = np.random.default_rng(seed)
    count = np.full(people, flips // 2)
    p = quantiles(family, np.array(parameters), rng.random(people))
    return Flips(rng.binomial(count, p), count, rng.binomial(count, p), count)


def test_the_counts_are_those_published():
    flips = read_flips()
    assert (flips.same.sum(), flips.flips.sum(), len(flips.flips)) == (178_078, 350_757, 48)


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
    flips = read_flips()
    found = log_likelihoods(flips, family, np.array(parameters))
    # The last of them is the one who lies farthest out.
    for person in range(2, len(found), 3):
        expected = log_integral(family, parameters, flips.same[person], flips.flips[person])
        assert found[person] == pytest.approx(expected, abs=1e-6)


def test_the_likelihood_of_uniform_people_is_in_closed_form():
    """The integral of p^k (1 - p)^(n - k) is a beta function."""
    family = People(uniform(), (0.0, 1.0), lambda _, latent: latent, start=(0.5,))
    flips = Flips(*(np.array([number]) for number in (30, 50, 25, 50)))
    found = log_likelihoods(flips, family, np.array([0.5]))
    assert found[0] == pytest.approx(betaln(56, 46), abs=1e-9)


def test_a_spread_of_psi_is_found_again_within_its_interval():
    truth = np.radians(12)
    flips = drawn(WOBBLING, [truth])
    found = fit(flips, WOBBLING)
    low, high = interval(flips, found)
    assert low < truth < high
    assert 0.1 < (high - low) / truth < 0.6
    assert found.log_likelihood > fit(flips, EXPONENTIAL).log_likelihood
    assert found.log_likelihood > fit(flips, NORMAL).log_likelihood


def test_a_normal_spread_is_found_again_within_its_interval():
    flips = drawn(NORMAL, [0.02, 0.49])
    found = fit(flips, NORMAL)
    spread, mean = found.parameters
    low, high = interval(flips, found)
    assert mean == pytest.approx(0.49, abs=0.004)
    assert low < 0.02 < high
    assert 0.1 < (high - low) / spread < 0.4
    assert spread_of(found) == pytest.approx(spread, rel=1e-6)


def test_an_exponential_spread_is_found_again():
    flips = drawn(EXPONENTIAL, [0.012])
    found = fit(flips, EXPONENTIAL)
    assert found.parameters[0] == pytest.approx(0.012, rel=0.25)
    assert spread_of(found) == pytest.approx(found.parameters[0], rel=1e-6)
    assert found.log_likelihood > fit(flips, WOBBLING).log_likelihood


def test_one_person_left_out_leaves_the_others():
    flips = read_flips()
    left = without(flips, 46)
    assert left.same.tolist() == np.delete(flips.same, 46).tolist()
    assert (left.flips == np.delete(flips.flips, 46)).all()


def test_people_who_differ_too_much_have_no_chance():
    flips, rng = drawn(WOBBLING, [0.2]), np.random.default_rng(4)
    found = fit(flips, WOBBLING)
    assert 0.05 < chance_of_spread(flips, found, rng) < 0.95
    halved = PeopleFit(WOBBLING, found.parameters / 2, found.log_likelihoods)
    assert chance_of_spread(flips, halved, rng) < 0.01


@pytest.mark.parametrize("engine", list(Engine))
def test_on_a_smooth_floor_a_wobbling_coin_ends_as_it_started(engine):
    """The angular momenta about its normal and about the vertical keep their signs."""
    scenario = load("fig29").replace("floor.restitution", 0.5)
    count = 200 if engine == Engine.ANALYTIC else 20
    states = Hand(height=0.3, psi=np.radians(60)).states(scenario.body, np.random.default_rng(5), count)
    found = first_side(rows_from_states(scenario, states), engine)
    assert found.at_rest.all()
    assert len(found.at_rest) == count
    # Not yet at the touches before.
    assert all(0.3 < up.mean() < 0.95 for up in found.touches)
    assert len(found.touches) == 4


@pytest.mark.parametrize(("engine", "count"), [(Engine.ANALYTIC, 40_000), (Engine.MUJOCO, 200)])
@pytest.mark.parametrize("psi", [40, 50, 60, 75, 90])
def test_a_caught_coin_shows_its_first_side_as_often_as_the_theorem_says(engine, count, psi):
    """Theorem 2 of Diaconis, Holmes and Montgomery, by whole tosses to a hand in vacuum."""
    scenario = load("fig29").replace("air", {}, "ending.caught", 1.0)
    states = Hand(psi=np.radians(psi)).states(scenario.body, np.random.default_rng(11), count)
    up = caught_side(rows_from_states(scenario, states), engine)
    p = float(same_side_probability(np.radians(psi)))
    # The height of release scatters by a tenth: few tosses stay below the hand.
    assert 0.9 * count < len(up) < count
    assert abs(up.mean() - p) <= 4 * (p * (1 - p) / len(up)) ** 0.5


def test_the_command_catches_where_it_or_the_scenario_says(tmp_path):
    """The scenario's height is that of the command without one, and the command's goes before."""
    path = tmp_path / "hand.toml"
    path.write_text(load("fig29").replace("air", {}, "ending.caught", 1.0).to_toml())
    arguments = ("--psi", "60 deg", "--tosses", "300")
    of_scenario = cointoss("hands", path, *arguments).stdout
    assert [line.split()[0] for line in of_scenario.splitlines()] == ["caught", "left"]
    assert cointoss("hands", path, *arguments, "--caught", "100 cm").stdout == of_scenario
    lower = json.loads(cointoss("hands", path, *arguments, "--caught", "0.8 m", "--json").stdout)
    assert lower["caught"] == 0.8
    assert lower["same_side"]["caught"]["count"] == 300
    told = cointoss("hands", path, *arguments, "--caught", "5 m")
    assert (told.exit_code, told.stdout) == (0, "left out  300 coins that never came down to the hand\n")
    assert json.loads(cointoss("hands", "fig29", "--tosses", "5", "--json").stdout)["caught"] is None


def test_the_command_counts_what_a_hand_tosses():
    arguments = ("hands", "fig29", "--psi", "60 deg", "--tosses", "60", "--height", "30 cm")
    answered = cointoss(*arguments)
    assert answered.exit_code == 0
    assert answered.stdout.splitlines()[-1] == "at rest   100.00% [90.04%, 100.00%] of 60 tosses"
    told = json.loads(cointoss(*arguments, "--json").stdout)
    assert told["hand"]["psi"] == pytest.approx(np.pi / 3)
    assert "cointoss" in told["versions"]
    assert told["same_side"]["at rest"]["value"] == 1
