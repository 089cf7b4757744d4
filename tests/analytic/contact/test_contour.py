"""Losses as the contact point runs round the rim: closed forms of Euler's disk and of a wheel, and rest."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.contact.rim_contact import both_rims
from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import resists
from cointoss.models.contour import Contour, air_moment_per_spin, contour_per_force, leaning, longest_arm
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import eulers_disk, follow_for, held, put_on_floor, set_upright, tilts_of
from tests.helpers.draws import THIN, ZLOTY, draw_coin, scenario

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
UNIT = (G / R) ** 0.5


def classical_state(angles, rates):
    """Return the state of a coin with z-x-z angles and their rates."""
    (_, theta, phi), (psi_rate, theta_rate, phi_rate) = angles, rates
    spin = (
        psi_rate * np.sin(theta) * np.sin(phi) + theta_rate * np.cos(phi),
        psi_rate * np.sin(theta) * np.cos(phi) - theta_rate * np.sin(phi),
        psi_rate * np.cos(theta) + phi_rate,
    )
    return np.array([0, 0, 0, 0, 0, 0, *quaternion_from_angles(angles), *spin])


@pytest.mark.parametrize("seed", range(8))
def test_the_spin_along_the_lean_is_the_rate_of_phi_times_the_sine_of_the_tilt(seed):
    rng = np.random.default_rng(seed)
    angles, rates = rng.uniform((0, 0.1, 0), (6, 3.0, 6)), rng.normal(size=3)
    y = classical_state(tuple(angles), rates)
    Rm = np.array(rotation_matrix(tuple(y[6:10])))
    lean = np.array(leaning(tuple(Rm[2])))
    assert lean @ y[10:13] == pytest.approx(rates[2] * np.sin(angles[1]), rel=1e-12)
    assert np.linalg.norm(lean) == pytest.approx(1, rel=1e-14)
    assert Rm[2] @ lean == pytest.approx(0, abs=1e-15)


FALLS = {
    "contour friction": (Contour(2e-5 * R), 0.0, 0.1, 3 / 2, 2 * 2e-5 * UNIT),
    "contour viscosity": (Contour(0.0, 2e-7 * R / UNIT), 0.0, 0.02, 2, 16 / 3 * 2e-7 * UNIT),
    "air": (Contour(0.0, 0.0, 1e-8 * M * UNIT / R), 0.0, 0.03, 3, 2 * np.pi * 1e-8 * UNIT),
    "rolling": (Contour(), 2e-5, 0.02, 1 / 2, 2 / 3 * UNIT * 2e-5 / R),
}
"""The losses, the resistance to rolling, the first tilt, and p and k of the closed form α^p = k (t_f - t)."""


@pytest.mark.slow_after_first
@pytest.mark.parametrize("mode", [Mode.STICKING, Mode.SLIDING])
@pytest.mark.parametrize("name", FALLS)
def test_eulers_disk_stops_as_its_closed_form_says(name, mode):
    """E = 3/2 m g r α and φ' = 2 √(g/(r α)), with or without friction against slip.

    So dα/dt is -(4/3) (c/r) √(g/r) α^(-1/2), -(8/3) (c_v g/r²)/α, -(2 π/3) (η r/m)/α² or
    -(4/3) (δ/r) √(g/r) √α: α falls as the power 2/3, 1/2, 1/3 or 2 of the time that is left.
    """
    contour, delta, start, power, slope = FALLS[name]
    friction = FloorFriction(50.0 if mode == Mode.STICKING else 0.0, delta, contour=contour)
    body, least = scenario(coin=THIN).body, 1e-3
    y, times = follow_for(
        body, friction, mode, eulers_disk(start), np.inf, least=least, error=CONTACT_STEP_ERROR
    )
    tilts = tilts_of(y)
    for low, high in ((1e-3, 1e-2), (1e-2, 1e-1)):
        part = (tilts > low) & (tilts < high)
        assert -np.polyfit(times[part], tilts[part] ** power, 1)[0] == pytest.approx(slope, rel=4e-3)
    part = (tilts > 3e-3) & (tilts < 1e-2)
    along = [np.dot(leaning(rotation_matrix(tuple(one[6:10]))[2]), one[10:13]) for one in y[part]]
    assert np.abs(along) / tilts[part] ** 0.5 == pytest.approx(2 * UNIT, rel=2e-2)


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
        y = classical_state((0.3, tilt, rng.uniform(0, 6)), rng.uniform(-30, 30, 3))
        K = np.array(both_rims(body, friction, y)[0].delassus)
        assert np.linalg.eigvalsh((K + K.T) / 2)[0] > 0


def test_contour_friction_holds_a_coin_on_both_rims_from_rolling_and_none_on_one():
    """At rest the weight's moment is m g a, a the distance of C from the line on which the coin stands."""
    c, thick = 1e-4, {**ZLOTY, "thickness": 4e-3}
    for share in (0.5, 0.9, 1.1):
        body = scenario(coin={**thick, "center_of_mass": [share * c, 0, 0]}).body
        y = set_upright()
        friction = FloorFriction(0.3, contour=Contour(c))
        put_on_floor(body, friction, Mode.UPRIGHT, y)
        assert rests(held(body, friction, Mode.UPRIGHT, y), y) == (share < 1)
        assert not rests(held(body, FloorFriction(0.3), Mode.UPRIGHT, y), y)
        assert not rests(held(body, FloorFriction(0.3, contour=Contour(0.0, c)), Mode.UPRIGHT, y), y)
    thin, y = scenario(coin=THIN).body, set_upright()
    assert rests(held(thin, FloorFriction(0.3, c), Mode.STICKING, y), y)
    assert not rests(held(thin, friction, Mode.STICKING, y), y), "a coin on one rim point may fall"


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
