"""The side a coin started from: the fit to people's flips, what bounces leave, and the command."""

import json

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.first_side import caught_side, first_side
from cointoss.compare.reproduction.setups.same_side_fit import (
    Flips,
    by_wobble,
    chance_of_spread,
    fit_freely,
    fit_wobble,
    freely,
    interval,
    log_likelihood,
    read_flips,
)
from cointoss.models.hand import Hand, same_side_probability
from cointoss.models.reading import load
from tests.helpers.command_line import cointoss


def drawn(probabilities, people=200, flips=7000, seed=3):
    rng = np.random.default_rng(seed)
    count = np.full(people, flips // 2)
    p = rng.choice(probabilities, people)
    return Flips(rng.binomial(count, p), count, rng.binomial(count, p), count)


def test_the_counts_are_those_published():
    flips = read_flips()
    assert (flips.same.sum(), flips.flips.sum(), len(flips.flips)) == (178_078, 350_757, 48)


def test_the_spread_of_psi_is_the_root_of_its_mean_square():
    """p = 1/2 + asin(tan² φ)/π, solved for φ = 90° - ψ."""
    off = np.arctan(np.sqrt(np.sin(np.pi * (by_wobble(0.1) - 0.5))))
    assert np.sqrt(np.mean(off**2)) == pytest.approx(0.1, rel=1e-3)


def test_a_spread_of_psi_is_found_again_within_its_interval():
    truth = np.radians(12)
    flips = drawn(by_wobble(truth))
    found = fit_wobble(flips)
    low, high = interval(lambda x: log_likelihood(flips, by_wobble(x)), found.parameters[0], 0.05, 0.8)
    assert low < truth < high
    assert 0.1 < (high - low) / truth < 0.6
    assert found.log_likelihood > fit_freely(flips).log_likelihood


def test_a_free_spread_is_found_again():
    flips = drawn(freely(0.49, 0.02))
    mean, spread = fit_freely(flips).parameters
    assert mean == pytest.approx(0.49, abs=0.004)
    assert spread == pytest.approx(0.02, rel=0.2)


def test_people_who_differ_too_much_have_no_chance():
    flips, rng = drawn(by_wobble(0.2)), np.random.default_rng(4)
    assert 0.05 < chance_of_spread(flips, by_wobble(0.2), rng) < 0.95
    assert chance_of_spread(flips, by_wobble(0.1), rng) < 0.01


@pytest.mark.parametrize("engine", list(Engine))
def test_on_a_smooth_floor_a_wobbling_coin_ends_as_it_started(engine):
    """The angular momenta about its normal and about the vertical keep their signs."""
    scenario = load("fig29").replace("floor.restitution", 0.5)
    count = 200 if engine == Engine.ANALYTIC else 20
    start = Hand(height=0.3, psi=np.radians(60)).releases(scenario.body, np.random.default_rng(5), count)
    found = first_side(scenario, start, engine)
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
    start = Hand(psi=np.radians(psi)).releases(scenario.body, np.random.default_rng(11), count)
    up = caught_side(scenario, start, engine)
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
    assert of_scenario.splitlines() == [
        line for line in of_scenario.splitlines() if line.startswith("caught ")
    ]
    assert cointoss("hands", path, *arguments, "--caught", "100 cm").stdout == of_scenario
    lower = json.loads(cointoss("hands", path, *arguments, "--caught", "0.8 m", "--json").stdout)
    assert lower["caught"] == 0.8
    assert lower["same_side"]["caught"]["count"] == 300
    told = cointoss("hands", path, *arguments, "--caught", "5 m")
    assert (told.exit_code, told.stdout) == (0, "none of 300 tosses was caught\n")
    assert json.loads(cointoss("hands", "fig29", "--tosses", "5", "--json").stdout)["caught"] is None


def test_the_command_counts_what_a_hand_tosses():
    arguments = ("hands", "fig29", "--psi", "60 deg", "--tosses", "60", "--height", "30 cm")
    answered = cointoss(*arguments)
    assert answered.exit_code == 0
    assert answered.stdout.splitlines()[-1] == "at rest   100.00% [90.04%, 100.00%] of 60 tosses"
    told = json.loads(cointoss(*arguments, "--json").stdout)
    assert told["hand"]["psi"] == pytest.approx(np.pi / 3)
    assert told["same_side"]["at rest"]["value"] == 1
