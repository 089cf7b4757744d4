"""Hands: what they release, and Diaconis, Holmes and Montgomery's probability of the same side."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.attitude import rotation_matrix
from cointoss.models.hand import Hand, same_side_probability
from cointoss.models.reading import load

COINS = [load("fig29"), load("zloty")]


@pytest.mark.parametrize("scenario", COINS, ids=["ideal", "imperfect"])
def test_a_coin_is_released_flat_with_its_angular_momentum_at_psi(scenario):
    hand = Hand(height=0.7, speed=1.5, spin=80.0, psi=1.0, scatter=0.0)
    made = hand.releases(scenario.body, np.random.default_rng(0), 500)
    assert (made.quaternion == (1, 0, 0, 0)).all()
    assert (made.position == (0, 0, 0.7)).all()
    assert (made.velocity == (0, 0, 1.5)).all()
    inertia = np.array(scenario.body.inertia)
    momentum = made.angular_velocity @ inertia
    assert np.linalg.norm(momentum, axis=1) == pytest.approx(80 * inertia[0, 0])
    assert momentum[:, 2] == pytest.approx(80 * inertia[0, 0] * np.cos(1.0))
    aside = np.arctan2(momentum[:, 1], momentum[:, 0])
    assert np.histogram(aside, 4, (-np.pi, np.pi))[0].min() > 90


def test_releases_scatter_as_asked():
    hand = Hand(height=0.7, speed=1.5, spin=80.0, psi=1.3, scatter=0.1, psi_scatter=0.05)
    body = COINS[0].body
    made = hand.releases(body, np.random.default_rng(1), 20_000)
    height, momentum = made.position[:, 2], made.angular_velocity @ np.array(body.inertia)
    size = np.linalg.norm(momentum, axis=1)
    assert height.std() / height.mean() == pytest.approx(0.1, rel=0.03)
    assert size.std() / size.mean() == pytest.approx(0.1, rel=0.03)
    psi = np.arccos(momentum[:, 2] / size)
    assert (psi.mean(), psi.std()) == (pytest.approx(1.3, abs=2e-3), pytest.approx(0.05, rel=0.03))


def test_the_probability_of_the_same_side_is_the_published_one():
    degrees = np.array([90, 79.95, 45, 30, 100.05])
    expected = [0.5, 0.51, 1, 1, 0.51]
    assert same_side_probability(np.radians(degrees)) == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("psi", [0.9, 1.2, 1.5])
def test_a_coin_in_flight_has_its_first_side_up_for_that_part_of_the_time(psi):
    scenario = load("fig29").replace("air", {}).replace("coin.thickness", 0.0)
    hand = Hand(height=200.0, spin=150.0, psi=psi, scatter=0.0)
    made = hand.releases(scenario.body, np.random.default_rng(2), 1)
    for field, axes in (("position", "xyz"), ("angular_velocity", ("xi", "eta", "zeta"))):
        for i, axis in enumerate(axes):
            scenario = scenario.replace(f"release.{field}.{axis}", float(getattr(made, field)[0, i]))
    toss = analytic.toss(scenario.replace("release.angles", (0.0, 0.0, 0.0)).replace("ending.max_impacts", 1))
    times = np.linspace(0, toss.impacts.time[0], 20_000)[:-1]
    up = np.array([rotation_matrix(e)[2][2] > 0 for e in toss.sample(times).quaternion])
    assert up.mean() == pytest.approx(float(same_side_probability(psi)), abs=4e-3)


@pytest.mark.parametrize("value", ["1 m", None, True, [1.0]])
def test_what_is_no_number_is_refused_as_such(value):
    with pytest.raises(ValueError, match=r"^height = .*: accepted: a number$"):
        Hand(height=value)
