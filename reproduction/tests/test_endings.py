"""The study of how tosses end: its page, its numbers, and that its check can fail."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.metrics.estimates import chance_alike
from cointoss.models.records import Outcome
from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.setups.ends import ended_as, tosses
from cointoss_reproduction.studies.endings.study import (
    BY_BOTH,
    COINS,
    COUNT,
    COUNT_MUJOCO,
    MEDIA,
    EndingCounts,
    by_both,
    compute,
    draw_for_both,
    draw_toss,
    within,
)
from saved import missed, saved

pytestmark = pytest.mark.usefixtures("without_horizon")

SAVED = read_numbers(saved("endings"), EndingCounts)


def test_the_saved_counts_are_of_all_tosses():
    assert tosses(within(SAVED.outcomes)) == len(COINS) * COUNT
    assert tosses(within(SAVED.mujoco)) == len(COINS) * COUNT_MUJOCO


def test_other_tosses_end_as_the_saved_ones_do():
    """Each share within five standard deviations of that of a hundred tosses."""
    seen: Counter[Outcome] = Counter()
    number = 50
    for coin in COINS:
        for i in range(number):
            _, scenario = draw_toss(np.random.default_rng([1, i, len(coin)]), coin)
            tossed = analytic.toss(scenario)
            assert (
                tossed.outcome != Outcome.UNDECIDED
                or scenario.coin.thickness * scenario.coin.center_of_mass[0]
            )
            assert tossed.outcome != Outcome.PERPETUAL or scenario.air.normal == 0
            seen[tossed.outcome] += 1
    for outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE, Outcome.PERPETUAL):
        ends = within(SAVED.outcomes)
        p = ended_as(ends, outcome) / tosses(ends)
        assert seen[outcome] / (2 * number) == pytest.approx(p, abs=5 * np.sqrt(p / (2 * number)))


def test_a_small_study_counts_every_toss():
    told = []
    study = compute(lambda done, whole: told.append((done, whole)), 2, 1, 3)
    assert tosses(within(study.outcomes)) == 4
    assert tosses(within(study.mujoco)) == 2
    assert told == [(2, 6), (4, 6), (5, 6), (6, 6)]


def test_a_claim_that_the_counts_do_not_bear_out_is_told():
    kind = "ideal, thin, smooth, air"
    for engine, outcomes in (("outcomes", SAVED.outcomes), ("mujoco", SAVED.mujoco)):
        changed = {**outcomes, kind: {**outcomes[kind], "perpetual, perpetual": 1000}}
        assert any(
            told.startswith("only in vacuum")
            for told in missed("endings", replace(SAVED, **{engine: changed}))
        )


def test_were_more_tosses_undecided_it_would_be_told():
    kind = "imperfect, thin, smooth, vacuum"
    for engine in ("outcomes", "mujoco"):
        of_engine = getattr(SAVED, engine)
        for more, told in ((1, ()), (10, ("at most 1 toss in 10,000 stays undecided",))):
            changed = {**of_engine, kind: {**of_engine[kind], "undecided, contact_steps": more}}
            assert missed("endings", replace(SAVED, **{engine: changed})) == told


def test_engines_that_end_otherwise_are_told_apart():
    assert chance_alike([[50, 50, 100], [55, 45, 100]]) > 0.1
    assert chance_alike([[50, 50, 100], [90, 45, 65]]) < 1e-3
    kind = "ideal, thick, smooth, air"
    changed = replace(SAVED, mujoco={**SAVED.mujoco, kind: {**SAVED.mujoco[kind], "edge, standing": 1000}})
    assert missed("endings", changed) == ("in air the engines' ends differ no more than by chance",)


def test_the_engines_are_compared_on_the_floors_that_both_realise():
    both = {f"{floor}, {medium}": by_both(SAVED, floor, medium) for floor in BY_BOTH for medium in MEDIA}
    assert list(both) == [
        "smooth, air",
        "smooth, vacuum",
        "coulomb, kinematic, air",
        "coulomb, kinematic, vacuum",
    ]
    for engine, outcomes in enumerate((SAVED.outcomes, SAVED.mujoco)):
        others = tosses(within(outcomes)) - tosses(within(outcomes, "energetic"))
        assert sum(sum(counts[engine]) for counts in both.values()) == others
    assert tosses(within(SAVED.outcomes, "energetic")) > 6000
    rng = np.random.default_rng(3)
    assert {draw_for_both(rng, COINS[1])[0].floor for _ in range(20)} == {*BY_BOTH}
