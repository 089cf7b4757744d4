"""What a film shows of the floor's action: where it acts, how fresh it is, and none on a still coin."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.film.play import SHOWN_FOR, play_of
from cointoss.models.reading import load
from cointoss.models.records import Ending
from tests.helpers.films import MadePath, made, shown


@pytest.mark.usefixtures("without_horizon")
def test_an_impulse_acts_at_a_point_of_the_coin_on_the_floor_and_fades():
    """The coin is unbalanced and turns, so that each frame of reference has its own point."""
    coin = load("fig18_3d_imperfect").replace("ending.max_impacts", 3)
    toss = analytic.toss(coin)
    first = toss.impacts.time[0]
    play = play_of(shown(toss), first + SHOWN_FOR * np.array([0.0, 0.25, 0.75]))
    acting = [play.impulses(i)[0] for i in range(3)]
    assert [each.freshness for each in acting] == pytest.approx([1, 0.75, 0.25])
    assert [each.point[2] for each in acting] == pytest.approx(3 * [0.0], abs=1e-12)
    assert np.linalg.norm(acting[0].point - toss.impacts.position[0]) == pytest.approx(
        np.linalg.norm(toss.impacts.point[0] - coin.body.center)
    )
    assert np.array_equal(acting[0].impulse, toss.impacts.impulse[0])


@pytest.mark.parametrize("end", [Ending.LYING, Ending.STANDING, Ending.AT_REST])
def test_the_floor_shows_no_action_on_a_coin_that_is_still(end):
    path = MadePath(position=(0, 0, 0.001), force=(0, 0, np.nan))
    toss = made(path, impacts=[(0.99, 1e-3)], contacts=[(0.995, 1.0)], ending=end)
    play = play_of(shown(toss), np.array([1.0, 1.1]))
    assert not play.forces.any()
    assert play.impulses(0) == play.impulses(1) == []
