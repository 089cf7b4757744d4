"""The study of general coins: its classes and releases, its replays, its claims, its tables and its page."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import events, runs
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.runs import run
from cointoss.analytic.settings import MANY
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.general_coins import CLASSES
from cointoss.compare.reproduction.studies import general_coins
from cointoss.compare.reproduction.studies.general_coins import (
    ClassCosts,
    GeneralCosts,
    TossParts,
    call_time,
    compute,
    joined,
    pieces_of,
    replay,
    replay_contacts,
    replay_flights,
    replay_impacts,
    timed_toss,
)
from cointoss.models.records import Ending, Outcome
from tests.helpers.pages import saved
from tests.helpers.studies import result_of

SAVED = read_numbers(saved("general-coins"), GeneralCosts)
FAST = ClassCosts(
    tosses=2,
    mean=4e-4,
    median=3e-4,
    percentile_99=6e-4,
    worst=7e-4,
    parts=TossParts(flight=1e-4, impact=5e-5, contact=2e-4),
    ends={"heads, settled": 2},
)
ALL_FAST = GeneralCosts({kind.name: FAST for kind in CLASSES})
IN_AIR = [kind for kind in CLASSES if kind.air]


def as_written(function: Any) -> Any:
    return function.py_func


def test_the_saved_numbers_are_of_all_classes():
    assert list(SAVED.classes) == [kind.name for kind in CLASSES]
    assert all(sum(one.ends.values()) == one.tosses for one in SAVED.classes.values())


def test_the_classes_are_the_corners_of_coin_air_and_floor():
    assert len({kind.name for kind in CLASSES}) == 16
    centers = {kind.scenario.coin.center_of_mass for kind in CLASSES}
    assert centers == {(0.0, 0.0, 0.0), (-1e-3, -1e-3, 0.0), (-1e-3, -1e-3, -2e-4)}
    for kind in CLASSES:
        scenario = kind.scenario
        assert ("thick" in kind.name) == (scenario.coin.thickness == 2e-3)
        assert ("vacuum" in kind.name) == (scenario.air.normal == scenario.air.tangential == 0)
        assert (scenario.floor.friction == 0.2) == (str(scenario.floor.contact) == "coulomb")
        assert scenario.floor.restitution == 0.6


def test_releases_are_those_of_the_class_and_spread_as_they_should():
    first, again, other = (kind.starts(4000) for kind in (CLASSES[0], CLASSES[0], CLASSES[1]))
    assert (first == again).all()
    assert (first != other)[:, 2:].all()
    assert first[:, 2].min() == pytest.approx(0.2, abs=1e-3)
    assert first[:, 2].max() == pytest.approx(0.6, abs=1e-3)
    # Normal numbers: within five standard errors.
    assert first[:, 3:6].std(axis=0) == pytest.approx([0.3] * 3, rel=5 / np.sqrt(8000))
    assert first[:, [10, 12]].std(axis=0) == pytest.approx([10, 10], rel=5 / np.sqrt(8000))
    assert first[:, 11].min() == pytest.approx(20, abs=0.1)
    assert first[:, 11].max() == pytest.approx(60, abs=0.1)
    # Uniform over all attitudes: the components of a unit 4-vector have the variance 1/4.
    assert (first[:, 6:10] ** 2).mean(axis=0) == pytest.approx([0.25] * 4, abs=0.02)


@pytest.mark.parametrize("kind", [IN_AIR[0], IN_AIR[-1]], ids=lambda kind: kind.name)
def test_a_replay_is_the_motion_of_the_toss(kind, monkeypatch):
    """Where a piece ends, the next one starts, but for a height that rounding moves.

    All run as written: the library calls musl's sine, what numba compiles the system's.
    """
    monkeypatch.setattr(runs, "toss_coin", events.toss_coin)
    body, rules = kind.scenario.body, kind.scenario.rules
    bounces, contacts = 0, 0
    for start in kind.starts(6):
        pieces = pieces_of(kind.scenario, start)
        ends = run(body, rules, start).start_states[1:]
        held = pieces.modes != Mode.FLIGHT
        bounced = ~held & np.append(~held[1:], False)
        flown, followed = pieces.of(bounced), pieces.of(held)
        touches = np.zeros(len(flown.modes), dtype=np.bool_)
        as_written(replay_flights)(body, rules, flown.start_times, flown.states, touches)
        assert touches.all()
        as_written(replay_impacts)(body, rules, flown.states, touches)
        assert np.array_equal(flown.states[:, 3:], ends[bounced, 3:])
        assert (np.abs(flown.states[:, :3] - ends[bounced, :3]) < 1e-12).all()
        as_written(replay_contacts)(body, rules, MANY.contact_tolerance, *followed)
        # Where slip stops, the velocity and the spin change at once.
        assert (np.abs(followed.states[:, 6:10] - ends[held, 6:10]) < 1e-12).all()
        bounces, contacts = bounces + len(flown.modes), contacts + len(followed.modes)
    assert bounces > 10
    assert contacts > 3


def test_the_pieces_of_several_tosses_are_replayed_together():
    kind = IN_AIR[0]
    tosses = [pieces_of(kind.scenario, start) for start in kind.starts(2)]
    pieces = joined(tosses)
    assert len(pieces.modes) == sum(len(toss.modes) for toss in tosses)
    before = pieces.states.copy()
    assert (replay(kind.scenario, pieces) > 0).all()
    assert (pieces.states == before).all()


def test_a_timed_toss_is_one_of_many():
    kind = IN_AIR[0]
    tossed = analytic.toss_rows(kind.rows(4))
    timed = [timed_toss(kind.scenario.body, kind.scenario.rules, start) for start in kind.starts(4)]
    ends = zip(tossed.outcome, tossed.ending, strict=True)
    assert [end for _, end in timed] == [f"{Outcome(o)}, {Ending(e)}" for o, e in ends]
    # A call makes no flight: least of all does it take as long as the longest toss.
    assert 0 < call_time(kind.scenario, kind.starts(1)[0]) < max(time for time, _ in timed)


@pytest.mark.parametrize(
    ("name", "changed", "missed"),
    [
        ("thick, imperfect, air, coulomb", {"mean": 6e-4}, "mean in air"),
        ("thin, ideal, air, coulomb", {"percentile_99": 1.1e-2}, "99th percentile in air"),
        ("thin, imperfect, vacuum, coulomb", {"median": 1.1e-3}, "median in vacuum"),
        ("thin, ideal, air, smooth", {"worst": 1.1}, "no toss takes more than 1 s"),
        ("thin, ideal, air, smooth", {"ends": {"undecided, contact_steps": 2}}, "no toss stays undecided"),
    ],
)
def test_a_bar_is_missed_by_one_class_that_is_too_slow(name, changed, missed):
    assert all(claim.holds for claim in result_of("general-coins", ALL_FAST).claims)
    slow = GeneralCosts({**ALL_FAST.classes, name: replace(FAST, **changed)})
    found = result_of("general-coins", slow).claims
    assert [missed in claim.claim for claim in found if not claim.holds] == [True]


def test_a_small_study_is_made(monkeypatch):
    monkeypatch.setattr(general_coins, "CLASSES", tuple(IN_AIR[:2]))
    told = []
    study = compute(lambda *progress: told.append(progress), 2)
    assert told == [(i, 4) for i in range(1, 5)]
    assert [one.tosses for one in study.classes.values()] == [2, 2]
