"""The bouncing rotor: its map in closed form, the chain's events against the engine, splitting, the law."""

from itertools import pairwise
from math import log, pi

import numpy as np
import pytest

from cointoss import analytic
from cointoss_reproduction.setups.planar_maps import case
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
from cointoss_reproduction.studies.rotor.law import eigenvalue, exponent, logarithm, moment
from cointoss_reproduction.studies.rotor.splitting import coin_of, shares_beyond

THIN = Coin(inertia=0.25, half=0.0, restitution=0.6, rough=False, slowing=0.0, drag=0.0)
COINS = {
    "thin": THIN,
    "thick": THIN._replace(half=0.3, inertia=0.28),
    "rough": THIN._replace(rough=True),
    "thick, rough": THIN._replace(half=0.3, inertia=0.28, rough=True),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["map", "loss"])
def test_a_touch_of_a_slowly_hopping_rotor_in_symbols(name):
    """Newton's impact at the angle ν - s from upright, where the end falls at W s, to leading order."""
    import sympy

    small, nu, s, chi, spin = sympy.symbols("small nu s chi W", positive=True)
    phi = small * (nu - s)
    # The end lies cos φ below the centre and sin φ beside it; the centre falls at ν W.
    falling = -small * nu * spin + spin * sympy.sin(phi)
    impulse = -(1 + chi) * falling / (1 + 4 * sympy.sin(phi) ** 2)
    up, turning = -small * nu * spin + impulse, spin + 4 * sympy.sin(phi) * impulse
    energies = [(v**2 + w**2 / 4) / 2 for v, w in ((-small * nu * spin, spin), (up, turning))]
    found, order, expected = {
        "map": (up / turning, 1, (1 + chi) * s - nu),
        "loss": (energies[0] - energies[1], 2, (1 - chi) / (1 + chi) * spin**2 / 2 * ((1 + chi) * s) ** 2),
    }[name]
    leading = sympy.series(found, small, 0, order + 1).removeO().coeff(small, order)
    assert sympy.simplify(leading - expected) == 0


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


def test_a_kernel_whose_trace_is_known():
    """At β = 1 it is exp(-(y + y')²): traces of it and of its square are integrals in closed form."""
    y, weights = np.polynomial.legendre.leggauss(400)
    y, weights = 3 * (y + 1), 3 * weights
    squares = float(weights @ np.exp(-2 * (y[:, None] + y) ** 2) @ weights)
    assert squares == pytest.approx(1 / 4, rel=1e-8)
    assert np.sqrt(pi) / 4 < eigenvalue(1.0) < np.sqrt(squares)


def test_one_touch_has_the_moment_of_the_kernel():
    """E[S^β exp(-κ loss)] over one touch of a rotor is the kernel's integral, to the first order in ν."""
    beta, chi, spin, nu = 0.6, THIN.restitution, 1e5, 1e-5
    kappa = 1.0
    dips = pi * nu * (np.arange(400_000) + 0.5) / 400_000 * 4e-3
    fall = np.sqrt(2 * dips)
    after = (1 + chi) * fall - nu
    up = after > 0
    stretch = 2 * spin**2 * (1 + chi) ** 2 * nu / (nu + after)
    loss = (1 - chi) / (1 + chi) * spin**2 / 2 * (nu + after) ** 2
    sampled = np.mean(np.where(up, stretch**beta * np.exp(-kappa * loss), 0.0)) * 4e-3
    scale = np.sqrt(kappa * (1 - chi) / (1 + chi) / 2) * spin
    y = np.linspace(0, 12, 200_001)
    kernel = ((nu * scale + y) / (nu * scale)) ** (1 - beta) * np.exp(-((nu * scale + y) ** 2))
    expected = (
        (2 * spin**2 * (1 + chi) ** 2) ** beta * np.trapezoid(kernel, y) / (scale * pi * (1 + chi) ** 2)
    )
    assert sampled == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize(("beta", "chi", "energy_"), [(0.4, 0.3, 20.0), (1.2, 0.6, 48.0)])
def test_the_moment_grows_with_energy_as_each_touch_asks(beta, chi, energy_):
    """κ is its slope over what the first touch leaves; the eigenvalue of a touch is then 1."""
    left, step = chi * energy_, 1e-4
    kappa = (moment(beta, chi, energy_ + step) - moment(beta, chi, energy_ - step)) / (2 * step * chi)
    a = np.sqrt(4 * left * kappa * (1 - chi) / (1 + chi))
    by_touch = 2 * (8 * (1 + chi) ** 2 * left) ** beta * eigenvalue(beta) / (pi * a * (1 + chi) ** 2)
    assert by_touch == pytest.approx(1, rel=1e-5)


@pytest.mark.slow
def test_the_exponent_is_where_the_moment_grows_as_fast_as_asked():
    chi, energy_, stretch = 0.3, 48.0, 120.0
    beta, step = exponent(chi, energy_, stretch), 1e-3
    slope = (moment(beta + step, chi, energy_) - moment(beta - step, chi, energy_)) / (2 * step)
    assert slope == pytest.approx(stretch, rel=1e-3)


@pytest.mark.slow
def test_the_exponent_grows_as_the_logarithm_of_a_logarithm():
    at = [exponent(0.6, 48.0, 10.0**power) for power in (20, 30)]
    assert (at[1] - at[0]) / (10 * log(10)) == pytest.approx(1 / (2 * logarithm(0.6, 48.0)), rel=0.05)


def test_a_coin_that_cannot_pass_is_let_go():
    rng = np.random.default_rng(1)
    states, changes = np.array([[0.9, 0.0, 0.3, 0.1, 0.0]]), np.eye(5)[:1]
    assert stretch_all(THIN, states, changes, np.zeros(1), 10.0, rng)[0] == -np.inf
