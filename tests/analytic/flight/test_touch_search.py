"""What the search for a touch says of the gap and of the impacts to come, against flights and impacts."""

import numpy as np
import pytest

from cointoss.analytic.contact.resets import hit, rebound_at, restitution_at
from cointoss.analytic.flight.equations_of_motion import flight_of
from cointoss.analytic.flight.flying import fly, sample
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.touch_search import gap_acceleration, is_chattering
from cointoss.analytic.numerics.tolerances import CHATTERING
from cointoss.analytic.toss import state_at_release
from cointoss.models.geometry import evaluate_gap
from cointoss.models.records import IMPACT_ROW
from tests.helpers.contacts import touching
from tests.helpers.draws import AIR, THIN, draw_coin, draw_release, scenario

POWER = {"restitution": 0.5, "restitution_exponent": 0.25}
FLOORS = [
    {"restitution": 0.5},
    {"restitution": 0.9},
    {"restitution": 1.0, "restitution_viscous": 0.3},
    {**POWER, "restitution_viscous": 0.1},
    {**POWER, "restitution_threshold": 0.07},
]


@pytest.mark.parametrize("floor", FLOORS)
def test_impacts_chatter_that_all_come_while_the_coin_hardly_turns(floor):
    """Those after the fastest touch that chatters are made one by one.

    At the speed v the touch would be followed for 2 v/((1 - χ) A), of which its impacts take the part χ where
    that is constant, and all of them no more than is allowed.
    """
    case = scenario(coin=THIN, floor=floor)
    body, rules, rows = case.body, case.rules, np.zeros(1, IMPACT_ROW)
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = (low + high) / 2
        y = touching(body, middle)
        chatters = is_chattering(body, rebound_at(body, rules, y), state_of(y))
        low, high = (middle, high) if chatters else (low, middle)
    y, elapsed, impacts = touching(body, low), 0.0, 0
    turning = np.linalg.norm(y[10:13]) + (body.gravity / body.radius) ** 0.5
    least = low * (1e-2 if len(floor) == 1 else 0.1)
    while -evaluate_gap(body, state_of(y)).speed > least and restitution_at(body, rules, y) > 0:
        hit(body, rules, restitution_at(body, rules, y), y, rows[0])
        elapsed += fly(body, y, 1.0, False).time
        impacts += 1
    assert low > 0
    assert "restitution_threshold" in floor or impacts > 5
    # The gap's acceleration changes by less than that while the coin turns by CHATTERING.
    taken, chi = elapsed * turning / (CHATTERING * np.sin(0.6)), floor["restitution"]
    assert taken < 1.02
    assert len(floor) > 1 or taken == pytest.approx(chi * (1 - chi**impacts), rel=2e-2)


@pytest.mark.parametrize("seed", range(8))
def test_the_acceleration_of_the_gap_is_that_of_its_samples(seed):
    rng = np.random.default_rng(seed)
    release = {**draw_release(rng, 60.0), "position": [0.1, -0.2, 5.0]}
    case = scenario(coin=draw_coin(rng), air=AIR, release=release)
    body, dt, states = case.body, 1e-4, np.empty((3, 13))
    sample(body, state_at_release(case.release), 0.0, np.array([0.2 - dt, 0.2, 0.2 + dt]), states)
    gaps = [evaluate_gap(body, state_of(y)).gap for y in states]
    # Second differences err by the gap's fourth derivative, ~ r w^4 dt^2/12, and by rounding, 1e-15/dt^2.
    due = np.diff(gaps, 2)[0] / dt**2
    assert gap_acceleration(body, flight_of(body, states[1])) == pytest.approx(due, rel=1e-3, abs=1e-3)
