"""Restitution that varies with the speed of approach: impacts, their derivatives, chattering, and trust."""

import numpy as np
import pytest

from cointoss import OwnLaw, analytic
from cointoss.analytic.contact.resets import rebound_at
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.touch_search import is_chattering
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.analytic.impact.own_law import rules_by
from cointoss.models.certificate import LAW
from cointoss.models.reading import load
from cointoss.models.records import UnsupportedError
from cointoss.models.restitution import elastic_speed, restitution_at_speed
from tests.helpers.contacts import touching
from tests.helpers.draws import PAPER_OFFSET, THIN, ZLOTY, on_floor, scenario
from tests.helpers.impacts import struck
from tests.helpers.own_laws import of, smooth

POWER = {"restitution": 0.5, "restitution_exponent": 0.25}
VISCOUS = {"restitution": 1.0, "restitution_viscous": 0.3}
BOTH = {**POWER, "restitution_viscous": 0.1}


def test_an_energetic_impact_gives_back_the_square_of_its_restitution_of_the_work():
    """Without slip it is Newton's, as of a coin that lands on its edge with C above the lowest point."""
    floor = {**POWER, "contact": "coulomb", "friction": 0.3, "restitution_kind": "energetic"}
    case = scenario(coin=THIN, floor=floor)
    y = np.array([0, 0, 0.01, 0, 0, -1.5, np.cos(np.pi / 4), np.sin(np.pi / 4), 0, 0, 0, 0, 0])
    impact = struck(case, y)[0]
    assert impact["contact_velocity_after"][2] == pytest.approx(1.5 * 0.5 * 1.5**-0.25, rel=1e-9)


@pytest.mark.parametrize("floor", [POWER, VISCOUS, BOTH])
@pytest.mark.parametrize("contact", ["smooth", "coulomb", "knurled"])
def test_the_derivatives_of_an_impact_are_its_differences(floor, contact):
    """By velocities, along random directions, against the impacts beside it."""
    rng = np.random.default_rng(7)
    coin = {**ZLOTY, "center_of_mass": PAPER_OFFSET}
    case = scenario(coin=coin, floor={"contact": contact, "friction": 0.3, **floor})
    y = np.array([0, 0, 0.01, 0.4, -0.3, -1.2, np.cos(0.3), np.sin(0.3), 0, 0, 3.0, -2.0, 5.0])
    touch, part = touch_derivatives(case.body, case.rules, y), 1e-4
    for _ in range(5):
        change = np.zeros(13)
        change[3:6], change[10:13] = rng.uniform(-1, 1, 3), rng.uniform(-50, 50, 3)
        ahead, back = (struck(case, y + sign * part * change)[0]["impulse"] for sign in (1, -1))
        expected = (ahead - back) / (2 * part)
        assert touch.impulse @ change == pytest.approx(expected, abs=1e-6 * float(np.linalg.norm(expected)))


def test_a_touch_at_the_elastic_speed_has_the_derivatives_of_its_own_side():
    case = scenario(coin=ZLOTY, floor=POWER)
    slowest, mass = elastic_speed(case.rules), ZLOTY["mass"]
    for part, slope in ((1 + 1e-4, -1.75 * mass), (1 - 1e-4, -2 * mass)):
        y = np.array([0, 0, 1e-3, 0, 0, -part * slowest, 1, 0, 0, 0, 0, 0, 0])
        found = touch_derivatives(case.body, case.rules, y).impulse[2, 5]
        assert found == pytest.approx(slope, rel=1e-3)


def test_by_the_power_law_no_impacts_chatter():
    case = scenario(coin=THIN, floor=POWER)
    for speed in np.geomspace(1e-4, 1.0, 30):
        y = touching(case.body, speed)
        with np.errstate(divide="ignore"):
            assert not is_chattering(case.body, rebound_at(case.body, case.rules, y), state_of(y))
    assert rebound_at(case.body, case.rules, touching(case.body, 2.0)) == 1.0


def test_no_impact_is_trusted_whose_speed_may_be_on_either_side_of_the_elastic_one():
    """Where v_e is the speed of an impact at which χ is 1, the others change by their own speed alone."""
    case = load("fig24a").replace("floor.restitution", 1.0, "ending.max_impacts", 3)
    speed = float(-analytic.toss(case).impacts.contact_velocity_before[0, 2])
    for part, trusted in ((1 + 1e-15, 0), (1.01, 3)):
        changed = case.replace("floor.restitution_speed", part * speed, "floor.restitution_exponent", 0.25)
        assert analytic.toss(changed).trusted_impacts == trusted


@pytest.mark.parametrize(("speed", "chi"), [(0.0, 0.0), (0.3, 0.0), (np.nextafter(0.3, 1), 0.8)])
def test_a_touch_is_plastic_at_the_threshold_and_elastic_above_it(speed, chi):
    rules = scenario(floor={"restitution": 0.8, "restitution_threshold": 0.3}).rules
    assert restitution_at_speed(rules, speed) == chi


def test_the_derivatives_of_a_plastic_touch_are_those_without_restitution():
    case = load("fig24a")
    found = analytic.toss(case).impacts
    parts = (found.position, found.velocity_before, found.quaternion, found.angular_velocity_before)
    y = np.concatenate([part[0] for part in parts])
    plastic, without, free = (
        touch_derivatives(case.body, changed.rules, y)
        for changed in (
            case.replace("floor.restitution_threshold", 10.0),
            case.replace("floor.restitution", 0.0),
            case,
        )
    )
    assert np.array_equal(plastic.after, without.after)
    assert np.array_equal(plastic.impulse, without.impulse)
    assert not np.allclose(plastic.after, free.after)


def test_no_impact_is_trusted_whose_speed_may_be_on_either_side_of_the_threshold():
    case = load("fig24a")
    free = analytic.toss(case)
    speeds = -free.impacts.contact_velocity_before[: free.trusted_impacts, 2]
    slowest = int(np.argmin(speeds))
    barely, clearly = (
        analytic.toss(case.replace("floor.restitution_threshold", float(part * speeds[slowest])))
        for part in (1 - 1e-15, 0.999)
    )
    assert slowest > 0
    assert np.array_equal(barely.impacts.impulse[: slowest + 1], free.impacts.impulse[: slowest + 1])
    assert barely.trusted_impacts == slowest < clearly.trusted_impacts


def test_a_law_of_ones_own_is_asked_with_the_restitution_at_the_speed():
    law = OwnLaw(smooth, max_restitution=0.8)
    case = on_floor(load("fig24a"), {**POWER, "restitution_threshold": 0.5})
    own, named = analytic.toss(case, law=law), analytic.toss(case)
    assert own.impacts.impulse[:4] == pytest.approx(named.impacts.impulse[:4], rel=1e-9)
    assert of(own, LAW) < 1e-12
    with pytest.raises(UnsupportedError, match=r"restitution = 0\.5 \(restitution 1 at a low speed\)"):
        rules_by(law, case.replace("floor.restitution_threshold", 0.0))
