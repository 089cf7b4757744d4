"""Free flight: closed forms, invariants, order of convergence, and an independent integration."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.flight.equations_of_motion import derivative, flight_of
from cointoss.analytic.flight.integrated_flight import step
from cointoss.analytic.flight.runge_kutta import combined_error
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.flight.touch_search import gap_acceleration
from cointoss.analytic.numerics.tableau import STAGES
from cointoss.analytic.toss import state_at_release
from cointoss.compare.metrics.trajectories import attitude_angle
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.referee import Referee
from tests.helpers.states import energies, gaps

pytestmark = pytest.mark.usefixtures("without_horizon")

HIGH = {"max_time": 0.5}


def in_flight(rng, in_air, coin=None, spin=60.0, exponent=0.0):
    """A toss that stays in the air for half a second."""
    release = {**draw_release(rng, spin), "position": [0.1, -0.2, 5.0]}
    air = {**AIR, "exponent": exponent} if in_air else {}
    return scenario(coin=coin or draw_coin(rng), air=air, release=release, ending=HIGH)


def test_mass_center_falls_on_a_parabola_in_vacuum():
    case = in_flight(np.random.default_rng(1), in_air=False)
    t = np.linspace(0, 0.5, 50)
    states = analytic.toss(case).sample(t)
    x0, v0 = np.array(case.release.position), np.array(case.release.velocity)
    expected = x0 + t[:, None] * v0 - 0.5 * 9.81 * t[:, None] ** 2 * np.array([0, 0, 1])
    assert np.abs(states.position - expected).max() < 5e-15
    assert np.abs(states.velocity - v0 + 9.81 * t[:, None] * np.array([0, 0, 1])).max() < 5e-15


def test_ideal_coin_precesses_about_its_angular_momentum_in_vacuum():
    case = in_flight(np.random.default_rng(2), in_air=False, coin=ZLOTY)
    J = case.coin.inertia_about_C
    e, w = case.release.attitude, np.array(case.release.angular_velocity)
    R = np.array(rotation_matrix(e))
    L = R @ J @ w
    rate, axis, n0 = np.linalg.norm(L) / J[0, 0], L / np.linalg.norm(L), R[:, 2]
    t = np.linspace(0, 0.5, 40)[:, None]
    turned = (
        n0 * np.cos(rate * t)
        + np.cross(axis, n0) * np.sin(rate * t)
        + axis * (axis @ n0) * (1 - np.cos(rate * t))
    )
    states = analytic.toss(case).sample(t[:, 0])
    assert rate * 0.5 > 10, "the normal should go round"
    assert np.abs(states.normal - turned).max() < 1e-11


def test_planar_spin_decays_exponentially_in_air():
    case = scenario(air=AIR, release={"position": [0, 0, 5.0], "angular_velocity": [0, 30.0, 0]}, ending=HIGH)
    body = case.body
    t = np.linspace(0, 0.5, 30)
    w = analytic.toss(case).sample(t).angular_velocity
    expected = 30 * np.exp(-body.drag.moment_tangential * t / body.inertia[0][0])
    assert expected[-1] < 28, "the air should slow the coin"
    assert np.abs(w[:, 1] - expected).max() < 1e-11
    assert np.all(w[:, [0, 2]] == 0)


@pytest.mark.slow
def test_energy_and_angular_momentum_are_kept_in_vacuum():
    rng = np.random.default_rng(3)
    for _ in range(300):
        case = in_flight(rng, in_air=False)
        states = analytic.toss(case).sample(np.linspace(0, 0.5, 4))
        R = np.array([rotation_matrix(tuple(e)) for e in states.quaternion])
        L = np.einsum("nij,jk,nk->ni", R, case.coin.inertia_about_C, states.angular_velocity)
        E = energies(case, states)
        assert np.abs(E / E[0] - 1).max() < 1e-11
        assert np.linalg.norm(L - L[0], axis=1).max() < 1e-11 * np.linalg.norm(L[0])


@pytest.mark.parametrize(("b", "tosses"), [(0.0, 50), (0.5, 3), (1.0, 3)])
def test_air_never_adds_energy(b, tosses):
    rng = np.random.default_rng(4)
    for _ in range(tosses):
        case = in_flight(rng, in_air=True, exponent=b)
        states = analytic.toss(case).sample(np.linspace(0, 0.5, 200))
        assert np.all(np.diff(energies(case, states)) < 0)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("seed", range(2))
def test_flight_in_air_is_that_of_the_papers_integrals(seed):
    case = in_flight(np.random.default_rng(100 + seed), in_air=True)
    referee = Referee(case)
    _, y = referee.fly(referee.start(), 0.5, until_touch=False)
    end = analytic.toss(case).sample([0.5])
    # The referee's quadrature of the kinked pressure is good to 1e-7 of a drag that is itself weak.
    assert np.abs(end.position[0] - y[:3]).max() < 1e-8
    assert np.abs(end.velocity[0] - y[3:6]).max() < 1e-8
    assert np.abs(np.abs(end.quaternion[0] @ y[6:10]) / np.linalg.norm(y[6:10]) - 1) < 1e-12
    assert np.abs(end.angular_velocity[0] - y[10:13]).max() < 1e-8 * np.abs(y[10:13]).max()


def test_one_step_is_of_order_eight():
    case = scenario(
        coin=IMPERFECT,
        air=AIR,
        release={"position": [0, 0, 5.0], "angular_velocity": [20.0, 30.0, -10.0]},
    )
    body, y0 = case.body, state_at_release(case.release)

    def after(steps):
        y, y_new, stages = y0.copy(), np.empty(STATE_SIZE), np.empty((STAGES, STATE_SIZE))
        for _ in range(steps):
            derivative(body, y, stages[0])
            step(body, y, 0.2 / steps, stages, y_new)
            y[:] = y_new
        return y

    exact = after(400)
    counts = np.array([8, 12, 16, 24])
    errors = [np.linalg.norm((after(int(n)) - exact)[6:10]) for n in counts]
    assert min(errors) > 1e-13, "rounding would hide the order"
    assert 7.6 < -np.polyfit(np.log(counts), np.log(errors), 1)[0] < 8.8


def test_turning_the_sign_of_the_quaternion_changes_nothing():
    case = in_flight(np.random.default_rng(6), in_air=True)
    flipped = case.replace("release.quaternion", [-x for x in case.release.attitude])
    t = np.linspace(0, 0.5, 20)
    a, b = analytic.toss(case).sample(t), analytic.toss(flipped).sample(t)
    assert np.array_equal(a.position, b.position)
    assert np.array_equal(a.quaternion, -b.quaternion)
    assert np.all(attitude_angle(a, b) == 0)


def test_quaternion_keeps_its_norm():
    states = analytic.toss(in_flight(np.random.default_rng(7), in_air=True)).sample(np.linspace(0, 0.5, 500))
    assert np.abs(np.linalg.norm(states.quaternion, axis=1) - 1).max() < 4e-16


@pytest.mark.parametrize("seed", range(8))
def test_the_acceleration_of_the_gap_is_that_of_its_samples(seed):
    case = in_flight(np.random.default_rng(seed), in_air=True)
    body, dt = case.body, 1e-4
    states = analytic.toss(case).sample([0.2 - dt, 0.2, 0.2 + dt])
    columns = (states.position, states.velocity, states.quaternion, states.angular_velocity)
    y = np.concatenate([column[1] for column in columns])
    # Second differences err by the gap's fourth derivative, ~ r w^4 dt^2/12, and by rounding, 1e-15/dt^2.
    assert gap_acceleration(body, flight_of(body, y)) == pytest.approx(
        np.diff(gaps(body, states), 2)[0] / dt**2, rel=1e-3, abs=1e-3
    )


@pytest.mark.parametrize(
    ("sum_5", "sum_3"), [(1e300, 1e302), (1e304, 1e308), (1e306, np.inf), (np.inf, np.inf)]
)
def test_a_step_that_overflows_is_never_accepted(sum_5, sum_3):
    """The squares of its slopes leave the range of floating-point numbers one after the other."""
    assert not combined_error(1e-3, sum_5, sum_3, 13) <= 1
