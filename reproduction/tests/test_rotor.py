"""The bouncing rotor: its map in closed form, the chain's events against the engine, splitting, the law."""

from itertools import pairwise
from math import pi

import numpy as np
import pytest
from scipy.special import beta

from cointoss import analytic
from cointoss_reproduction.setups.planar_maps import case
from cointoss_reproduction.studies.rotor import law
from cointoss_reproduction.studies.rotor.chain import (
    ANGLE,
    SPIN,
    Coin,
    V,
    Z,
    depth,
    energy,
    fly,
    next_touch,
    stretch_all,
    strike,
)
from cointoss_reproduction.studies.rotor.law import eigenvalue, exponent, moment
from cointoss_reproduction.studies.rotor.splitting import coin_of, shares_beyond

THIN = Coin(inertia=0.25, half=0.0, restitution=0.6, rough=False, slowing=0.0, drag=0.0)
COINS = {
    "thin": THIN,
    "thick": THIN._replace(half=0.3, inertia=0.28),
    "rough": THIN._replace(rough=True),
    "thick, rough": THIN._replace(half=0.3, inertia=0.28, rough=True),
}


@pytest.mark.parametrize("depth_of_dip", [0.01, 0.2, 0.9])
def test_the_equations_of_motion_give_the_map(depth_of_dip):
    nu, spin = 1e-5, 1e5
    dip = depth_of_dip * pi * nu
    # Half a turn before it, so that the passage before has just missed the floor.
    state = np.array([1 - (dip - pi * nu) - nu**2 / 2, -nu * spin, nu - pi / 2, spin, 0.0])
    fly(THIN, state, np.zeros(5), next_touch(THIN, state))
    before = energy(THIN, state)
    strike(THIN, state, np.zeros(5))
    after = state[V] / state[SPIN]
    fall = np.sqrt(2 * dip)
    assert after + nu == pytest.approx((1 + THIN.restitution) * fall, rel=2 * fall)
    lost = (1 - THIN.restitution) / (1 + THIN.restitution) * spin**2 / 2 * (nu + after) ** 2
    assert before - energy(THIN, state) == pytest.approx(lost, rel=4 * fall)


def test_air_slows_a_flight_by_its_closed_form_to_second_order():
    drag, time = 1e-3, 2.0
    state, change = np.array([9.0, 1.0, 0.0, 1.0, 0.5]), np.array([0.0, 1.0, 0.0, 1.0, 0.5])
    fly(THIN._replace(drag=drag, slowing=2 * drag), state, change, time)
    slower = np.exp(-drag * time)
    assert change == pytest.approx([time, slower, time, slower**2, 0.5 * slower])
    assert state == pytest.approx([9, slower - (1 - slower) / drag, time, slower**2, 0.5 * slower], rel=1e-6)


def in_flight_again(coin, state, change):
    """Move a state and its change past two touches, to the same time of the flight that follows."""
    rest = 6.0
    for _ in range(2):
        time = next_touch(coin, state)
        fly(coin, state, change, time)
        strike(coin, state, change)
        rest -= time
    fly(coin, state, change, rest)
    return state


@pytest.mark.parametrize("name", COINS)
def test_a_change_is_carried_by_the_derivative(name):
    """Of flights and touches; two coins that start apart are the referee."""
    coin, step = COINS[name], 1e-7
    start, change = np.array([3.0, -0.2, 0.4, 2.5, 0.1]), np.array([0.3, -0.5, 0.7, 0.2, -0.4])
    lower, upper = (in_flight_again(coin, start + at * change, np.zeros(5)) for at in (-step, step))
    in_flight_again(coin, start, change)
    assert change == pytest.approx((upper - lower) / (2 * step), rel=1e-5)


@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
@pytest.mark.parametrize("thickness", [0.0, 5e-3])
def test_touches_are_the_engines(law, thickness):
    scenario = case(air=False, restitution=0.6).replace(
        "floor.contact", law, "coin.thickness", thickness, "release.position.z", 0.31
    )
    tossed = analytic.toss(scenario)
    coin, length = coin_of(scenario), scenario.coin.radius
    unit = np.sqrt(length / scenario.gravity)
    spin = scenario.release.angular_velocity[0] * unit
    state, now = np.array([0.31 / length, 0.0, 0.0, spin, 0.0]), 0.0
    for touched in tossed.impacts.time[:4]:
        time = next_touch(coin, state)
        fly(coin, state, np.zeros(5), time)
        now += time
        strike(coin, state, np.zeros(5))
        assert now * unit == pytest.approx(touched, rel=1e-10)


def test_the_gap_is_open_before_the_touch_and_closed_there():
    rng = np.random.default_rng(3)
    for coin in COINS.values():
        for _ in range(50):
            state = np.array([rng.uniform(1.1, 4), rng.normal(), rng.uniform(0, 6), rng.normal(0, 5), 0.0])
            touch = next_touch(coin, state)
            for time in np.linspace(0, touch, 200):
                q, _ = depth(coin, state[ANGLE] + state[SPIN] * time, state[SPIN])
                gap = state[Z] + state[V] * time - time**2 / 2 - q
                assert gap > -1e-9
                assert gap < 1e-9 or time < touch


@pytest.mark.slow
def test_splitting_finds_the_shares_of_tosses_that_are_not_split():
    scenario, levels = case(air=False), np.log(0.0125) + np.log(10) * np.arange(3, 9)
    split = np.array([shares_beyond(scenario, levels, np.random.default_rng(run), 2000) for run in range(10)])
    plain = [
        shares_beyond(scenario, levels[-1:], np.random.default_rng(run + 50), 5000)[0] for run in range(10)
    ]
    means = split[:, -1].mean(), np.mean(plain)
    errors = np.hypot(split[:, -1].std(), np.std(plain)) / 3
    assert abs(means[0] - means[1]) < 4 * errors < means[1]
    assert all((former > later).all() for former, later in pairwise(split.T))


@pytest.mark.parametrize("power", [0.4, 1.0])
def test_an_eigenvalue_lies_between_the_traces_of_its_kernel_and_of_its_square(power):
    """√π/4 and 4^(β - 1) B(β, β)/4, by y = s t and y' = s (1 - t)."""
    assert np.sqrt(pi) / 4 < eigenvalue(power) < np.sqrt(4 ** (power - 1) * beta(power, power) / 4)


@pytest.mark.parametrize(("power", "chi", "energy_"), [(0.4, 0.3, 20.0), (1.2, 0.6, 48.0)])
def test_the_moment_grows_with_energy_as_each_touch_asks(power, chi, energy_):
    """κ is its slope over what the first touch leaves; the eigenvalue of a touch is then 1."""
    left, step = chi * energy_, 1e-4
    kappa = (moment(power, chi, energy_ + step) - moment(power, chi, energy_ - step)) / (2 * step * chi)
    a = np.sqrt(4 * left * kappa * (1 - chi) / (1 + chi))
    by_touch = 2 * (8 * (1 + chi) ** 2 * left) ** power * eigenvalue(power) / (pi * a * (1 + chi) ** 2)
    assert by_touch == pytest.approx(1, rel=1e-5)


def test_the_exponent_is_where_the_moment_grows_as_fast_as_asked(monkeypatch):
    """At so many nodes that it takes little time."""
    monkeypatch.setattr(law, "NODES", 40)
    monkeypatch.setattr(law, "eigenvalue", eigenvalue.__wrapped__)
    chi, energy_, stretch = 0.3, 48.0, 120.0
    power, step = exponent(chi, energy_, stretch), 1e-3
    slope = (moment(power + step, chi, energy_) - moment(power - step, chi, energy_)) / (2 * step)
    assert slope == pytest.approx(stretch, rel=1e-3)


def test_a_coin_that_cannot_pass_is_let_go():
    rng = np.random.default_rng(1)
    states, changes = np.array([[0.9, 0.0, 0.3, 0.1, 0.0]]), np.eye(5)[:1]
    assert stretch_all(THIN, states, changes, np.zeros(1), 10.0, rng)[0] == -np.inf
