"""Losses as the contact point runs round the rim: what bounds them, and how a wheel stops by them."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import both_rims
from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.body import resists
from cointoss.models.contour import Contour, air_moment_per_spin, contour_per_force, longest_arm
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import THIN, ZLOTY, draw_coin, scenario

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]


def test_moments_stay_below_what_the_floor_can_answer():
    """However flat the coin, hypot(δ + arm, p) is below 2 √(J/m), and the air's moment below m g r."""
    body, contour = scenario(coin=draw_coin(np.random.default_rng(3))).body, Contour(1e-4, 1e-4, 1e-3)
    most = 2 * (body.inertia_smallest / body.mass) ** 0.5
    for rolling, pivoting in ((0.0, 0.0), (0.3 * most, 0.8 * most)):
        longest = longest_arm(body, rolling, pivoting)
        for turn in (-300.0, -1e-9, 1e-4, 1.0):
            arm = abs(turn) * contour_per_force(body, contour, longest, 1e-7, turn)
            assert np.hypot(rolling + arm, pivoting) < most
            assert abs(turn) * air_moment_per_spin(body, contour, 1e-7, turn) <= 1.0001 * M * G * R
    assert contour_per_force(body, Contour(1e-6), longest, 0.5, 20.0) == pytest.approx(1e-6 / 10, rel=1e-14)


@pytest.mark.parametrize("seed", range(4))
def test_a_flat_unbalanced_coin_is_pressed_in_one_way(seed):
    """K + q ẑᵀ is positive definite at every tilt."""
    rng = np.random.default_rng(seed)
    body, friction = scenario(coin=draw_coin(rng)).body, FloorFriction(0.0, 1e-3, 1e-3, Contour(1e-4, 1e-5))
    for tilt in 10.0 ** -np.arange(0, 7):
        attitude = quaternion_from_angles((0.3, tilt, rng.uniform(0, 6)))
        y = np.array([*[0.0] * 6, *attitude, *rng.uniform(-30, 30, 3)])
        K = np.array(both_rims(body, friction, y)[0].delassus)
        assert np.linalg.eigvalsh((K + K.T) / 2)[0] > 0


@pytest.mark.usefixtures("without_horizon")
@pytest.mark.parametrize(
    ("field", "ending"),
    [("floor.contour_friction", Ending.AT_REST), ("floor.contour_viscosity", Ending.STANDING)],
)
def test_a_thick_coin_that_rolls_upright_rests_where_contour_friction_stops_it(field, ending):
    """V/(c g/(r (1 + J_ζ/(m r²)))) after it is set down; a coin that viscosity slows stops at no time."""
    speed, c = 0.3, 1e-3
    case = scenario(
        coin={**ZLOTY, "thickness": 4e-3},
        floor={"contact": "perfectly_rough", "restitution": 0.0},
        release={
            "position": [0, 0, R],
            "velocity": [speed, 0, 0],
            "angles": [0.0, np.pi / 2, 0.0],
            "angular_velocity": [0, 0, -speed / R],
        },
        ending={"test": "lying"},
    )
    found = analytic.toss(case.replace(field, c))
    assert (found.outcome, found.ending) == (Outcome.EDGE, ending)
    if ending == Ending.AT_REST:
        assert found.end_time == pytest.approx(speed * R * 1.5 / (c * G), rel=5e-3)


@pytest.mark.usefixtures("without_horizon")
@pytest.mark.parametrize(
    ("field", "size"),
    [
        ("floor.contour_friction", 1e-12),
        ("floor.contour_viscosity", 1e-12),
        ("air.viscosity", 1e-12),
        ("floor.rolling_friction", 1e-9),
        ("floor.pivoting_friction", 1e-9),
    ],
)
def test_no_period_is_claimed_of_a_coin_that_loses_ever_so_little(field, size):
    case = scenario(
        coin=THIN,
        floor={"contact": "perfectly_rough", "restitution": 0.1},
        release={"position": [0, 0, 0.013], "angles": [0, 1.3, 0], "angular_velocity": [0, 0, 60]},
        ending={"max_time": 4.0},
    )
    slowed = case.replace(field, size)
    assert (resists(case.rules), resists(slowed.rules)) == (False, True)
    assert (analytic.toss(case).ending, analytic.toss(slowed).ending) == (Ending.PERIODIC, Ending.MAX_TIME)


def test_a_contour_friction_beyond_the_floors_answer_is_refused():
    says = r"floor\.contour_friction = 0\.0125: accepted: .*contour_friction\).*< 2 sqrt\(J/m\)"
    with pytest.raises(ValueError, match=says):
        scenario(coin=THIN, floor={"contact": "smooth", "restitution": 0.5, "contour_friction": R})
