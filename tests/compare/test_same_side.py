"""The side a coin started from: the fit to people's flips, what bounces leave, and the command."""

import json

import numpy as np
import pytest

from compare.engines import Engine
from compare.metrics.first_side import first_side
from compare.reproduction.claim import unexpected
from compare.reproduction.saving import read_numbers
from compare.reproduction.setups.same_side_fit import (
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
from compare.reproduction.studies.same_side import SameSide, claims, result
from models.hand import Hand
from models.reading import load
from tests.helpers.command_line import cointoss
from tests.helpers.pages import pictures, printed, saved


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


def test_the_command_counts_what_a_hand_tosses():
    arguments = ("hands", "fig29", "--psi", "60 deg", "--tosses", "60", "--height", "30 cm")
    answered = cointoss(*arguments)
    assert answered.exit_code == 0
    assert answered.stdout.splitlines()[-1] == "at rest   100.00% [90.04%, 100.00%] of 60 tosses"
    told = json.loads(cointoss(*arguments, "--json").stdout)
    assert told["hand"]["psi"] == pytest.approx(np.pi / 3)
    assert told["same_side"]["at rest"]["value"] == 1


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--psi", "120 deg", "fig29: psi: 2.09"),
        ("--psi", "x", "'--psi': x; accepted: a number in rad"),
        ("--height", "-1", "fig29: height: -1.0, accepted: a height above 0"),
        ("--spin", "1e7", "fig29: Releases.angular_velocity: row"),
        ("--tosses", "0", "--tosses"),
    ],
)
def test_what_no_hand_does_is_one_line(option, value, message):
    answered = cointoss("hands", "fig29", option, value)
    assert answered.exit_code == 2
    assert message in answered.stderr
    assert answered.stderr.count("\n") == 1


def test_the_page_shows_the_saved_numbers():
    found = read_numbers(saved("same-side"), SameSide)
    assert printed("HANDS.md", "same-side") == result(found).text
    assert pictures("HANDS.md", "same-side") == {"same-side.png"}
    assert unexpected(claims(found)) == ()
