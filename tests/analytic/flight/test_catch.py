"""The flight to a hand, on a parabola."""

import numpy as np
import pytest

from cointoss.analytic.flight.catch import fly_to_hand
from cointoss.analytic.toss import state_at_release
from tests.helpers.draws import scenario

HEIGHT, G = 0.5, 9.81


@pytest.mark.parametrize(
    ("above", "upwards", "is_caught"),
    [
        (0.0, 2.0, True),
        (-0.1, 2.0, True),
        (0.0, -2.0, False),
        (-0.1, -2.0, False),
        (0.1, -2.0, True),
    ],
)
def test_a_coin_is_caught_as_it_comes_down_to_the_hand_and_never_from_below(above, upwards, is_caught):
    """It comes down with v² = v_0² + 2 g z, z above the hand; else its state stays as given."""
    release = {"position": [0, 0, HEIGHT + above], "velocity": [0, 0, upwards]}
    case = scenario(release={**release, "angular_velocity": [0, 5.0, 0]})
    y = state_at_release(case.release)
    falling = (upwards**2 + 2 * G * above) ** 0.5
    due = ((upwards + falling) / G, HEIGHT, -falling) if is_caught else (np.inf, *y[[2, 5]])
    assert (fly_to_hand(case.body, HEIGHT, y, 10.0), y[2], y[5]) == pytest.approx(due, rel=1e-12)
