"""Plastic touches in MuJoCo, of springs and of one step: against closed forms and the analytic engine."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation
from cointoss.models.certificate import law_residuals
from cointoss.models.reading import load
from cointoss.models.records import ApproximationWarning, Ending, Outcome
from tests.helpers.draws import AIR, draw_coin, draw_release, scenario
from tests.helpers.flat_fall import flat_fall

pytestmark = [
    pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning"),
    pytest.mark.usefixtures("without_horizon"),
]

BOTH = pytest.mark.parametrize("contact", list(Realisation))


@BOTH
def test_a_coin_that_falls_flat_stops_after_the_bounces_of_the_closed_form(contact):
    fall = flat_fall(0.8, 1.0)
    tossed = coin_mj.toss(fall.scenario, settings=replace(coin_mj.FINE, contact=contact))
    speeds, after = (
        -tossed.impacts.contact_velocity_before[:, 2],
        tossed.impacts.contact_velocity_after[:, 2],
    )
    assert len(fall.speeds) == 8
    assert speeds == pytest.approx(fall.speeds, rel=5e-3)
    # Four contacts at once leave 1e-4 of the speed.
    assert after[-1] == pytest.approx(0, abs=5e-4)
    assert (tossed.outcome, tossed.ending) == (Outcome.HEADS, Ending.SETTLED)


def draw_slowing(rng, law):
    """Draw a toss whose first impact is above the threshold and whose second is below, and its impacts."""
    while True:
        floor = {"contact": law, "friction": 0.3, "restitution": 0.5}
        parts = {"coin": draw_coin(rng), "air": AIR, "release": draw_release(rng)}
        case = scenario(**parts, floor=floor, ending={"max_impacts": 2})
        speeds = -analytic.toss(case).impacts.contact_velocity_before[:, 2]
        # A slower touch is near a graze, whose time and place are uncertain.
        if len(speeds) == 2 and 0.3 < speeds[1] < 0.9 * speeds[0]:
            case = case.replace("floor.restitution_threshold", (speeds[0] + speeds[1]) / 2)
            return case, analytic.toss(case).impacts


@BOTH
@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
def test_an_elastic_and_a_plastic_impact_are_those_of_the_other_engine(contact, law):
    rng = np.random.default_rng([11, len(law)])
    for _ in range(4):
        case, expected = draw_slowing(rng, law)
        found = coin_mj.toss(case, settings=replace(coin_mj.FINE, contact=contact)).impacts
        size = np.linalg.norm(expected.impulse, axis=1)
        off = np.linalg.norm(found.impulse - expected.impulse, axis=1) / size
        # The second has the first's error, multiplied.
        assert off[0] < 1e-4
        assert off[1] < 1e-2
        # By its own law each errs by what MuJoCo's solimp leaves, 1e-4, and by how far the coin turns.
        assert law_residuals(case.body, case.rules, found).max() < 5e-4
        assert case.floor.restitution_threshold > 0.3


@BOTH
@pytest.mark.parametrize("settings", [coin_mj.FINE, coin_mj.MANY], ids=["fine", "many"])
def test_each_impact_of_a_toss_rebounds_as_its_speed_says(contact, settings):
    case, realised = load("fig24a"), replace(settings, contact=contact)
    free = -coin_mj.toss(case, settings=realised).impacts.contact_velocity_before[:, 2]
    threshold = float(np.median(free))
    case = case.replace("floor.restitution_threshold", threshold)
    impacts, chi = coin_mj.toss(case, settings=realised).impacts, case.floor.restitution
    speeds, after = -impacts.contact_velocity_before[:, 2], impacts.contact_velocity_after[:, 2]
    slow = speeds <= threshold
    assert 0 < slow.sum() < len(slow)
    near = {coin_mj.FINE: 2e-4, coin_mj.MANY: 3e-3}[settings]
    assert np.abs(after[slow] / speeds[slow]).max() < near
    assert np.abs(after[~slow] / speeds[~slow] - chi).max() < near
    assert law_residuals(case.body, case.rules, impacts).max() < near


@BOTH
def test_the_threshold_itself_is_plastic_and_touches_above_it_keep_their_bits(contact):
    settings = replace(coin_mj.MANY, contact=contact)
    case = load("fig24a")
    free = coin_mj.toss(case, settings=settings).impacts
    slowest = float(-free.contact_velocity_before[:3, 2].max())
    short = case.replace("ending.max_impacts", 3)
    below, at = (
        coin_mj.toss(short.replace("floor.restitution_threshold", size), settings=settings).impacts
        for size in (np.nextafter(slowest, 0), slowest)
    )
    which = int(np.argmax(free.contact_velocity_before[:3, 2]))
    assert np.array_equal(below.impulse, free.impulse[:3])
    assert np.array_equal(at.impulse[:which], free.impulse[:which])
    assert at.contact_velocity_after[which, 2] == pytest.approx(0, abs=3e-3 * slowest)
    assert free.contact_velocity_after[which, 2] > 0.5 * slowest
