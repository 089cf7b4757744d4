"""Incipient slip: the slip that is left of one that is slow."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.floor_force import starting_slip
from cointoss.analytic.contact.incipient_slip import margin, project
from cointoss.analytic.contact.one_rim import contact_in_flight
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import RimContact
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.kernel.vectors import scale
from tests.helpers.contacts import held, put_on_floor
from tests.helpers.draws import IMPERFECT, scenario
from tests.helpers.tuples import matrix


@pytest.mark.parametrize("angle", [0.0, 0.8, -1.2, 2.0, np.pi])
def test_slow_slip_takes_the_direction_in_which_it_grows_unless_it_is_against_it(angle):
    """It keeps its speed there, and stops elsewhere; the angle is that from the direction."""
    body, friction, speed = scenario(coin=IMPERFECT).body, FloorFriction(0.05), 1e-5
    y = np.array([0, 0, 0, 0, 0, 0, *quaternion_from_angles((0.4, 0.9, 0.3)), 4.0, -2.0, 5.0])
    put_on_floor(body, friction, Mode.STICKING, y)
    contact = held(body, friction, Mode.INCIPIENT_SLIP, y)
    A = contact_in_flight(contact, y)
    s = np.array(starting_slip(A.delassus, A.free_acceleration, friction.sliding))
    c, sine = np.cos(angle), np.sin(angle)
    y[3:5] += speed * np.array([[c, -sine], [sine, c]]) @ s
    project(contact, y)
    kept = speed * s if c > 0 else np.zeros(2)
    assert contact_in_flight(contact, y).velocity == pytest.approx([*kept, 0], abs=1e-8 * speed)


@pytest.mark.parametrize(
    ("b", "slip", "expected"),
    [
        ((5.0, 0.0, -1e-4), 0.0, 1e-4),
        ((5.0, 0.0, -1.0), 0.4 * SLOW, 0.6 * SLOW),
        ((5.0, 0.0, -1.0), 1.1 * SLOW, -0.1 * SLOW),
        ((0.3 + 2e-4, 0.0, -1.0), 0.0, 2e-4),
        ((0.3 - 2e-4, 0.0, -1.0), 0.0, -2e-4),
        ((5.0, 0.0, 1e-4), 0.0, -1e-4),
    ],
)
def test_incipient_slip_lasts_while_it_is_pressed_and_slow_and_beyond_the_cone(b, slip, expected):
    """Of a point mass on a floor of μ = 0.3: what is left, b in g and slip in √(g r), F = -m b."""
    body, axes = scenario().body, ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    unit, K = (body.gravity * body.radius) ** 0.5, matrix(scale(1 / body.mass, axis) for axis in axes)
    A = RimContact(axes, (0.0, 0.0, -0.01), axes, K, scale(body.gravity, b), (0.0, slip * unit, 0.0))
    assert margin(body, A, 0.3) == pytest.approx(expected, rel=1e-9)
