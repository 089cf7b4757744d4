"""The force and the moments of a floor that resists rolling and pivoting, in one step of MuJoCo's coin."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj.model.settings import Friction
from cointoss.coin_mj.steps import resistance
from cointoss.coin_mj.steps.resistance import Coefficients, PointMotion
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import ApproximationWarning, UnsupportedError
from tests.helpers.draws import AIR, draw_coin, draw_quaternion, draw_release, scenario
from tests.helpers.tuples import quaternion, vector

resisted_force = by_numba(resistance.resisted_force)

pytestmark = [
    pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning"),
    pytest.mark.usefixtures("without_horizon"),
]

NO_LEAN = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def point_motion(numbers: Iterable[float]) -> PointMotion:
    x, y, z, a, b, c = map(float, numbers)
    return x, y, z, a, b, c


def draw_contact(rng):
    """Draw the Delassus matrix of a disc of mass 1 and radius 1 at its rim, and the motion there."""
    turn, angle = np.array(rotation_matrix(quaternion(draw_quaternion(rng)))), rng.uniform(0, 2 * np.pi)
    arm = turn @ [np.cos(angle), np.sin(angle), 0.0]
    J_inverse = turn @ np.diag([4.0, 4.0, 2.0]) @ turn.T
    # v_A = v + ω × a, and the moment of an impulse there about C is a × S.
    across = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    K = np.block(
        [[np.eye(3) - across @ J_inverse @ across, -across @ J_inverse], [J_inverse @ across, J_inverse]]
    )
    coefficients = Coefficients(*vector(rng.uniform(0.02, 0.3, 3)), 0.0)
    return K, coefficients, point_motion(rng.normal(size=6))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("seed", range(20))
def test_no_moment_is_larger_than_the_floor_has_and_each_takes_energy(seed):
    """In a short step: against the motion where it goes on."""
    rng = np.random.default_rng(seed)
    K, coefficients, motion = draw_contact(rng)
    dt, normal = 1e-3, 3.0
    free = np.array(motion) + dt * rng.normal(size=6)
    F, moment = resisted_force(K, coefficients, normal, motion, point_motion(free), NO_LEAN, dt)
    mu, delta, p, _ = coefficients
    N = normal + F[2]
    middle = free + dt * (K @ np.array([*F, *moment])) / 2
    assert N > 0
    assert F[:2] == pytest.approx(-mu * N * middle[:2] / np.hypot(*middle[:2]), abs=1e-2 * mu * N)
    assert moment[:2] == pytest.approx(
        -delta * N * middle[3:5] / np.hypot(*middle[3:5]), abs=1e-2 * delta * N
    )
    assert moment[2] == pytest.approx(-p * N * np.sign(middle[5]), rel=1e-9)
    # MuJoCo prescribes the vertical acceleration: nothing else changes it.
    assert K[2] @ np.array([*F, *moment]) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_a_coin_at_rest_is_held_by_what_pulls_it_and_no_more(seed):
    rng = np.random.default_rng([3, seed])
    K, _, _ = draw_contact(rng)
    dt, still, normal = 1e-3, point_motion(np.zeros(6)), 10.0
    free = point_motion(dt * K @ (rng.uniform(-1, 1, 6) * [1, 1, 0, 1, 1, 1]))
    F, moment = resisted_force(K, Coefficients(1.0, 0.5, 0.5, 0.0), normal, still, free, NO_LEAN, dt)
    after = np.array(free) + dt * K @ np.array([*F, *moment])
    assert np.delete(after, 2) == pytest.approx(0, abs=1e-11)
    F, weak = resisted_force(K, Coefficients(0.0, 1e-3, 2e-3, 0.0), normal, still, free, NO_LEAN, dt)
    assert F[:2] == (0.0, 0.0)
    assert np.hypot(*weak[:2]) == pytest.approx(1e-3 * (normal + F[2]), rel=1e-9)
    assert abs(weak[2]) == pytest.approx(2e-3 * (normal + F[2]), rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_the_contours_moment_acts_along_the_lean_against_the_spin_there(seed):
    """Of the size arm · N while the coin turns, and no more than stops it."""
    rng = np.random.default_rng([5, seed])
    K, _, motion = draw_contact(rng)
    angle, dt, normal = rng.uniform(0, 6), 1e-3, 3.0
    lean = np.array([np.cos(angle), np.sin(angle), 0.0])
    leans = (vector(lean), vector(lean))
    F, moment = resisted_force(K, Coefficients(0.0, 0.0, 0.0, 0.1), normal, motion, motion, leans, dt)
    size = -0.1 * (normal + F[2]) * np.sign(lean @ motion[3:])
    assert np.array(moment) == pytest.approx(size * lean, abs=1e-12)
    assert K[2] @ np.array([*F, *moment]) == pytest.approx(0, abs=1e-12)
    still = point_motion(1e-7 * np.array(motion))
    F, moment = resisted_force(K, Coefficients(0.0, 0.0, 0.0, 0.1), normal, still, still, leans, dt)
    after = np.array(still) + dt * K @ np.array([*F, *moment])
    assert lean @ after[3:] == pytest.approx(0, abs=1e-15)


def test_impacts_before_the_first_contact_have_no_resistance():
    rng = np.random.default_rng(8)
    for law in ("smooth", "coulomb"):
        floor = {"contact": law, "friction": 0.3, "restitution": 0.4}
        case = scenario(coin=draw_coin(rng), floor=floor, air=AIR, release=draw_release(rng))
        tiny = case.replace("floor.rolling_friction", 1e-12, "floor.pivoting_friction", 1e-12)
        plain, near = coin_mj.toss(case), coin_mj.toss(tiny)
        first = plain.contacts[0, 0] if len(plain.contacts) else np.inf
        before = plain.impacts.time < first
        assert before.any()
        assert np.array_equal(plain.impacts.impulse[before], near.impacts.impulse[: before.sum()])


@pytest.mark.parametrize(("field", "told"), [("floor.pivoting_friction", 2e-4), ("air.viscosity", 2e-5)])
def test_beside_native_friction_resistance_is_refused_by_name(field, told):
    case = scenario(floor={"contact": "coulomb", "friction": 0.5}).replace(field, told)
    with pytest.raises(UnsupportedError, match=rf"{field} = {told:g}: .*native friction: 0"):
        coin_mj.toss(case, settings=replace(coin_mj.FINE, friction=Friction.NATIVE))
