"""Sustained contact on a slope: where a wheel slips, a coin that lies slides, and one upright tips."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Event, Mode, flow, margin_event, project
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rest import rolls_upright
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles
from tests.helpers.contacts import held, set_upright
from tests.helpers.draws import THIN, ZLOTY, scenario

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
NICKEL = {"mass": 5e-3, "radius": 10.6e-3, "thickness": 1.95e-3}
HOOP = {**THIN, "inertia": np.diag([0.5, 0.5, 1.0]) * M * R * R}
FLAT = (0.0, 0.0, R / 10, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def on_slope(slope, coin=THIN):
    return scenario(coin=coin, floor={"contact": "smooth", "slope": slope}).body


@pytest.mark.parametrize(("coin", "share"), [(THIN, 0.5), (HOOP, 1.0)])
def test_a_wheel_begins_to_slip_where_friction_no_longer_turns_it(coin, share):
    """It needs m g sin(a) J_ζ/(J_ζ + m r²) of friction: a disc slips where tan(a) > 3 μ, a hoop 2 μ."""
    mu = 0.1
    for factor, event in ((0.999, Event.SLIP_STOPS), (1.001, Event.SLIP_STARTS)):
        body = on_slope(np.arctan(factor * mu * (1 + share) / share), coin)
        y = set_upright(coin)
        assert margin_event(held(body, FloorFriction(mu), Mode.TOUCHING, y), y) == event


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.5])
def test_a_coin_that_lies_slides_downhill_and_rests_only_where_friction_holds_it(mu):
    slope, speed = 0.3, 0.5
    body, y, dy = on_slope(slope, ZLOTY), np.array(FLAT), np.empty(13)
    contact = held(body, FloorFriction(mu), Mode.LYING, y)
    project(contact, y)
    assert (flow(contact, y, dy) <= 0) == (mu > np.tan(slope))
    y[3] = speed
    assert flow(contact, y, dy) > 0
    assert dy[3:6] == pytest.approx([G * (np.sin(slope) - mu * np.cos(slope)), 0, 0], abs=1e-14)


def test_a_thick_coin_rolls_upright_down_a_slope_across_which_it_does_not_tip():
    """Across the slope it tips where tan(a) > h/(2 r)."""
    friction, ratio = FloorFriction(0.9), NICKEL["thickness"] / (2 * NICKEL["radius"])
    for slope, heading, upright in (
        (1.1 * ratio, 0.0, True),
        (0.9 * ratio, np.pi / 2, True),
        (1.1 * ratio, np.pi / 2, False),
    ):
        body = on_slope(np.arctan(slope), NICKEL)
        # The slow slip whose friction bears the weight's part along the floor.
        y = set_upright(NICKEL, SLOW * (body.gravity * body.radius) ** 0.5 * slope / friction.sliding)
        y[6:10] = quaternion_from_angles((heading, np.pi / 2, 0.0))
        assert rolls_upright(held(body, friction, Mode.UPRIGHT, y), y) == upright
