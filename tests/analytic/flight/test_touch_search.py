"""What the search for a touch says of the impacts to come, against the impacts themselves."""

import numpy as np
import pytest

from cointoss.analytic.contact.resets import hit
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.touch_search import is_chattering
from cointoss.analytic.numerics.tolerances import CHATTERING
from cointoss.models.geometry import evaluate_gap
from cointoss.models.records import IMPACT_ROW
from tests.helpers.contacts import touching
from tests.helpers.draws import THIN, scenario


@pytest.mark.parametrize("chi", [0.5, 0.9])
def test_impacts_chatter_that_all_come_while_the_coin_hardly_turns(chi):
    """Those after the fastest touch that chatters are made one by one.

    At the speed v the touch would be followed for 2 v/((1 - χ) A), of which its impacts take the part χ.
    """
    case = scenario(coin=THIN, floor={"restitution": chi})
    body, rows = case.body, np.zeros(1, IMPACT_ROW)
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = (low + high) / 2
        chatters = is_chattering(body, chi, state_of(touching(body, middle)))
        low, high = (middle, high) if chatters else (low, middle)
    y, elapsed, impacts = touching(body, low), 0.0, 0
    turning = np.linalg.norm(y[10:13]) + (body.gravity / body.radius) ** 0.5
    while -evaluate_gap(body, state_of(y)).speed > 1e-2 * low:
        hit(body, case.rules, chi, y, rows[0])
        elapsed += fly(body, y, 1.0, False).time
        impacts += 1
    assert impacts > 5
    part = chi * (1 - chi**impacts)
    # The gap's acceleration changes by less than that while the coin turns by CHATTERING.
    assert elapsed * turning == pytest.approx(part * CHATTERING * np.sin(0.6), rel=2e-2)
