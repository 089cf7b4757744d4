"""Flights over a floor that slopes: closed forms, an independent integration, and the bounds of a search."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.flying import sample
from cointoss.analytic.toss import state_at_release
from tests.helpers.draws import IMPERFECT, ZLOTY, draw_release, scenario

G, SLOPE = 9.81, 0.4
HEAVY_AIR = {"normal": 40.0, "tangential": 10.0}
FLOOR = {"contact": "smooth", "slope": SLOPE}


def flown(body, y, times):
    """Return the states of a flight at these times, (n, 13)."""
    states = np.empty((len(times), 13))
    sample(body, y, 0.0, np.array(times), states)
    return states


@pytest.mark.parametrize("coin", [ZLOTY, IMPERFECT])
def test_a_coin_in_vacuum_moves_on_a_parabola_and_turns_as_over_a_level_floor(coin):
    release = {**draw_release(np.random.default_rng(7)), "position": [0.3, 0.1, 2.0]}
    body = scenario(coin=coin, floor=FLOOR, release=release).body
    y, t = state_at_release(scenario(release=release).release), np.linspace(0.0, 0.4, 9)
    found, level = flown(body, y, t), flown(scenario(coin=coin).body, y, t)
    g = np.array([G * np.sin(SLOPE), 0.0, -G * np.cos(SLOPE)])
    assert found[:, :3] == pytest.approx(y[:3] + np.outer(t, y[3:6]) + np.outer(t**2 / 2, g), abs=1e-14)
    assert found[:, 3:6] == pytest.approx(y[3:6] + np.outer(t, g), abs=1e-13)
    assert found[:, 6:] == pytest.approx(level[:, 6:], abs=1e-11)


@pytest.mark.parametrize("coin", [ZLOTY, IMPERFECT])
@pytest.mark.parametrize(("exponent", "spins"), [(0.0, True), (0.0, False), (1.0, True)])
def test_a_flight_in_air_is_that_of_an_independent_integration(coin, exponent, spins):
    release = {**draw_release(np.random.default_rng(8)), "position": [0.3, 0.1, 2.0]}
    if not spins:
        release["angular_velocity"] = [20.0, -8.0, 0.0]
    air = {**HEAVY_AIR, "exponent": exponent}
    case = scenario(coin=coin, air=air, floor=FLOOR, release=release)
    body, y, duration = case.body, state_at_release(case.release), 0.02 if exponent else 0.2

    def rate(_, state):
        changed, level = np.empty(13), np.empty(13)
        derivative(body, state, changed)
        derivative(body._replace(downhill=0.0), state, level)
        assert changed - level == pytest.approx([0, 0, 0, G * np.sin(SLOPE), *[0] * 9], abs=1e-11)
        return changed

    expected = solve_ivp(rate, (0.0, duration), y, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
    assert flown(body, y, [duration])[0] == pytest.approx(expected, abs=1e-9)
