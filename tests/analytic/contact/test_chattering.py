"""Contact takes the place of the impacts that chatter: how far its motion is from theirs."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.resets import hit
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.sampling import sample_contact
from cointoss.analytic.flight.equations_of_motion import flight_of
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.touch_search import gap_acceleration
from cointoss.analytic.numerics.tolerances import CHATTERING, CONTACT_STEP_ERROR
from cointoss.models.geometry import evaluate_gap
from cointoss.models.records import IMPACT_ROW
from tests.helpers.contacts import end_mode, held, touching
from tests.helpers.draws import IMPERFECT, THIN, scenario


def at_the_end(case, speed, duration, *, bouncing):
    """Give the state at `duration` after a touch at `speed`: bounced into contact, or put there at once."""
    body, rules, rows, elapsed = case.body, case.rules, np.zeros(1, IMPACT_ROW), 0.0
    y = touching(body, speed)
    while bouncing and -evaluate_gap(body, state_of(y)).speed > 1e-3 * speed:
        hit(body, rules, rules.restitution, y, rows[0])
        elapsed += fly(body, y, 1.0, False).time
    hit(body, rules, 0.0, y, rows[0])
    friction, state = FloorFriction(rules.friction), np.empty((1, 13))
    end_mode(body, friction, Mode.TOUCHING, y)
    contact = held(body, friction, Mode.SLIDING, y)
    sample_contact(contact, y, elapsed, np.array([duration]), 1e-12, state)
    return state[0]


@pytest.mark.parametrize("friction", [0.0, 0.2])
@pytest.mark.parametrize(
    "coin",
    [THIN, IMPERFECT],
    ids=["thin", "unbalanced"],
)
def test_contact_takes_the_place_of_chattering_to_the_third_power_of_the_angle(coin, friction):
    law = "coulomb" if friction else "smooth"
    case = scenario(coin=coin, floor={"restitution": 0.6, "contact": law, "friction": friction})
    body = case.body
    rate = (body.gravity / body.radius) ** 0.5

    def error(angle):
        y = touching(body, 0.0)
        still_to_come = angle * np.sin(0.6) / (rate + np.linalg.norm(y[10:]))
        speed = -gap_acceleration(body, flight_of(body, y)) * (1 - 0.6) * still_to_come / 2
        bounced, held = (
            at_the_end(case, speed, 3 * still_to_come, bouncing=bouncing) for bouncing in (True, False)
        )
        return np.abs(bounced - held)[10:].max() / rate

    assert error(CHATTERING) < CONTACT_STEP_ERROR
    assert 7 < error(4 * CHATTERING) / error(2 * CHATTERING) < 9
