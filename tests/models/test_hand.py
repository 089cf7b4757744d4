"""Hands: what they release, and Diaconis, Holmes and Montgomery's probability of the same side."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cointoss.models.attitude import rotation_matrix
from cointoss.models.batch import STATE
from cointoss.models.errors import ScenarioError
from cointoss.models.geometry import gap
from cointoss.models.hand import Hand, load_hand, same_side_probability
from cointoss.models.reading import load
from cointoss.models.records import Face, Outcome

SAVED = Path(__file__).parents[2] / "docs" / "reproduction"
COINS = [load("fig29"), load("zloty")]


@pytest.mark.parametrize("scenario", COINS, ids=["ideal", "imperfect"])
def test_a_coin_is_released_flat_with_its_angular_momentum_at_psi(scenario):
    hand = Hand(height=0.7, speed=1.5, spin=80.0, psi=1.0, scatter=0.0)
    made = hand.states(scenario.body, np.random.default_rng(0), 500)
    assert (made[:, :10] == (0, 0, 0.7, 0, 0, 1.5, 1, 0, 0, 0)).all()
    inertia = np.array(scenario.body.inertia)
    momentum = made[:, 10:] @ inertia
    assert np.linalg.norm(momentum, axis=1) == pytest.approx(80 * inertia[0, 0])
    assert momentum[:, 2] == pytest.approx(80 * inertia[0, 0] * np.cos(1.0))
    aside = np.arctan2(momentum[:, 1], momentum[:, 0])
    assert np.histogram(aside, 4, (-np.pi, np.pi))[0].min() > 90


def test_peoples_hand_has_the_wobble_that_was_found_from_their_flips():
    told = (SAVED / "same-side/claims.json").read_text(encoding="utf-8")
    (found,) = re.findall(r"root mean square of ([\d.]+)", told)
    hand = Hand.people(spin=80.0)
    assert np.degrees(hand.psi_scatter) == pytest.approx(float(found), abs=0.05)
    assert hand == replace(Hand(spin=80.0), psi_scatter=hand.psi_scatter)


def test_releases_scatter_as_asked():
    hand = Hand(height=0.7, speed=1.5, spin=80.0, psi=1.3, scatter=0.1, psi_scatter=0.05)
    body = COINS[0].body
    made = hand.states(body, np.random.default_rng(1), 20_000)
    height, momentum = made[:, 2], made[:, 10:] @ np.array(body.inertia)
    size = np.linalg.norm(momentum, axis=1)
    assert height.std() / height.mean() == pytest.approx(0.1, rel=0.03)
    assert size.std() / size.mean() == pytest.approx(0.1, rel=0.03)
    psi = np.arccos(momentum[:, 2] / size)
    assert (psi.mean(), psi.std()) == (pytest.approx(1.3, abs=2e-3), pytest.approx(0.05, rel=0.03))


@pytest.mark.parametrize("up", ["heads", "either"])
def test_a_tilt_turns_the_coin_and_its_motion_about_two_horizontal_axes(up):
    """The angular momentum keeps its angle to the normal; without tilt the other draws are the same."""
    body, rngs = COINS[1].body, [np.random.default_rng(7) for _ in range(2)]
    flat, tilted = (
        Hand(psi=1.0, tilt=tilt, up=up).states(body, rng, 5000)
        for tilt, rng in zip((0.0, 0.1), rngs, strict=True)
    )
    normals = rotations(tilted)[:, :, 2] * np.sign(rotations(flat)[:, 2:, 2])
    assert normals[:, :2].std(axis=0) == pytest.approx(0.1, rel=0.03)
    same = [*range(6), 10, 11, 12]
    assert (tilted[:, same] == flat[:, same]).all()


@pytest.mark.parametrize(
    ("hand", "is_alike"),
    [
        (Hand(spin=0.0), True),
        (Hand(spin=0.0, psi_scatter=0.1), True),
        (Hand(scatter=0.0), True),
        (Hand(), False),
        (Hand(spin=0.0, tilt=0.1), False),
        (Hand(scatter=0.0, psi_scatter=0.1), False),
        (Hand(spin=0.0, spun=True), False),
    ],
)
def test_a_hand_of_which_nothing_varies_says_so(hand, is_alike):
    assert bool(hand.unvaried) == is_alike


def test_the_probability_of_the_same_side_is_the_published_one():
    degrees = np.array([90, 79.95, 45, 30, 100.05, 0])
    expected = [0.5, 0.51, 1, 1, 0.51, 1]
    assert same_side_probability(np.radians(degrees)) == pytest.approx(expected, abs=1e-4)


def test_releases_are_the_fields_of_the_states_that_a_seed_draws():
    hand, scenario = Hand(psi_scatter=0.2, up="either"), COINS[1]
    made = hand.releases(scenario, 20, seed=4)
    states = hand.states(scenario.body, np.random.default_rng(4), 20)
    assert list(made) == list(STATE)
    assert np.array_equal(np.transpose(list(made.values())), states)
    catching = replace(hand, caught=0.6).releases("zloty", 20, seed=4)
    assert list(catching) == [*STATE, "ending.caught"]
    assert catching["ending.caught"] == 0.6


@pytest.mark.parametrize("n", [0, -1, 2.5, True, 10_000_001])
def test_a_number_of_releases_is_a_whole_number_in_its_range(n):
    with pytest.raises(ValueError, match=r"^n: .*, accepted: a whole number from 1 to 10000000$"):
        Hand().releases("zloty", n)


@pytest.mark.parametrize("up", [Face.HEADS, Outcome.HEADS])
def test_the_side_that_is_up_is_a_word_or_a_member(up):
    assert repr(Hand(up=up)) == repr(Hand(up="heads"))


def rotations(states):
    return np.array([rotation_matrix(tuple(e)) for e in states[:, 6:10]])


@pytest.mark.parametrize("scenario", COINS, ids=["ideal", "imperfect"])
def test_half_of_the_coins_start_on_the_other_side_and_turn_alike_in_space(scenario):
    plain, either = (
        Hand(psi_scatter=0.2, up=up).states(scenario.body, np.random.default_rng(1), 400)
        for up in ("heads", "either")
    )
    R = rotations(either)
    assert 150 < np.sum(R[:, 2, 2] < -0.999) < 250
    assert np.einsum("nij,nj->ni", R, either[:, 10:]) == pytest.approx(plain[:, 10:])


@pytest.mark.parametrize("scenario", COINS, ids=["ideal", "imperfect"])
def test_a_spun_coin_touches_the_floor_and_turns_about_the_vertical(scenario):
    hand = Hand(spun=True, spin=90.0, psi_scatter=0.2, up="either")
    made, body = hand.states(scenario.body, np.random.default_rng(3), 500), scenario.body
    R = rotations(made)
    in_space = np.einsum("nij,nj->ni", R, made[:, 10:])
    assert in_space[:, :2] == pytest.approx(0, abs=1e-12)
    assert in_space[:, 2].mean() == pytest.approx(90, rel=0.02)
    assert in_space[:, 2].std() == pytest.approx(9, rel=0.2)
    assert (made[:, 3:6] == 0).all()
    assert np.arccos(R[:, 2, 2]).std() == pytest.approx(0.2, rel=0.15)
    lowest = [gap(body, z, tuple(up)) for z, up in zip(made[:, 2], R[:, 2], strict=True)]
    assert lowest == pytest.approx([0.0] * 500, abs=1e-12)
    around = np.arctan2(R[:, 2, 0], R[:, 2, 1])
    assert np.histogram(around, 4, (-np.pi, np.pi))[0].min() > 90


def test_a_hand_is_read_from_a_file(tmp_path):
    file = tmp_path / "hand.toml"
    text = 'spin = "25 rad/s"\npsi_scatter = "10 deg"\nspun = true\nscatter = 0.05\nup = "either"\n'
    file.write_text(f"format = 1\n{text}")
    expected = Hand(spin=25.0, psi_scatter=np.radians(10), spun=True, scatter=0.05, up="either")
    assert load_hand(file) == expected


def test_a_coin_that_is_spun_is_not_caught():
    caught = load("fig24a").replace("ending.caught", 0.5)
    with pytest.raises(ScenarioError, match=r"ending.caught = 0.5: accepted: none where the coin is spun"):
        Hand(spun=True).scenario(caught)
