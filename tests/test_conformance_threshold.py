"""A threshold of restitution, on both engines: touches up to that speed are plastic, and no others change."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation
from cointoss.models.certificate import law_residuals
from cointoss.models.reading import load
from cointoss.models.records import ApproximationWarning, Ending, Outcome
from tests.helpers.draws import AIR, ZLOTY, draw_coin, draw_release, scenario

pytestmark = [
    pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning"),
    pytest.mark.usefixtures("without_horizon"),
]

G = 9.81
BY = {
    "analytic": (analytic, analytic.FINE, 1e-9),
    **{
        f"mujoco, {contact}, {name}": (coin_mj, replace(settings, contact=contact), near)
        for contact in Realisation
        for name, settings, near in (("fine", coin_mj.FINE, 2e-4), ("many", coin_mj.MANY, 3e-3))
    },
}
"""Engines with their settings, and how near a rebound is to its part of a touch's speed."""
ALL = pytest.mark.parametrize("by", BY.values(), ids=BY)
MUJOCO = pytest.mark.parametrize("contact", list(Realisation))


def speeds_of(impacts):
    """Return the speeds of approach and of rebound, (n,) each [m/s]."""
    return -impacts.contact_velocity_before[:, 2], impacts.contact_velocity_after[:, 2]


@ALL
@pytest.mark.parametrize("chi", [0.8, 0.9])
def test_a_coin_that_falls_flat_stops_after_the_bounces_of_the_closed_form(by, chi):
    """It comes down at v₀ χⁿ: touch number ln(v₀/v)/ln(1/χ), rounded up, is the first plastic one."""
    package, settings, near = by
    threshold, height = 1.0, 1.0
    case = scenario(
        floor={"contact": "smooth", "restitution": chi, "restitution_threshold": threshold},
        release={"position": [0, 0, height + ZLOTY["thickness"] / 2]},
    )
    v_0 = (2 * G * height) ** 0.5
    expected = v_0 * chi ** np.arange(1 + np.ceil(np.log(v_0 / threshold) / np.log(1 / chi)))
    tossed = package.toss(case, settings=settings)
    speeds, after = speeds_of(tossed.impacts)
    # Rounding; in MuJoCo each bounce adds its rebound's error, and four contacts leave 1e-4 of the speed.
    mujoco = (25 * near, 2 * near, 2.5 * near)
    of_path, of_rebound, at_rest = (1e-12, 1e-14, 1e-15) if package is analytic else mujoco
    assert speeds == pytest.approx(expected, rel=of_path)
    assert after[:-1] == pytest.approx(chi * speeds[:-1], rel=of_rebound)
    assert after[-1] == pytest.approx(0, abs=at_rest)
    assert (tossed.outcome, tossed.ending) == (Outcome.HEADS, Ending.SETTLED)
    assert tossed.end_time == pytest.approx((v_0 + 2 * expected[1:].sum()) / G, rel=of_path)


@ALL
def test_each_impact_of_a_toss_rebounds_as_its_speed_says(by):
    package, settings, near = by
    case = load("fig24a")
    free = package.toss(case, settings=settings).impacts
    threshold = float(np.median(speeds_of(free)[0]))
    case = case.replace("floor.restitution_threshold", threshold)
    impacts = package.toss(case, settings=settings).impacts
    speeds, after = speeds_of(impacts)
    slow = speeds <= threshold
    assert 0 < slow.sum() < len(slow)
    assert np.abs(after[slow] / speeds[slow]).max() < near
    assert np.abs(after[~slow] / speeds[~slow] - case.floor.restitution).max() < near
    assert law_residuals(case.body, case.rules, impacts).max() < near


@ALL
def test_the_threshold_itself_is_plastic_and_touches_above_it_keep_their_bits(by):
    package, settings, near = by
    case = load("fig24a")
    free = package.toss(case, settings=settings).impacts
    speeds, rebounds = speeds_of(free)
    which = int(np.argmin(speeds[:3]))
    slowest, short = float(speeds[which]), case.replace("ending.max_impacts", 3)
    below, at = (
        package.toss(short.replace("floor.restitution_threshold", size), settings=settings).impacts
        for size in (np.nextafter(slowest, 0), slowest)
    )
    assert np.array_equal(below.impulse, free.impulse[:3])
    assert np.array_equal(at.impulse[:which], free.impulse[:which])
    assert speeds_of(at)[1][which] == pytest.approx(0, abs=near * slowest)
    assert rebounds[which] > 0.5 * slowest


def draw_slowing(rng, law):
    """Draw a toss whose first impact is above the threshold and whose second is below, and its impacts."""
    while True:
        floor = {"contact": law, "friction": 0.3, "restitution": 0.5}
        parts = {"coin": draw_coin(rng), "air": AIR, "release": draw_release(rng)}
        case = scenario(**parts, floor=floor, ending={"max_impacts": 2})
        speeds, _ = speeds_of(analytic.toss(case).impacts)
        # A slower touch is near a graze, whose time and place are uncertain.
        if len(speeds) == 2 and 0.3 < speeds[1] < 0.9 * speeds[0]:
            case = case.replace("floor.restitution_threshold", (speeds[0] + speeds[1]) / 2)
            return case, analytic.toss(case).impacts


@MUJOCO
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
