"""The study of spun coins: what it counts, its symmetry, and claims that a coin as is told would change."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.shares.shares import shares
from cointoss.models.batch import rows_from_states
from cointoss.models.records import Outcome
from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.setups.ends import by_outcome, ended_as, tosses
from cointoss_reproduction.studies.spun.study import (
    EDGES,
    FAR,
    NARROW,
    OFFSETS,
    SpunRecord,
    compute,
    plan_of,
    tails,
)
from saved import missed, saved, unseen

SAVED = read_numbers(saved("spun"), SpunRecord)
THIN = list(EDGES)[-1]


def test_spins_are_counted_as_shares_are():
    plan = plan_of(THIN, "± 10°", OFFSETS[-1], 30)
    counted = shares(plan.scenario, hand=plan.hand, tosses=30, seed=plan.seed)["count"].values
    found = by_outcome(plan)
    assert [ended_as(found, outcome) for outcome in Outcome] == counted.tolist()
    assert tosses(found) == 30


def test_each_offset_has_draws_of_its_own():
    assert len({plan_of(THIN, "± 1°", offset, 1).seed for offset in OFFSETS}) == len(OFFSETS)


def test_a_coin_turned_over_with_its_mass_centre_shows_the_other_side():
    """A half turn about a diameter swaps the sides; ζ of C changes its sign, and so does the vertical's."""
    setting = plan_of(THIN, "± 10°", OFFSETS[-1], 40).setting(0)
    start = setting.hand.states(setting.scenario.body, np.random.default_rng(1), 40)
    other = setting.scenario.replace("coin.center_of_mass.zeta", -OFFSETS[-1])
    e0, e1, e2, e3 = start[:, 6:10].T
    # e times a half turn about ξ of the body.
    attitude = np.column_stack([-e1, e0, e3, -e2])
    over = np.hstack([start[:, :6], attitude, start[:, 10:] * [1, -1, -1]])
    ended, swapped = (
        analytic.toss_rows(rows_from_states(scenario, states)).outcome
        for scenario, states in ((setting.scenario, start), (other, over))
    )
    sides = {Outcome.HEADS: Outcome.TAILS, Outcome.TAILS: Outcome.HEADS}
    alike = [one == sides.get(Outcome(two), Outcome(two)) for one, two in zip(ended, swapped, strict=True)]
    # Rounding may decide a toss that goes on for long.
    assert np.mean(alike) > 0.8
    assert {Outcome.HEADS, Outcome.TAILS} <= set(ended.tolist())


def test_a_small_run_counts_every_kind():
    found = compute(unseen, parts=1000, mujoco=1)
    assert [tosses(ends) for by_offset in found.ends.values() for ends in by_offset.values()] == [
        *4 * [1],
        *4 * [2],
        *4 * [1],
        *4 * [2],
    ]
    assert [tosses(ends) for ends in found.mujoco.values()] == [1, 1]


def test_a_coin_as_is_told_would_be_seen():
    told = {"heads": 200, "tails": 800}
    assert tails(told).value == pytest.approx(0.8)
    everywhere = {name: dict.fromkeys(by_offset, told) for name, by_offset in SAVED.ends.items()}
    wrong = missed("spun", replace(SAVED, ends=everywhere))
    assert any("folklore" in claim for claim in wrong)
    even = {**SAVED.ends, NARROW: {**SAVED.ends[NARROW], FAR: {"heads": 500, "tails": 500}}}
    assert any("narrow edge" in claim for claim in missed("spun", replace(SAVED, ends=even)))
