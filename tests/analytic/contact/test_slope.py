"""Sustained contact on a slope: closed forms of rolling, slip and sliding, and rest."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Event, Mode, flow, margin_event, project
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rest import rests, rolls_upright
from cointoss.analytic.contact.rim_contact import rim_contact
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles
from tests.helpers.contacts import SMOOTH, follow_for, held, put_on_floor, set_upright
from tests.helpers.draws import THIN, ZLOTY, scenario

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
NICKEL = {"mass": 5e-3, "radius": 10.6e-3, "thickness": 1.95e-3}
HOOP = {**THIN, "inertia": np.diag([0.5, 0.5, 1.0]) * M * R * R}
INERTIA = np.diag([8e-8, 8e-8, 1.6e-7])
FLAT = (0.0, 0.0, R / 10, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def on_slope(slope, coin=THIN):
    return scenario(coin=coin, floor={"contact": "smooth", "slope": slope}).body


def rolling(coin, speed):
    """Return the state of a coin that rolls without slip along x."""
    return set_upright(coin, speed, (0.0, 0.0, -speed / coin["radius"]))


@pytest.mark.parametrize(("coin", "share"), [(THIN, 0.5), (HOOP, 1.0)])
@pytest.mark.parametrize(("slope", "delta"), [(0.3, 0.0), (0.3, 1e-3), (0.0, 1e-3)])
def test_a_disc_and_a_hoop_roll_downhill_as_the_closed_form_says(coin, share, slope, delta):
    """(J_ζ + m r²) dω_ζ/dt = m r g sin(a) - δ m g cos(a)."""
    speed = 0.2
    body = on_slope(slope, coin)
    gained = G * (np.sin(slope) - delta / R * np.cos(slope)) / (1 + share)
    y = rolling(coin, speed)
    states, times = follow_for(body, FloorFriction(50.0, delta), Mode.STICKING, y, 0.3)
    assert states[:, 3] == pytest.approx(speed + gained * times, rel=1e-9)
    assert states[-1, 0] == pytest.approx(speed * 0.3 + gained * 0.3**2 / 2, rel=1e-9)


@pytest.mark.parametrize(("coin", "share"), [(THIN, 0.5), (HOOP, 1.0)])
def test_a_wheel_begins_to_slip_where_friction_no_longer_turns_it(coin, share):
    """It needs m g sin(a) J_ζ/(J_ζ + m r²) of friction: a disc slips where tan(a) > 3 μ, a hoop 2 μ."""
    mu = 0.1
    for factor, event in ((0.999, Event.SLIP_STOPS), (1.001, Event.SLIP_STARTS)):
        body = on_slope(np.arctan(factor * mu * (1 + share) / share), coin)
        y = set_upright(coin)
        assert margin_event(held(body, FloorFriction(mu), Mode.TOUCHING, y), y) == event


def test_a_disc_that_slips_downhill_is_slowed_by_friction_alone():
    """m dv/dt = m g (sin(a) - μ cos(a)), and J_ζ dω/dt = μ m g cos(a) r."""
    slope, mu = 0.6, 0.1
    body = on_slope(slope)
    states, times = follow_for(body, FloorFriction(mu), Mode.SLIDING, set_upright(THIN, 0.1), 0.2)
    assert states[:, 3] == pytest.approx(0.1 + G * (np.sin(slope) - mu * np.cos(slope)) * times, rel=1e-9)
    turned = mu * G * np.cos(slope) * R * M / body.inertia[2][2]
    assert abs(states[-1, 12]) == pytest.approx(turned * times[-1], rel=1e-9)


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


@pytest.mark.parametrize("coin", [NICKEL, {**NICKEL, "thickness": 0.0}])
def test_resistance_holds_a_nickel_on_its_edge_up_to_the_slope_of_its_size(coin):
    """tan(a) <= δ/r, here of 0.54 degrees; and where friction holds it too."""
    friction = FloorFriction(0.3, NICKEL["radius"] * np.tan(np.radians(0.54)))
    for degrees, mu, holds in ((0.5, 0.3, True), (0.53, 0.3, True), (0.55, 0.3, False), (0.5, 0.008, False)):
        body, y = on_slope(np.radians(degrees), coin), set_upright(coin)
        mode = Mode.UPRIGHT if coin is NICKEL else Mode.STICKING
        assert rests(held(body, friction._replace(sliding=mu), mode, y), y) == holds, degrees


def test_resistance_holds_a_coin_on_a_line_by_where_its_weight_meets_the_floor():
    """Its mass centre is uphill of the line by the slope: it is held, and one downhill is not."""
    slope, friction = 0.1, FloorFriction(0.9, 1e-4)
    for side, holds in ((1.0, True), (-1.0, False)):
        off = R * np.tan(slope)
        coin = {**ZLOTY, "center_of_mass": [-side * off, 0.0, 0.0], "inertia": INERTIA}
        body, y = on_slope(slope, coin), set_upright(ZLOTY)
        contact = held(body, friction, Mode.UPRIGHT, y)
        assert rim_contact(body, y, -1.0).arm[0] == pytest.approx(side * off)
        assert rests(contact, y) == holds


def test_a_coin_on_a_point_may_pivot_until_its_weight_tips_it():
    """Uphill by the slope its mass centre is above the point, and would fall from there."""
    slope, friction = 0.1, FloorFriction(0.9, 1.5e-3)
    for lean, holds in ((0.0, True), (-slope, False), (slope, False)):
        y = set_upright(THIN)
        y[6:10] = quaternion_from_angles((np.pi / 2, np.pi / 2 + lean, 0.0))
        y[2] = R * np.cos(lean)
        assert rests(held(on_slope(slope), friction, Mode.STICKING, y), y) == holds


def test_a_thick_coin_rolls_upright_down_a_slope_across_which_it_does_not_tip():
    """Across the slope it tips where tan(a) > h/(2 r)."""
    friction, ratio = FloorFriction(0.9), NICKEL["thickness"] / (2 * NICKEL["radius"])
    for slope, across, upright in (
        (1.1 * ratio, False, True),
        (0.9 * ratio, True, True),
        (1.1 * ratio, True, False),
    ):
        body = on_slope(np.arctan(slope), NICKEL)
        # The slow slip whose friction bears the weight's part along the floor.
        y = set_upright(NICKEL, SLOW * (body.gravity * body.radius) ** 0.5 * slope / friction.sliding)
        if across:
            y[6:10] = quaternion_from_angles((np.pi / 2, np.pi / 2, 0.0))
        assert rolls_upright(held(body, friction, Mode.UPRIGHT, y), y) == upright


def test_a_smooth_slope_changes_nothing_but_the_motion_along_it():
    body, y = on_slope(0.5, ZLOTY), set_upright(ZLOTY, 0.3, (0.0, 0.0, 5.0))
    y[6:10] = quaternion_from_angles((0.3, 0.8, 0.0))
    put_on_floor(body, SMOOTH, Mode.SLIDING, y)
    sloping, normal = np.empty(13), np.empty(13)
    flow(held(body, SMOOTH, Mode.SLIDING, y), y, sloping)
    flow(held(body._replace(downhill=0.0), SMOOTH, Mode.SLIDING, y), y, normal)
    assert sloping - normal == pytest.approx([0, 0, 0, body.downhill, *[0] * 9], abs=1e-12)
