"""The flight to a hand, on a parabola."""

import numpy as np
import pytest

from cointoss.analytic.flight.catch import fly_to_hand
from cointoss.analytic.toss import state_at_release
from tests.helpers.draws import scenario

HEIGHT, SPEED, G = 0.5, 2.0, 9.81


def thrown(height, speed):
    release = {"position": [0, 0, height], "velocity": [0, 0, speed], "angular_velocity": [0, 5.0, 0]}
    case = scenario(release=release)
    return case.body, state_at_release(case.release)


@pytest.mark.parametrize("below", [0.0, 0.1])
def test_a_coin_thrown_up_from_the_hand_or_below_is_caught_as_it_comes_down(below):
    body, y = thrown(HEIGHT - below, SPEED)
    falling = (SPEED**2 - 2 * G * below) ** 0.5
    assert fly_to_hand(body, HEIGHT, y, 10.0) == pytest.approx((SPEED + falling) / G, rel=1e-12)
    assert (y[2], y[5]) == pytest.approx((HEIGHT, -falling), rel=1e-12)


@pytest.mark.parametrize("below", [0.0, 0.1])
def test_a_coin_thrown_down_from_the_hand_or_below_never_comes_down_to_it(below):
    body, y = thrown(HEIGHT - below, -SPEED)
    as_given = y.copy()
    assert fly_to_hand(body, HEIGHT, y, 10.0) == np.inf
    assert np.array_equal(y, as_given)


def test_a_coin_thrown_down_from_above_the_hand_is_caught_at_once_on_its_way():
    body, y = thrown(HEIGHT + 0.1, -SPEED)
    falling = (SPEED**2 + 2 * G * 0.1) ** 0.5
    assert fly_to_hand(body, HEIGHT, y, 10.0) == pytest.approx((falling - SPEED) / G, rel=1e-12)
