"""A threshold of restitution: touches up to that speed of approach are plastic, and no others change."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.resets import restitution_at
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.models.reading import load
from tests.helpers.draws import ZLOTY, scenario


def test_a_touch_is_plastic_at_the_threshold_and_elastic_above_it():
    threshold, at_rest = 0.3, scenario(coin=ZLOTY)
    case = at_rest.replace("floor.restitution", 0.8, "floor.restitution_threshold", threshold)
    for speed, chi in ((0.0, 0.0), (threshold, 0.0), (np.nextafter(threshold, 1), 0.8)):
        y = np.array([0, 0, ZLOTY["thickness"] / 2, 0, 0, -speed, 1, 0, 0, 0, 0, 0, 0.0])
        assert restitution_at(case.body, case.rules, y) == chi
        assert restitution_at(at_rest.body, at_rest.rules, y) == at_rest.floor.restitution


@pytest.mark.parametrize(("name", "stays"), [("fig24a", False), ("zloty", True)])
def test_a_toss_is_the_same_up_to_its_first_touch_below_the_threshold(name, stays):
    """That touch is a plastic impact, or starts a sustained contact where plastic impacts would chatter."""
    case = load(name)
    free = analytic.toss(case)
    speeds = -free.impacts.contact_velocity_before[:, 2]
    threshold = float(np.sort(speeds)[len(speeds) // 10])
    first = int(np.argmax(speeds <= threshold))
    at = free.impacts.time[first]
    cut = analytic.toss(case.replace("floor.restitution_threshold", threshold))
    assert first > 0
    assert np.array_equal(cut.impacts.time[:first], free.impacts.time[:first])
    assert np.array_equal(cut.impacts.impulse[:first], free.impacts.impulse[:first])
    assert (at in cut.contacts[:, 0]) == stays
    assert (cut.impacts.time[first] == at) != stays
    if not stays:
        assert cut.impacts.contact_velocity_after[first, 2] == pytest.approx(0, abs=1e-12)
    least = analytic.toss(case.replace("floor.restitution_threshold", float(speeds.min()) / 2))
    assert np.array_equal(least.impacts.impulse, free.impacts.impulse)


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
