"""Contact that repeats itself: an ideal coin's in vacuum, after one period."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.periodic import record_tilt, repeats, start_tilt_history
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import lean_and_rate
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from tests.helpers.contacts import follow_step, held, put_on_floor
from tests.helpers.draws import AIR, THIN, scenario

SMOOTH = FloorFriction(0.0)


def wobbling(body, mode):
    y = np.array([0, 0, 0, 0, 0, 0, *quaternion_from_angles((0.0, 0.9, 0.0)), 2.0, 9.0, 4.0])
    put_on_floor(body, FloorFriction(0.0), mode, y)
    return y


def repeats_at(history, y):
    record_tilt(history, y)
    return repeats(history)


@pytest.mark.parametrize(("mode", "mu"), [(Mode.SLIDING, 0.0), (Mode.STICKING, 50.0)])
def test_after_a_period_the_tilt_and_its_rate_are_those_before(mode, mu):
    body = scenario(coin=THIN).body
    y = wobbling(body, mode)
    history = start_tilt_history(held(body, FloorFriction(mu), mode, y))
    at_turns, rates, time = [], [lean_and_rate(y)[1]], 0.0
    while not repeats_at(history, y):
        step = follow_step(body, FloorFriction(mu), mode, y, 1e-4)
        assert not step.is_over
        time += step.elapsed
        rates.append(lean_and_rate(y)[1])
        if rates[-1] * rates[-2] < 0:
            at_turns.append(rotation_matrix(tuple(y[6:10]))[2][2])
    assert time > 0.05
    assert len(at_turns) == 3
    assert at_turns[2] == pytest.approx(at_turns[0], abs=1e-5)
    assert abs(at_turns[1] - at_turns[0]) > 0.05


@pytest.mark.parametrize(
    ("coin", "air", "slope", "mode", "mu"),
    [
        ({**THIN, "center_of_mass": [-1e-3, -1e-3, 0.0]}, {}, 0.0, Mode.SLIDING, 0.0),
        (THIN, AIR, 0.0, Mode.SLIDING, 0.0),
        (THIN, {}, 0.0, Mode.SLIDING, 0.3),
        (THIN, {}, 0.0, Mode.INCIPIENT_SLIP, 0.3),
        (THIN, {}, 0.1, Mode.STICKING, 0.3),
    ],
)
def test_an_unbalanced_coin_air_friction_on_slip_and_a_slope_repeat_nothing(coin, air, slope, mode, mu):
    body = scenario(coin=coin, air=air, floor={"slope": slope}).body
    y = wobbling(body, Mode.SLIDING)
    history = start_tilt_history(held(body, FloorFriction(mu), mode, y))
    for k in range(10):
        y[10] = 2.0 * (-1) ** k
        assert not repeats_at(history, y)


@pytest.mark.parametrize(
    ("rates", "told"),
    [
        ((1e-9, -1e-12), False),
        ((1.0, -1e-9), False),
        ((1.0, 2.0), False),
        ((1.0, -2.0), True),
        ((1e-3, -1e-3), True),
    ],
)
def test_a_tilt_that_only_rounding_changes_repeats_nothing(rates, told):
    """An upright thin coin that stands still, or spins on the spot, would fall in the end."""
    body = scenario(coin=THIN).body
    y = wobbling(body, Mode.SLIDING)
    history = start_tilt_history(held(body, SMOOTH, Mode.SLIDING, y))
    up = np.array(rotation_matrix(tuple(y[6:10]))[2])
    across = np.array([-up[1], up[0], 0.0]) / np.hypot(up[0], up[1]) ** 2
    found = []
    for rate in rates * 4:
        y[10:13] = rate * across
        assert lean_and_rate(y)[1] == pytest.approx(rate)
        found.append(repeats_at(history, y))
    assert any(found) == told
