"""Restitution that falls with the speed of approach, on both engines: each impact has that of its speed."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Friction, Realisation
from cointoss.models.reading import load
from cointoss.models.records import Ending
from cointoss.models.restitution import restitution_at_speed
from tests.helpers.draws import ZLOTY, draw_coin, draw_release, on_floor, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

G = 9.81
FLOORS = {
    "power": {"restitution": 0.5, "restitution_exponent": 0.25},
    "viscous": {"restitution": 1.0, "restitution_viscous": 0.3},
    "both": {"restitution": 0.6, "restitution_exponent": 0.25, "restitution_viscous": 0.2},
}
BY_SPEED = pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)
MUJOCO = {
    f"{contact}, {name}": (replace(settings, contact=contact), near)
    for contact in Realisation
    for name, settings, near in (("fine", coin_mj.FINE, 2e-4), ("many", coin_mj.MANY, 3e-3))
}
"""Settings, and how near a rebound is to its part of a touch's speed: what MuJoCo errs at constant χ, too."""
ALL = pytest.mark.parametrize("by", MUJOCO.values(), ids=MUJOCO)


def rebounds_of(impacts):
    """Return the speeds of approach [m/s] and the restitutions, (n,) each."""
    speeds = -impacts.contact_velocity_before[:, 2]
    return speeds, impacts.contact_velocity_after[:, 2] / speeds


@ALL
@BY_SPEED
def test_each_impact_of_mujoco_rebounds_by_its_speed(by, floor):
    settings, near = by
    case = on_floor(load("fig24a"), floor)
    impacts = coin_mj.toss(case.replace("ending.max_impacts", 3), settings=settings).impacts
    speeds, found = rebounds_of(impacts)
    expected = np.array([restitution_at_speed(case.rules, speed) for speed in speeds])
    assert len(found) == 3
    assert np.ptp(expected) > 0.03
    assert np.abs(found - expected).max() < near


@ALL
def test_a_coin_that_falls_flat_has_the_speeds_of_the_closed_form(by):
    """v(n) = v_e (v(0)/v_e)^((1 - p)^n)."""
    settings, near = by
    position = [0, 0, 1 + ZLOTY["thickness"] / 2]
    ending = {"test": "lying", "max_impacts": 6}
    case = scenario(coin=ZLOTY, floor=FLOORS["power"], release={"position": position}, ending=ending)
    tossed = coin_mj.toss(case, settings=settings)
    speeds, _ = rebounds_of(tossed.impacts)
    expected = 0.5**4 * ((2 * G) ** 0.5 / 0.5**4) ** (0.75 ** np.arange(6))
    # Four contacts leave 1e-4 of the speed where the floor is fine.
    assert speeds == pytest.approx(expected, rel=25 * near)
    assert tossed.ending == Ending.MAX_IMPACTS


@pytest.mark.parametrize("contact", Realisation)
@pytest.mark.parametrize("friction", Friction)
@pytest.mark.parametrize("law", ["smooth", "coulomb"])
def test_the_first_impact_is_that_of_a_floor_with_the_restitution_at_its_speed(contact, friction, law):
    rng, settings = np.random.default_rng(5), replace(coin_mj.FINE, contact=contact, friction=friction)
    for floor in FLOORS.values():
        parts = {"coin": draw_coin(rng), "release": draw_release(rng)}
        case = scenario(**parts, floor={"contact": law, "friction": 0.3, **floor}, ending={"max_impacts": 1})
        found = coin_mj.toss(case, settings=settings).impacts
        chi = restitution_at_speed(case.rules, rebounds_of(found)[0][0])
        constant = scenario(
            **parts,
            floor={"contact": law, "friction": 0.3, "restitution": chi},
            ending={"max_impacts": 1},
        )
        expected = coin_mj.toss(constant, settings=settings).impacts.impulse[0]
        off = np.linalg.norm(found.impulse[0] - expected)
        assert off < 1e-6 * np.linalg.norm(expected)
        if friction == Friction.EXPLICIT:
            of_other = analytic.toss(case).impacts.impulse[0]
            assert np.linalg.norm(found.impulse[0] - of_other) < 1e-4 * np.linalg.norm(of_other)


@pytest.mark.parametrize("settings", [coin_mj.FINE, coin_mj.MANY], ids=["fine", "many"])
def test_the_impacts_of_a_viscous_floor_end_in_contact_on_both_engines(settings):
    case = on_floor(load("fig24a"), {"restitution": 0.9, "restitution_viscous": 0.2})
    case = case.replace("ending.test", "lying", "ending.max_time", 3.0)
    found, expected = coin_mj.toss(case, settings=settings), analytic.toss(case)
    for tossed in (found, expected):
        assert tossed.ending == Ending.MAX_TIME
        assert tossed.contacts[-1, 1] == tossed.end_time == 3.0
    # The paths differ by then: in the other engine the coin loses as much in as many bounces.
    assert found.contacts[0, 0] == pytest.approx(expected.contacts[0, 0], rel=0.1)
