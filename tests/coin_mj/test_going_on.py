"""MuJoCo's coin is followed after its toss is decided, and its toss stays what it was."""

from math import pi, sqrt

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.models.ending import REST_WAIT
from cointoss.models.reading import load
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import scenario
from tests.helpers.states import last_state

g, r, h, mu = 9.81, 1.25e-2, 2e-3, 0.05
COIN = {"mass": 5e-3, "radius": r, "thickness": h}


def tossed(release, until):
    floor = {"contact": "coulomb", "friction": mu, "restitution": 0.5}
    return coin_mj.toss(scenario(coin=COIN, floor=floor, release=release, ending={"until": until}))


def test_a_coin_on_its_edge_with_backspin_stops_where_friction_has_taken_both():
    d = 0.4
    v = sqrt(2 * mu * g * d)
    release = {"position": [0, 0, r], "velocity": [v, 0, 0], "angles": [0, pi / 2, 0]}
    toss = tossed({**release, "angular_velocity": [0, 0, 2 * v / r]}, 3)
    assert toss.outcome == Outcome.EDGE
    position, velocity, _ = last_state(toss)
    assert position == pytest.approx([d, 0, r], rel=1e-5, abs=1e-6)
    assert np.abs(velocity).max() < 1e-9


@pytest.mark.slow
def test_a_coin_at_rest_ends_its_path():
    toss = coin_mj.toss(load("table").replace("ending.until", "rest"))
    assert toss.end_time < toss.path_end < toss.end_time + REST_WAIT
    _, velocity, spin = last_state(toss)
    assert np.linalg.norm(velocity) < 1e-4 * sqrt(g * toss.scenario.coin.radius)
    assert toss.scenario.coin.radius * np.linalg.norm(spin) < 1e-4 * sqrt(g * toss.scenario.coin.radius)


def test_it_bounces_on_as_the_other_engine_s_coin_does():
    """Both settle at the third impact, and lie in the end."""
    release = {"position": [0, 0, 0.05], "angles": [0, 0.3, 0]}
    case = scenario(floor={"restitution": 0.5}, release=release, ending={"until": 0.5})
    ours, theirs = analytic.toss(case), coin_mj.toss(case)
    assert theirs.trusted_impacts == len(theirs.impacts) == len(ours.impacts) == 3
    assert theirs.later_times[:5] == pytest.approx(ours.later_times[:5], abs=2e-6)
    times = np.array([0.11, 0.13, 0.15, 0.3, 0.4, 0.5])
    assert theirs.sample(times).position == pytest.approx(ours.sample(times).position, abs=1e-6)


def test_a_caught_coin_stays_in_the_hand():
    toss = coin_mj.toss(
        load("fig24a").replace("ending.caught", 0.2, "release.position.z", 0.5, "ending.until", 2)
    )
    assert toss.ending == Ending.CAUGHT
    states = toss.sample([toss.end_time, 1.0, 2])
    assert np.ptp(states.position, axis=0).max() < 1e-15
