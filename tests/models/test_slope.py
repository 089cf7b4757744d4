"""What is proved of a coin on a slope: what on a smooth one in vacuum, and a coin that lies, on others."""

import numpy as np
import pytest

from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import friction_can_hold, slope_feeds
from cointoss.models.ending import cannot_be_caught, final_face, moments_may_grow
from cointoss.models.geometry import gap
from cointoss.models.records import Ending, Outcome
from cointoss.models.rest import is_held, lever_of
from cointoss.models.state import state
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario

NONE = (Outcome.UNDECIDED, Ending.NONE)
SETTLED, LYING = (Outcome.HEADS, Ending.SETTLED), (Outcome.HEADS, Ending.LYING)
ROUGH = {"contact": "coulomb", "friction": 0.3, "restitution_kind": "energetic"}


def touching(body, tilt, v=(0.0, 0.0, 0.0), w=(0.0, 0.0, 0.0)):
    e = quaternion_from_angles((0.0, tilt, 0.0))
    return state((0.0, 0.0, -gap(body, 0.0, rotation_matrix(e)[2])), v, e, w)


@pytest.mark.parametrize(
    ("floor", "air", "level", "slope"),
    [
        ({"contact": "smooth"}, {}, SETTLED, SETTLED),
        ({"contact": "smooth", "contour_friction": 1e-4}, {}, SETTLED, SETTLED),
        ({"contact": "smooth", "rolling_friction": 1e-4}, {}, SETTLED, SETTLED),
        ({"contact": "smooth"}, AIR, SETTLED, NONE),
        (ROUGH, {}, SETTLED, NONE),
        ({"contact": "knurled"}, {}, (Outcome.HEADS, Ending.PAPER), NONE),
    ],
)
def test_energy_settles_a_face_where_a_slope_cannot_feed_what_turns_the_coin(floor, air, level, slope):
    for angle, expected in ((0.0, level), (0.2, slope)):
        case = scenario(floor={**floor, "slope": angle}, air=air)
        assert final_face(case.body, case.rules, touching(case.body, 0.3), 0.0) == expected


def test_the_barrier_on_a_smooth_slope_is_that_of_the_part_of_gravity_along_the_normal():
    """A speed upwards between both barriers: it settles a level floor's coin alone."""
    r, level, slope = ZLOTY["radius"], scenario(), scenario(floor={"contact": "smooth", "slope": 1.0})
    reach = np.hypot(r, 1e-3) - (r * np.sin(0.3) + 1e-3 * np.cos(0.3))
    for factor, expected in ((0.95 * np.cos(1.0), SETTLED), (0.9, NONE)):
        moving = touching(slope.body, 0.3, v=(3.0, 0.0, np.sqrt(2 * 9.81 * reach * factor)))
        assert final_face(slope.body, slope.rules, moving, 0.0) == expected
        assert final_face(level.body, level.rules, moving, 0.0) == SETTLED


@pytest.mark.parametrize(
    ("coin", "slope", "lies"),
    [(ZLOTY, 0.2, True), (ZLOTY, 0.4, True), (IMPERFECT, 0.2, True), (IMPERFECT, 0.4, False)],
)
def test_a_flat_coin_lies_for_good_if_friction_or_balance_bounds_its_moments(coin, slope, lies):
    """tan(0.4) is above μ = 0.3: a balanced coin slides away flat, of another nothing is said."""
    case = scenario(coin=coin, floor={**ROUGH, "slope": slope}, ending={"test": "lying"})
    sliding = touching(case.body, 0.0, v=(0.3, 0.0, 0.0), w=(0.0, 0.0, 2.0))
    assert final_face(case.body, case.rules, sliding, 0.0) == (LYING if lies else NONE)


def test_a_thick_coin_that_a_rough_slope_topples_does_not_lie():
    """It topples over its rim from tan(slope) = r/(h/2), here 0.5, on."""
    thick = {"mass": 5e-3, "radius": 5e-3, "thickness": 0.02}
    for slope, outcome in ((np.arctan(0.49), LYING), (np.arctan(0.51), NONE)):
        case = scenario(coin=thick, floor={"contact": "perfectly_rough", "slope": slope})
        assert final_face(case.body, case.rules, touching(case.body, 0.0), 0.0) == outcome


def test_an_unbalanced_coin_that_spins_on_a_smooth_slope_in_vacuum_lies():
    """Nothing but gravity acts along such a floor, which turns no coin."""
    for air, outcome in (({}, LYING), (AIR, NONE)):
        floor = {"contact": "smooth", "slope": 0.3, "pivoting_friction": 1e-5}
        case = scenario(coin=IMPERFECT, floor=floor, air=air, ending={"test": "lying"})
        sliding = touching(case.body, 0.0, v=(0.3, 0.0, 0.0), w=(0.0, 0.0, 2.0))
        assert final_face(case.body, case.rules, sliding, 0.0) == outcome


def test_conserved_speed_is_left_out_where_a_smooth_floor_resists_in_vacuum():
    for slope in (0.0, 0.3):
        case = scenario(floor={"contact": "smooth", "contour_friction": 1e-4, "slope": slope})
        fast = touching(case.body, 0.1, v=(30.0, 0.0, 0.0))
        assert final_face(case.body, case.rules, fast, 0.0) == SETTLED


def test_a_coin_on_a_line_is_held_only_where_its_weight_meets_the_floor_between_the_rims():
    """Its normal points downhill: it topples from tan(slope) = (h/2)/r on, whatever resists rolling."""
    e = quaternion_from_angles((np.pi / 2, np.pi / 2, 0.0))
    for part, holds in ((0.99, True), (1.01, False)):
        slope = np.arctan(part * ZLOTY["thickness"] / 2 / ZLOTY["radius"])
        body = scenario(floor={**ROUGH, "slope": slope}).body
        upright = state((0.0, 0.0, body.radius), (0.0, 0.0, 0.0), e, (0.0, 0.0, 0.0))
        arm = (upright.R[0][2] * body.thickness / 2, 0.0, -body.radius)
        assert is_held(body, 1e-3, 0.9, upright, arm, True) == holds


def test_an_unbalanced_coin_lies_where_friction_outweighs_the_slope_and_its_arm():
    body = scenario(coin=IMPERFECT, floor={"contact": "smooth", "slope": 0.3}).body
    least = np.tan(0.3) * (1 + 1.5 * np.linalg.norm(body.center) / body.radius)
    assert moments_may_grow(body, 0.99 * least)
    assert not moments_may_grow(body, 1.01 * least)
    assert not moments_may_grow(scenario(coin=IMPERFECT).body, 0.0)


def test_a_slope_feeds_all_but_a_coin_on_a_smooth_floor_in_vacuum():
    floor = {"contact": "smooth", "slope": 0.1}
    vacuum, air, level = (
        scenario(floor=floor).body,
        scenario(floor=floor, air=AIR).body,
        scenario(air=AIR).body,
    )
    assert [slope_feeds(vacuum, True), slope_feeds(vacuum, False), slope_feeds(air, True)] == [
        False,
        True,
        True,
    ]
    assert not slope_feeds(level, False)
    assert [friction_can_hold(vacuum, mu * np.tan(0.1)) for mu in (0.999, 1.001)] == [False, True]
    assert friction_can_hold(level, 0.0)


def test_no_height_is_out_of_reach_of_a_coin_that_a_slope_feeds():
    for floor, cannot in (({"contact": "smooth"}, True), (ROUGH, True), ({**ROUGH, "slope": 0.1}, False)):
        case = scenario(floor=floor, ending={"caught": 0.5})
        assert cannot_be_caught(case.body, case.rules, touching(case.body, 0.3)) == cannot


def test_the_lever_of_a_coin_that_stands_on_a_line_is_its_distance_from_it():
    R = rotation_matrix(quaternion_from_angles((0.0, np.pi / 2, 0.0)))
    assert lever_of(R, (3e-3, 4e-3, -1e-2), True) == pytest.approx(3e-3)
    assert lever_of(R, (3e-3, 4e-3, -1e-2), False) == pytest.approx(5e-3)
