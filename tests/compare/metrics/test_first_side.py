"""The side that was up at the release, after bounces on a smooth floor and in a hand that catches."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.first_side import caught_side, first_faces, first_side
from cointoss.models.answers import Answers
from cointoss.models.batch import PLACE, rows_from_states, rows_of
from cointoss.models.hand import Hand, same_side_probability
from cointoss.models.reading import load
from cointoss.models.records import Outcome

HEADS, TAILS = Outcome.HEADS, Outcome.TAILS
ATTITUDES = {(1, 0, 0, 0): HEADS, (0, 1, 0, 0): TAILS, (0, 0, 1, 0): TAILS, (0, 0, 0, 1): HEADS}
"""Half turns about ξ and η turn the coin over, one about ζ does not."""


def released(attitudes):
    """Return the rows of a coin that is released in some attitudes."""
    parts = zip(("e0", "e1", "e2", "e3"), np.transpose(attitudes), strict=True)
    given = {f"release.quaternion.{name}": values for name, values in parts}
    return rows_of(load("fig29").replace("release.quaternion", [1, 0, 0, 0]), len(attitudes), given)


def test_heads_is_up_where_the_normal_is():
    assert first_faces(released([*ATTITUDES])).tolist() == [*ATTITUDES.values()]


def test_the_first_side_is_counted_at_each_touch_and_among_those_that_end_on_a_face():
    """An engine whose coins show heads at odd touches, and end on all faces and the edge by turns."""

    def toss_rows(rows):
        impacts = np.fmin(rows[:, PLACE["ending.max_impacts"]], 3)  # none goes on to a fourth touch
        outcome = np.resize([HEADS, TAILS, Outcome.EDGE, Outcome.UNDECIDED], len(rows))
        faces = np.where(impacts % 2 == 1, HEADS, TAILS)
        columns: Any = (outcome, outcome, impacts, faces, impacts)
        return Answers(*columns)

    engine: Any = SimpleNamespace(package=SimpleNamespace(toss_rows=toss_rows))
    found = first_side(released([*ATTITUDES]), engine)
    first = np.array([*ATTITUDES.values()])
    ended = np.array([HEADS, TAILS, Outcome.EDGE, Outcome.UNDECIDED]) == first
    assert [up.tolist() for up in found.touches] == [
        (first == HEADS).tolist(),
        (first == TAILS).tolist(),
        (first == HEADS).tolist(),
        ended.tolist(),
    ]
    assert found.at_rest.tolist() == [True, True]


@pytest.mark.parametrize("engine", list(Engine))
def test_on_a_smooth_floor_a_wobbling_coin_ends_as_it_started(engine):
    """The angular momenta about its normal and about the vertical keep their signs."""
    scenario = load("fig29").replace("floor.restitution", 0.5)
    count = 200 if engine == Engine.ANALYTIC else 20
    states = Hand(height=0.3, psi=np.radians(60)).states(scenario.body, np.random.default_rng(5), count)
    found = first_side(rows_from_states(scenario, states), engine)
    assert found.at_rest.tolist() == [True] * count
    # Not yet at the touches before.
    assert all(0.3 < up.mean() < 0.95 for up in found.touches)


@pytest.mark.parametrize(("engine", "count"), [(Engine.ANALYTIC, 40_000), (Engine.MUJOCO, 200)])
@pytest.mark.parametrize("psi", [40, 50, 60, 75, 90])
def test_a_caught_coin_shows_its_first_side_as_often_as_the_theorem_says(engine, count, psi):
    """Theorem 2 of Diaconis, Holmes and Montgomery, by whole tosses to a hand in vacuum."""
    scenario = load("fig29").replace("air", {}, "ending.caught", 1.0)
    states = Hand(psi=np.radians(psi)).states(scenario.body, np.random.default_rng(11), count)
    up = caught_side(rows_from_states(scenario, states), engine)
    p = float(same_side_probability(np.radians(psi)))
    # The height of release scatters by a tenth: few tosses stay below the hand.
    assert 0.9 * count < len(up) < count
    assert abs(up.mean() - p) <= 4 * (p * (1 - p) / len(up)) ** 0.5
