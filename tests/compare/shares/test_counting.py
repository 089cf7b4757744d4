"""Counts of a hand's tosses: the same whoever tosses, in whatever parts, and as many as are needed."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.shares import counting
from cointoss.compare.shares import shares as public
from cointoss.compare.shares.counting import BLOCK, Block, Count, draws, toss_blocks, toss_here
from cointoss.compare.shares.plan import plan_of
from cointoss.compare.shares.shares import shares
from cointoss.compare.shares.show import csv, markdown
from cointoss.models.hand import Hand
from cointoss.models.records import Outcome
from tests.helpers.draws import AIR, scenario

DISC = scenario(
    coin={"thickness": 5e-3},
    air=AIR,
    floor={"contact": "coulomb", "friction": 0.3, "rolling_friction": 1e-4, "pivoting_friction": 1e-4},
    ending={"max_time": 60.0},
)
SMOOTH = scenario(coin={"thickness": 5e-3}, air=AIR)
"""It comes to its end the soonest."""


def last(plan, tosser=toss_here):
    return list(counting.counting(plan, tosser))[-1]


def plan(**others):
    given = {"name": "", "hand": Hand(), "tosses": 3 * BLOCK[Engine.ANALYTIC] + 10, "seed": 4, "to": None}
    return plan_of({"floor.restitution": "0.3:0.7:3"}, SMOOTH, **(given | others))


def test_the_counts_depend_on_no_order_and_on_no_size_of_parts(monkeypatch):
    def scattered(plan, engine, blocks):
        parts = sorted(((one,) for one in blocks), reverse=True)
        return ((part, toss_blocks(plan, engine, part)) for part in parts)

    monkeypatch.setitem(BLOCK, Engine.ANALYTIC, 25)
    for given in (plan(tosses=35), plan(to=0.17, tosses=75)):
        expected = last(given)
        assert np.array_equal(last(given, scattered), expected)
        with monkeypatch.context() as patched:
            patched.setattr(counting, "MOST", 1)
            assert np.array_equal(last(given), expected)
    assert last(plan(tosses=35)).sum(axis=-1).tolist() == [[35, 35, 35]]


def test_settings_blocks_and_engines_have_draws_of_their_own():
    given = plan(engines=tuple(Engine))
    blocks = [Block(setting, number) for setting in range(3) for number in range(2)]
    first = [float(draws(given, engine, block).random()) for engine in Engine for block in blocks]
    assert len(set(first)) == 12
    assert draws(plan(seed=5), Engine.ANALYTIC, blocks[0]).random() not in first


def test_counting_stops_at_the_first_block_that_makes_the_interval_narrow_enough():
    found = shares(SMOOTH, {"floor.restitution": (0.3, 0.7, 2)}, to=0.06, seed=1)
    widest = ((found.high - found.low) / 2).max("outcome")
    assert ((0.036 < widest) & (widest <= 0.06)).all()
    assert (found["count"].sum("outcome") % BLOCK[Engine.ANALYTIC] == 0).all()
    assert found.attrs["complete"] == 1


def test_a_share_that_is_known_at_once_takes_a_block():
    """All coins that are caught at their release's height and turn little are as they were."""
    found = shares("fig29", hand=Hand(psi=0.1, caught=1.0, scatter=0.01), to=0.02)
    assert found["count"].values.tolist() == [0, BLOCK[Engine.ANALYTIC], 0, 0, 0, 0]


def test_an_interrupt_returns_what_is_counted(monkeypatch):
    def interrupted(given):
        yield next(counting.counting(given))
        raise KeyboardInterrupt

    monkeypatch.setattr(public, "counting", interrupted)
    found = shares(DISC, {"floor.restitution": "0.3:0.7:3"}, tosses=500)
    assert [*found["count"].sum("outcome").values, found.attrs["complete"]] == [250, 0, 0, 0]
    assert markdown(found).count("| 0 | - | - | - |") == 2
    assert csv(found).count("nan") >= 2
    assert np.isnan(found.share.values[2]).all()
    monkeypatch.setattr(public, "counting", lambda _: (_ for _ in ()).throw(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        shares(DISC)


@pytest.mark.parametrize(
    ("to", "tosses", "made", "needed", "is_enough"),
    [
        (None, 760, 0, 760, False),
        (None, 760, 759, 760, False),
        (None, 760, 760, 760, True),
        # A share of 1/2 of n is known to Z/2 over the root of n + Z², by Wilson; the root of n grows with it.
        (0.1, 10_000, 250, 250, True),
        (0.04, 10_000, 0, 1010, False),
        (0.04, 10_000, 250, 1010, False),
        (0.04, 500, 250, 500, False),
        (0.0405, 10_000, 1000, 1005, False),
        (0.0407, 10_000, 1000, 1000, True),
    ],
)
def test_as_many_tosses_are_needed_as_make_the_interval_narrow(to, tosses, made, needed, is_enough):
    one = Count(plan(to=to, tosses=tosses), Engine.ANALYTIC)
    one.counts[[Outcome.HEADS, Outcome.TAILS, Outcome.EDGE]] = made // 2, made - made // 2, 0
    assert one.is_enough is is_enough
    assert one.needed == needed


def test_blocks_count_in_their_order_until_it_is_enough():
    one = Count(plan(to=0.06, tosses=10_000), Engine.ANALYTIC)
    block = np.array([0, 125, 125, 0, 0, 0])
    given = ((1, 0, 0), (2, 0, 0), (0, 2, 500), (3, 2, 500))
    for number, blocks, tosses in given:
        one.add(number, block)
        assert (one.blocks, one.tosses) == (blocks, tosses), number


@pytest.mark.parametrize(
    ("coin", "vary", "hand", "is_left_out"),
    [
        (DISC, {}, Hand(), False),
        (DISC, {}, Hand(caught=1.0), True),
        (DISC, {"ending.caught": "0.5:1:2"}, Hand(), True),
        (DISC.replace("ending.caught", 0.5), {}, Hand(), True),
    ],
)
def test_what_is_undecided_is_left_out_where_any_hand_catches(coin, vary, hand, is_left_out):
    counts = np.array([3, 4, 5, 0, 0, 0])
    left = plan_of(vary, coin, tosses=1, to=None, name="", hand=hand).counted(counts)
    assert left.tolist() == [0 if is_left_out else 3, 4, 5, 0, 0, 0]
