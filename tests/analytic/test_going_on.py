"""A coin that is followed after its toss is decided: by closed forms, and its toss stays what it was."""

from math import pi, sqrt

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.going_on import FOLLOWED
from cointoss.models.attitude import rotation_matrix
from cointoss.models.ending import REST_WAIT
from cointoss.models.reading import load
from cointoss.models.records import Ending, Outcome
from tests.helpers.bits import cases
from tests.helpers.draws import scenario
from tests.helpers.states import last_state

g, r, h, mu = 9.81, 1.25e-2, 2e-3, 0.05
COIN = {"mass": 5e-3, "radius": r, "thickness": h}
UPRIGHT = [0, pi / 2, 0]


def on_rough_floor(release, until, **floor):
    """Return the toss of a coin on the floor from its start, and where the modes after it begin."""
    floor = {"contact": "coulomb", "friction": mu, "restitution": 0.5, **floor}
    return analytic.toss(scenario(coin=COIN, floor=floor, release=release, ending={"until": until}))


def lying(**release):
    return on_rough_floor({"position": [0, 0, h / 2], **release}, "3 s")


def time_of_rest(toss):
    return toss.path.started.times[np.flatnonzero(toss.path.started.modes == Mode.RESTING)[0]]


def test_a_coin_that_lies_slides_as_a_point_on_the_floor():
    """It stops after v/(μ g), v²/(2 μ g) away; its speed falls evenly."""
    v = 0.5
    toss = lying(velocity=[v, 0, 0])
    assert toss.ending == Ending.LYING
    assert toss.end_time < 1e-6
    assert toss.path_end == 3
    assert time_of_rest(toss) == pytest.approx(v / (mu * g), rel=1e-6)
    position, velocity, spin = last_state(toss)
    assert position == pytest.approx([v**2 / (2 * mu * g), 0, h / 2], rel=1e-6, abs=1e-12)
    assert not np.append(velocity, spin).any()
    times = np.linspace(0.1, 0.9, 9) * v / (mu * g)
    assert toss.sample(times).velocity[:, 0] == pytest.approx(v - mu * g * times, rel=1e-6)
    assert toss.floor_force(times) == pytest.approx(
        np.tile(COIN["mass"] * g * np.array([-mu, 0, 1]), (9, 1)), abs=1e-12
    )
    assert toss.floor_force(2.5)[0] == pytest.approx([0, 0, COIN["mass"] * g])


def test_sliding_and_spin_of_a_coin_that_lies_end_together():
    """Their ratio v/(r ω) becomes 0.653, however it starts: Farkas et al. 2003."""
    for v in (0.3, 1.0):
        toss = lying(velocity=[0, v, 0], angular_velocity=[0, 0, 40.0])
        before = toss.sample(time_of_rest(toss) - 1e-5)
        ratio = np.linalg.norm(before.velocity[0]) / (r * abs(before.angular_velocity[0, 2]))
        assert ratio == pytest.approx(0.653, abs=1e-3)


def test_a_coin_on_its_edge_with_backspin_stops_where_friction_has_taken_both():
    """v = √(2 μ g d) and ω = 2 v/r: v falls by μ g, the backspin by 2 μ g/r, and both are gone at d."""
    d = 0.4
    v = sqrt(2 * mu * g * d)
    release = {"position": [0, 0, r], "velocity": [v, 0, 0], "angles": UPRIGHT}
    toss = on_rough_floor({**release, "angular_velocity": [0, 0, 2 * v / r]}, 3)
    assert (toss.outcome, toss.ending) == (Outcome.EDGE, Ending.STANDING)
    times = np.linspace(0.1, 0.9, 9) * v / (mu * g)
    found = toss.sample(times)
    assert found.position[:, 0] == pytest.approx(v * times - mu * g * times**2 / 2, rel=1e-6)
    assert found.angular_velocity[:, 2] == pytest.approx(2 * (v - mu * g * times) / r, rel=1e-6)


def test_friction_turns_a_coin_with_backspin_about_the_vertical_ever_faster():
    """N of its rims differs by the gyroscopic moment J_ζ ω Ω, and so does friction: Ω' = μ ω J_ζ/J_ξ Ω.

    It is said to stand, and falls.
    """
    v, rough = 1.25, 0.2
    release = {"position": [0, 0, r], "velocity": [v, 0, 0], "angles": UPRIGHT}
    toss = on_rough_floor({**release, "angular_velocity": [0, 0, 2 * v / r]}, 3, friction=rough)
    assert (toss.outcome, toss.ending) == (Outcome.EDGE, Ending.STANDING)
    times = np.linspace(0.1, 0.2, 11)
    found = toss.sample(times)
    e, w = found.quaternion, found.angular_velocity
    turning = np.array([np.array(rotation_matrix(tuple(e[i])))[2] @ w[i] for i in range(len(times))])
    J, spin = toss.scenario.body.inertia, 2 * (v - rough * g * times) / r
    expected = rough * J[2][2] / J[0][0] * (spin[1:] + spin[:-1]) / 2
    grown = np.diff(np.log(np.abs(turning))) / np.diff(times)
    assert grown == pytest.approx(expected, rel=0.02)
    assert last_state(toss)[0][2] < r / 2


@pytest.mark.parametrize("until", [0.5, 60])
def test_a_coin_that_rolls_on_its_edge_rolls_on(until):
    v = 0.3
    release = {"position": [0, 0, r], "velocity": [v, 0, 0], "angles": UPRIGHT}
    toss = on_rough_floor({**release, "angular_velocity": [0, 0, -v / r]}, until, friction=0.2)
    assert toss.ending == Ending.STANDING
    position, velocity, spin = last_state(toss)
    assert toss.path_end == until
    assert position == pytest.approx([v * until, 0, r], rel=1e-9, abs=1e-9)
    assert velocity == pytest.approx([v, 0, 0], abs=1e-9)
    assert spin == pytest.approx([0, 0, -v / r], rel=1e-9, abs=1e-9)


def test_a_coin_on_a_smooth_floor_in_air_bounces_and_wobbles_on():
    toss = analytic.toss(load("fig24a").replace("ending.until", "3 s"))
    assert toss.path_end == 3
    assert len(toss.later_times) > 10
    assert np.all(toss.later_times > toss.end_time)
    times = np.linspace(0, 3, 3000)
    heights = toss.sample(times).position[:, 2]
    assert heights.min() > 0.99 * toss.scenario.coin.thickness / 2
    after = heights[times > toss.end_time]
    assert after.max() < 2 * toss.scenario.coin.radius
    # It has bounced low ever since, and wobbles in contact at the end.
    assert toss.later.contacts[-1, 1] == 3


def test_where_a_coin_lifts_off_it_does_not_bounce():
    toss = analytic.toss(cases()["smooth"].replace("ending.until", 0.85))
    lifts_off = toss.later.contacts[:, 1]
    assert (lifts_off < toss.path_end).sum() > 0
    assert not np.isin(toss.later_times, lifts_off).any()


def test_a_coin_that_never_rests_is_followed_for_a_named_time():
    """On a smooth floor in vacuum a coin that lies slides for ever."""
    release = {"position": [0, 0, h / 2], "velocity": [0.5, 0, 0]}
    toss = analytic.toss(scenario(coin=COIN, release=release, ending={"until": "rest"}))
    assert toss.path_end == toss.end_time + REST_WAIT
    assert last_state(toss)[0][0] == pytest.approx(0.5 * toss.path_end, rel=1e-12)


def test_a_coin_that_wobbles_for_ever_is_followed_for_a_budget_of_steps():
    case = load("contact_smooth").replace("ending.until", 40)
    few = analytic.AnalyticSettings(contact_steps=500)
    toss = analytic.toss(case, settings=few)
    assert toss.end_time < toss.path_end < 40
    more = analytic.toss(case, settings=analytic.AnalyticSettings(contact_steps=500 * FOLLOWED))
    assert toss.path_end < more.path_end


def test_a_caught_coin_stays_in_the_hand():
    case = load("fig24a").replace("ending.caught", 0.2, "release.position.z", 0.5, "ending.until", 2)
    toss = analytic.toss(case)
    assert toss.ending == Ending.CAUGHT
    states = toss.sample([toss.end_time, 1.5, 2])
    assert np.ptp(states.position, axis=0).max() == 0
    assert states.position[0, 2] == pytest.approx(0.2)
    assert not toss.floor_force([1.5, 2]).any()
