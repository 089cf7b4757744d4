"""What both engines must do alike where a coin stays on the floor: slide, stick, roll, stand upright."""

from functools import cache

import numpy as np
import pytest

from compare.engines import Engine
from models.laws import ContactLaw
from models.records import Ending, Outcome
from tests.helpers import engines
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario
from tests.helpers.engines import as_releases
from tests.helpers.symmetries import SYMMETRIES

BALANCED, IMPERFECT = ZLOTY, {**ZLOTY, "center_of_mass": PAPER_OFFSET}
LOW = {
    "position": [0.0, 0.0, 0.05],
    "velocity": [0.1, -0.2, 0.0],
    "quaternion": list(scenario(release={"angles": [0.4, 0.6, 0.1]}).release.attitude),
    "angular_velocity": [5.0, 10.0, -3.0],
}
NEARLY_UPRIGHT = {
    "position": [0.0, 0.0, 1.35e-2],
    "velocity": [0.0, 0.0, 0.0],
    "quaternion": list(scenario(release={"angles": [0, np.pi / 2 - 0.03, 0.3]}).release.attitude),
    "angular_velocity": [15 * np.sin(0.3), 15 * np.cos(0.3), 0.0],
}
CASES = {
    "slides on a smooth floor": (IMPERFECT, "smooth", LOW),
    "sticks after sliding": (IMPERFECT, "coulomb", LOW),
    "sticks after sliding, balanced": (BALANCED, "coulomb", LOW),
    "rolls on a perfectly rough floor": (IMPERFECT, "perfectly_rough", LOW),
    "upright on a smooth floor": (BALANCED, "smooth", NEARLY_UPRIGHT),
    "upright on a rough floor": (BALANCED, "coulomb", NEARLY_UPRIGHT),
}
BOTH = [pytest.param(engine, name, id=f"{engine}-{name}") for engine in Engine for name in CASES]


def described(name, release=None):
    coin, law, at_release = CASES[name]
    floor = {"restitution": 0.5, "contact": law, "friction": 0.3}
    return scenario(coin=coin, air=AIR, floor=floor, release=release or at_release)


@cache
def toss(engine, name):
    return engines.toss(engine, described(name))


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_contacts_and_impacts_follow_one_another(engine, name):
    tossed = toss(engine, name)
    impacts, (starts, ends) = tossed.impacts.time, tossed.contacts.T
    assert len(impacts) >= 2
    assert len(starts) >= 1
    assert np.all(np.diff(impacts) > 0)
    assert np.all(starts < ends)
    assert np.all(starts[1:] >= ends[:-1])
    assert 0 < impacts[0] < starts[0]
    assert max(impacts[-1], ends[-1]) <= tossed.end_time
    during = (impacts[:, None] > starts) & (impacts[:, None] < ends)
    assert not during.any()


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_a_toss_that_stays_on_the_floor_is_decided_there(engine, name):
    tossed = toss(engine, name)
    if "upright" in name:
        assert tossed.outcome == Outcome.EDGE
    else:
        up = tossed.sample(tossed.end_time).normal[0, 2]
        assert tossed.outcome == (Outcome.HEADS if up > 0 else Outcome.TAILS)
    assert tossed.ending in (Ending.SETTLED, Ending.PAPER, Ending.LYING, Ending.STANDING)
    assert described(name).floor.contact == ContactLaw[CASES[name][1].upper()]


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize(
    ("name", "symmetry"),
    [
        ("slides on a smooth floor", "a turn about the vertical"),
        *(("sticks after sliding", name) for name in SYMMETRIES if not SYMMETRIES[name].balanced),
        *(("sticks after sliding, balanced", name) for name in SYMMETRIES if SYMMETRIES[name].balanced),
        *(("upright on a smooth floor", name) for name in SYMMETRIES),
    ],
)
def test_a_symmetry_of_the_release_is_one_of_the_whole_toss(engine, name, symmetry):
    """Its impacts until the coin stays on the floor, and how it ends; a rattle's later impacts are many."""
    change, here = SYMMETRIES[symmetry], toss(engine, name)
    there = engines.toss(engine, described(name, change.release(CASES[name][2])))
    n = min(6, int(np.sum(here.impacts.time < here.contacts[0, 0])))
    assert n >= 3
    # Rounding moves MuJoCo's first step in a contact, and six impacts multiply it: at most 7e-8 s, 2e-6.
    late, part = {Engine.ANALYTIC: (1e-10, 1e-9), Engine.MUJOCO: (5e-7, 2e-5)}[engine]
    assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], abs=late)
    expected = change.vector(here.impacts.impulse[:n])
    assert np.abs(there.impacts.impulse[:n] - expected).max() < part * np.abs(expected).max()
    swap = str.maketrans("HT", "TH") if change.swaps_faces else {}
    assert there.sequence[:n] == here.sequence[:n].translate(swap)
    assert there.contacts[0, 0] == pytest.approx(here.contacts[0, 0], abs=late)
    assert there.ending == here.ending
    swapped = {Outcome.HEADS: Outcome.TAILS, Outcome.TAILS: Outcome.HEADS} if change.swaps_faces else {}
    assert there.outcome == swapped.get(here.outcome, here.outcome)
    # An ending is noticed at the end of a step.
    assert there.end_time == pytest.approx(here.end_time, abs=0.01)


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_one_of_many_tosses_is_that_of_toss_to_the_bit(engine, name):
    drawn = [CASES[name][2], SYMMETRIES["a turn about the vertical"].release(CASES[name][2])]
    outcomes = engines.toss_many(engine, described(name), as_releases(drawn))
    for i, release in enumerate(drawn):
        tossed = engines.toss_as_many(engine, described(name, release))
        assert len(tossed.contacts) > 0
        assert outcomes.outcome[i] == tossed.outcome
        assert outcomes.ending[i] == tossed.ending
        assert outcomes.impacts[i] == len(tossed.impacts) > 0
        assert outcomes.last_face[i] == tossed.impacts.face[-1]
        assert outcomes.end_time[i] == tossed.end_time
