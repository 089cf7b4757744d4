"""The side that was up at the release, after bounces on a smooth floor and in a hand that catches."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.first_side import caught_side, first_side
from cointoss.models.batch import rows_from_states
from cointoss.models.hand import Hand, same_side_probability
from cointoss.models.reading import load


@pytest.mark.parametrize("engine", list(Engine))
def test_on_a_smooth_floor_a_wobbling_coin_ends_as_it_started(engine):
    """The angular momenta about its normal and about the vertical keep their signs."""
    scenario = load("fig29").replace("floor.restitution", 0.5)
    count = 200 if engine == Engine.ANALYTIC else 20
    states = Hand(height=0.3, psi=np.radians(60)).states(scenario.body, np.random.default_rng(5), count)
    found = first_side(rows_from_states(scenario, states), engine)
    assert found.at_rest.all()
    assert len(found.at_rest) == count
    # Not yet at the touches before.
    assert all(0.3 < up.mean() < 0.95 for up in found.touches)
    assert len(found.touches) == 4


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
