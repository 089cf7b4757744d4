"""The bouncing rotor: its map in closed form, the chain against the engine, splitting, the law."""

from itertools import pairwise
from math import inf, pi

import numpy as np
import pytest
from scipy.special import beta

from cointoss.study import run, share, states_of
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.planar_maps import case, planar_rows
from cointoss_reproduction.setups.uncertain_shares import CEILING
from cointoss_reproduction.studies.rotor import law, study
from cointoss_reproduction.studies.rotor.chain import (
    COUNTED,
    MOMENTUM,
    NORMAL,
    POSITION,
    TINY,
    VELOCITY,
    Coin,
    above,
    bounce_all,
    dies_out,
    dot,
    fly,
    next_touch,
    slide,
    spin,
    strike,
    unknown,
)
from cointoss_reproduction.studies.rotor.law import eigenvalue, exponent, moment
from cointoss_reproduction.studies.rotor.splitting import (
    coin_of,
    planar,
    shares_beyond,
    started,
    turned_back,
)

THIN = Coin(inertia=0.25, half=0.0, restitution=0.6, rough=False, slowing=0.0, drag=0.0)
COINS = {
    "thin": THIN,
    "thick": THIN._replace(half=0.3, inertia=0.28),
    "rough": THIN._replace(rough=True),
    "thick, rough": THIN._replace(half=0.3, inertia=0.28, rough=True),
}
VACUUM = {thick: CoinClass(thick=thick, imperfect=False, air=False, coulomb=False) for thick in (False, True)}


@pytest.mark.parametrize("depth_of_dip", [0.01, 0.2, 0.9])
def test_the_equations_of_motion_give_the_map(depth_of_dip):
    nu, fast = 1e-5, 1e5
    dip = depth_of_dip * pi * nu
    # Half a turn before it, so that the passage before has just missed the floor.
    state = planar(THIN, 1 - (dip - pi * nu) - nu**2 / 2, -nu * fast, nu - pi / 2, fast)
    fly(THIN, state, next_touch(THIN, state))
    before = above(THIN, state)
    strike(THIN, state)
    after = state[VELOCITY, 2].real / spin(THIN, state)
    fall = np.sqrt(2 * dip)
    assert after + nu == pytest.approx((1 + THIN.restitution) * fall, rel=2 * fall)
    lost = (1 - THIN.restitution) / (1 + THIN.restitution) * fast**2 / 2 * (nu + after) ** 2
    assert before - above(THIN, state) == pytest.approx(lost, rel=4 * fall)


def test_air_slows_a_flight_by_its_closed_form_to_second_order():
    drag, time = 1e-3, 2.0
    coin = THIN._replace(drag=drag, slowing=2 * drag, own_slowing=3 * drag)
    state, slower = planar(coin, 9.0, 1.0, 0.0, 1.0), np.exp(-drag * time)
    state[MOMENTUM] += 0.5 * state[NORMAL]
    fly(coin, state, time)
    assert state[[POSITION, VELOCITY], 2] == pytest.approx([9, slower - (1 - slower) / drag], rel=1e-6)
    along = dot(state, MOMENTUM, NORMAL)
    across = np.sqrt(dot(state, MOMENTUM, MOMENTUM) - along**2)
    assert (along, across) == pytest.approx((0.5 * slower**3, coin.inertia * slower**2))


def in_flight_again(coin, state):
    """Move a state past two touches, to the same time of the flight that follows."""
    rest = 6.0
    for _ in range(2):
        time = next_touch(coin, state)
        fly(coin, state, time)
        strike(coin, state)
        rest -= time
    fly(coin, state, rest)
    return state


@pytest.mark.parametrize("up", [0.0, 0.2])
@pytest.mark.parametrize("name", COINS)
def test_a_change_is_carried_by_the_derivative(name, up):
    """Of flights and touches, in a plane and with L_z; two coins that start apart are the referee."""
    coin, step = COINS[name], 1e-7

    def released(part):
        state = planar(coin, 3.0 + 0.3 * part, -0.2 - 0.5 * part, 0.4 + 0.7 * part, 2.5 + 0.2 * part)
        state[VELOCITY, 1] = 0.1 - 0.4 * part
        state[MOMENTUM, 2] = 0.0 if coin.rough else up
        return state

    lower, upper = (in_flight_again(coin, released(part)) for part in (-step, step))
    found = in_flight_again(coin, released(TINY * 1j)).imag / TINY
    assert found == pytest.approx((upper - lower).real / (2 * step), rel=1e-5, abs=1e-6)


def followed(scenario, start):
    """Return the touches of a toss until its bounces die out, and its state there, None if they do not."""
    coin, state, touches = coin_of(scenario), started(scenario, start[None])[0], [0.0]
    while above(coin, state) > 0 and len(touches) < 60:
        time = next_touch(coin, state)
        fly(coin, state, time)
        touches.append(touches[-1] + time * (scenario.coin.radius / scenario.gravity) ** 0.5)
        if dies_out(coin, state, strike(coin, state)[0]):
            return touches[1:], state
    return touches[1:], None


@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
@pytest.mark.parametrize("thickness", [0.0, 5e-3])
def test_touches_are_the_engines(law, thickness):
    scenario = case(air=False).replace("floor.contact", law, "coin.thickness", thickness)
    (start,) = states_of(planar_rows(scenario, np.array([0.31]), np.array([40.0])))
    tossed = run(scenario.body, scenario.rules, start).rows["time"][:4]
    assert followed(scenario, start)[0][:4] == pytest.approx(tossed, rel=1e-10)


@pytest.mark.parametrize("thick", VACUUM)
def test_touches_and_contact_in_space_are_the_engines(thick):
    """A contact begins at the engine's time, and the tilt is the engine's where it ends."""
    scenario, off = VACUUM[thick].scenario, []
    for start in study.releases(VACUUM[thick], inf, 60):
        tossed, (touches, state) = run(scenario.body, scenario.rules, start), followed(scenario, start)
        assert touches[:2] == pytest.approx(tossed.rows["time"][: len(touches[:2])], rel=1e-6)
        if state is not None and len(tossed.contacts) and abs(tossed.contacts[0, 0] - touches[-1]) < 1e-4:
            slide(coin_of(scenario), state)
            end = tossed.started.states[np.searchsorted(tossed.started.times, tossed.contacts[0, 1])]
            off.append(abs(state[NORMAL, 2].real - 1 + 2 * (end[7] ** 2 + end[8] ** 2)))
    assert sum(one < 0.1 for one in off) == len(off) > 15


def test_l_z_and_l_zeta_turn_a_coin_back_where_their_potential_is_m_g_r():
    states = np.array([planar(THIN, 1.0, 0.0, 0.7, turning) for turning in (2.0, 2.0, 3.0)])
    states[1:, MOMENTUM, 2], states[2, MOMENTUM] = 0.2, states[2, MOMENTUM] + 0.3 * states[2, NORMAL]
    flat, *others = turned_back(THIN, states)
    assert flat == 0
    for state, sine in zip(states[1:], others, strict=True):
        own, sides = dot(state, MOMENTUM, NORMAL).real, np.sqrt(1 - sine**2) * np.array([-1, 1])
        potential = (state[MOMENTUM, 2].real - own * sides) ** 2 / (2 * THIN.inertia * sine**2)
        assert min(potential) == pytest.approx(1)


def test_what_part_but_end_alike_counts_for_less():
    held, parted, apart = np.zeros(8, dtype=bool), np.arange(8) < 4, np.arange(8) % 2 == 0
    weighed, plain = study.split(held, parted, apart)["f"], share(parted)
    assert weighed.value == pytest.approx(plain.value * 0.5 / CEILING)


@pytest.mark.slow
def test_splitting_finds_the_shares_of_tosses_that_are_not_split():
    scenario, levels = case(air=False), np.log(0.0125) + np.log(10) * np.arange(3, 9)

    def found(levels, seed, tosses):
        rng = np.random.default_rng(seed)
        return shares_beyond(scenario, study.planar_states(scenario, rng, 4 * tosses), levels, rng, tosses)

    split = np.array([found(levels, seed, 2000) for seed in range(10)])
    plain = [found(levels[-1:], seed + 50, 5000)[0] for seed in range(10)]
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
    states, known = planar(THIN, 0.9, 0.0, 0.3, 0.1)[None], unknown(1)
    bounce_all(THIN, states, known, 10.0, np.random.default_rng(1))
    assert known[0, COUNTED] == -inf
