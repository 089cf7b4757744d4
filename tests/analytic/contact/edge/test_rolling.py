"""The phases of a coin that rolls on its edge: what its energy leaves it there."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.edge.rolling import roll_by, set_roll_rate
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import both_rims
from cointoss.models.attitude import rotation_matrix
from cointoss.models.barriers import energy
from tests.helpers.contacts import held, set_upright, upright_coin
from tests.helpers.draws import IMPERFECT, ZLOTY, scenario

SMOOTH = FloorFriction(0.0)


def energy_and_turning(body, y):
    up, w = np.array(rotation_matrix(tuple(y[6:10]))[2]), y[10:13]
    return energy(body, y[2], tuple(y[3:6]), tuple(w)), up @ np.array(body.inertia) @ w


@pytest.mark.parametrize("half_angle", [0.3, 1.0, 1.5, 2.4])
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_on_a_smooth_floor_a_coin_keeps_its_energy_and_its_turning_in_every_phase(half_angle, direction):
    """Its mass centre is off its middle, so that it rises and falls; it rolls either way."""
    body = scenario(coin=IMPERFECT).body
    y, phase = upright_coin(body, 0.4, 12.0, 40.0), np.empty(13)
    y[3:5] = 0.0
    before, L_z = energy_and_turning(body, y)
    rate = roll_by(held(body, SMOOTH, Mode.SLIDING, y), True, y, half_angle, phase)
    set_roll_rate(body, L_z, False, direction * rate, phase)
    up = np.array(rotation_matrix(tuple(phase[6:10]))[2])
    phase[5] = np.cross(up, phase[10:13]) @ body.center
    for rim in both_rims(body, SMOOTH, phase):
        assert rim.velocity[2] == pytest.approx(0, abs=1e-12)
        assert rim.arm[2] + phase[2] == pytest.approx(0, abs=1e-12)
    after, turning = energy_and_turning(body, phase)
    assert rate > 10
    assert turning == pytest.approx(L_z, rel=1e-12)
    assert after == pytest.approx(before, rel=1e-12)


@pytest.mark.parametrize(("mode", "inertia"), [(Mode.STICKING, 1.5), (Mode.SLIDING, 0.5)])
def test_on_a_rough_floor_all_energy_may_go_into_the_roll(mode, inertia):
    """Of a coin with ω = v/r it is 3/4 m v²; the roll inertia in m r² is 3/2 where it sticks."""
    body, speed, phase = scenario(coin=ZLOTY).body, 0.3, np.empty(13)
    y = set_upright(ZLOTY, speed, (0.0, 0.0, -speed / body.radius))
    rate = roll_by(held(body, FloorFriction(0.5), mode, y), False, y, 0.7, phase)
    assert rate == pytest.approx((1.5 / inertia) ** 0.5 * speed / body.radius, rel=1e-12)
