"""Flights in closed form: against the integrated ones, against closed forms, and that no touch is missed."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from cointoss.analytic.flight.closed_flight import bounds_in_air, fly_closed, sample_closed
from cointoss.analytic.flight.fall import ORDER, expand
from cointoss.analytic.flight.flying import fly, sample
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.analytic.flight.state_vector import spin_of, state_of, velocity_of
from cointoss.analytic.flight.touch_search import fly_by_steps
from cointoss.analytic.flight.turning import turning_of, turns_in_closed_form
from cointoss.analytic.toss import state_at_release
from cointoss.models.geometry import evaluate_gap
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_release, scenario

fly = by_numba(fly)
fly_closed = by_numba(fly_closed)
fly_by_steps = by_numba(fly_by_steps)
sample_closed = by_numba(sample_closed)
sample = by_numba(sample)
sample_flight = by_numba(sample_flight)
bounds_in_air = by_numba(bounds_in_air)

STRONG_AIR = {"normal": 40.0, "tangential": 10.0}


def draw_flight(
    rng: np.random.Generator, thickness: float, air: dict[str, float], coin: dict[str, Any] = ZLOTY
) -> tuple[Scenario, np.ndarray]:
    """Draw a coin high up, or just lifted off the floor; if it is balanced, it turns in closed form."""
    release = draw_release(rng, spin=80.0)
    if air:
        release["angular_velocity"][2] = 0.0
    case = scenario(coin={**coin, "thickness": thickness}, air=air, release=release)
    y = state_at_release(case.release)
    if rng.integers(2):
        y[2] -= evaluate_gap(case.body, state_of(y)).gap
        y[5] += rng.uniform(0.01, 1.0) - evaluate_gap(case.body, state_of(y)).speed
    return case, y


@pytest.mark.parametrize("thickness", [2e-3, 0.0, 2e-2])
@pytest.mark.parametrize("air", [{}, AIR, STRONG_AIR])
def test_a_flight_in_closed_form_is_the_integrated_one_and_samples_are_its_states(thickness, air):
    rng = np.random.default_rng([61, int(1e4 * thickness), len(air)])
    turned, evaluations, sampled, also = 0.0, 0, np.empty((9, 13)), np.empty((9, 13))
    for _ in range(10):
        case, start = draw_flight(rng, thickness, air)
        body, closed, integrated = case.body, start.copy(), start.copy()
        assert turns_in_closed_form(body, spin_of(start))
        flown, touches, evaluated, *_ = fly_closed(body, closed, 10.0, False)
        other, also_touches, *_ = fly_by_steps(body, integrated, 10.0, True)
        assert touches
        assert also_touches
        # The integrated flight errs by 1e-13 on the scales of the coin, over tens of steps.
        assert flown == pytest.approx(other, abs=1e-12)
        times = np.linspace(0, flown, 9)
        sample_closed(body, start, 0.0, times, sampled)
        sample_flight(body, start, 0.0, times, also)
        assert sampled[0] == pytest.approx(start, abs=1e-15)
        assert sampled[-1] == pytest.approx(closed, abs=1e-13)
        for found, due in ((closed, integrated), (sampled.T, also.T)):
            assert found[:10] == pytest.approx(due[:10], abs=1e-11)
            assert found[10:] == pytest.approx(due[10:], abs=1e-10)
        # Late in a long flight one step of floating-point time lowers the coin by 1e-14 of its radius.
        assert abs(evaluate_gap(body, state_of(closed)).gap) < 1e-13 * body.radius
        turned += float(np.linalg.norm(start[10:13])) * flown
        evaluations += evaluated
    assert turned > 30, "the coins should turn"
    # In strong air the bounds are wide.
    assert evaluations < 10 * (40 if air == STRONG_AIR else 12)


def test_thin_air_is_nearly_none():
    """The change is of first order in λ, whichever of the two forms a flight has."""
    release = draw_release(np.random.default_rng(63))
    release["angular_velocity"][2] = 0.0
    ends = []
    for share in (0.0, 1e-8, 2e-8):
        case = scenario(air={"normal": 0.8 * share, "tangential": 0.2 * share}, release=release)
        states = np.empty((1, 13))
        sample(case.body, state_at_release(case.release), 0.0, np.array([0.3]), states)
        ends.append(states[0])
    assert np.abs(ends[1] - ends[0]).max() > 1e-10
    assert ends[2] - ends[0] == pytest.approx(2 * (ends[1] - ends[0]), abs=1e-13)


def gaps_of(body, states):
    """Return the gap in each state, (n, 13): that of `evaluate_gap`, of all of them at once."""
    e0, e1, e2, e3 = states[:, 6:10].T
    n = np.array([2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), e0**2 - e1**2 - e2**2 + e3**2])
    n /= np.sum(states[:, 6:10] ** 2, axis=1)
    reach = body.radius * np.hypot(n[0], n[1]) + body.thickness / 2 * np.abs(n[2])
    return states[:, 2] - body.center @ n - reach


@pytest.mark.parametrize(
    ("coin", "thickness", "air", "noted"),
    [*product([ZLOTY], [0.0, 2e-3, 2e-2], [{}, AIR], [np.inf]), (IMPERFECT, 2e-3, AIR, 0.1)],
)
def test_no_touch_is_passed_and_no_minimum_is_below_half_of_the_graze(coin, thickness, air, noted):
    """Flights that are integrated note no minimum above a part of the radius."""
    rng = np.random.default_rng([64, int(1e4 * thickness), len(air)])
    minima, tight = 0, 0
    for _ in range(150):
        case, start = draw_flight(rng, thickness, air, coin)
        body, end = case.body, start.copy()
        flown, *_, height = fly(body, end, 10.0, True)
        states = np.empty((1500, 13))
        sample(body, start, 0.0, flown * np.linspace(1e-6, 1 - 1e-6, len(states)), states)
        gaps = gaps_of(body, states)
        assert gaps[700] == pytest.approx(evaluate_gap(body, state_of(states[700])).gap, abs=1e-15)
        assert gaps.min() > 0
        inner = gaps[1:-1][(gaps[1:-1] < gaps[:-2]) & (gaps[1:-1] <= gaps[2:])]
        minima += len(inner)
        assert inner.min(initial=np.inf) >= min(height / 2, noted * body.radius)
        # Not far below them, unless the coin goes high: then it is a tenth of the reach of its rim.
        tight += np.inf > height > 0.05 * inner.min(initial=np.inf)
    assert minima > 20
    assert tight > 10


@pytest.mark.parametrize(
    ("parts", "spin", "is_closed"),
    [
        ({}, (1.0, 2.0, 3.0), True),
        ({"air": AIR}, (1.0, 2.0, 0.0), True),
        ({"air": AIR}, (1.0, 2.0, 3.0), False),
        ({"coin": IMPERFECT}, (1.0, 2.0, 0.0), False),
        ({"air": {**AIR, "exponent": 1.0}}, (1.0, 2.0, 0.0), False),
    ],
)
def test_other_coins_are_integrated(parts, spin, is_closed):
    assert turns_in_closed_form(scenario(**parts).body, spin) == is_closed


@pytest.mark.parametrize("spin", [40.0, 1e-150, 1e-158, 3e-162])
def test_a_spin_that_dies_away_to_nothing_leaves_the_fall_right(spin):
    """In a long fall it passes all sizes down to none, also those whose squares have no digits."""
    air, release = {"normal": 50.0, "tangential": 12.5}, {"position": [0, 0, 60.0], "angles": [0.3, 1.0, 0.2]}
    case = scenario(air=air, release={**release, "angular_velocity": [spin, spin / 2, 0.0]})
    closed, integrated = state_at_release(case.release), state_at_release(case.release)
    flown, *_ = fly_closed(case.body, closed, 500.0, False)
    other, *_ = fly_by_steps(case.body, integrated, 500.0, False)
    assert flown == pytest.approx(other, rel=1e-12)
    assert closed[:10] == pytest.approx(integrated[:10], abs=1e-11)


def test_a_coin_released_upright_on_the_floor_touches_it_at_once():
    release = {"position": [0, 0, ZLOTY["radius"]], "angles": [0.3, np.pi / 2, 0.2]}
    case = scenario(release={**release, "angular_velocity": [20.0, 10.0, 5.0]})
    y = state_at_release(case.release)
    flown, touches, *_ = fly_closed(case.body, y, 1.0, False)
    assert (flown, touches) == (0.0, True)
    assert abs(evaluate_gap(case.body, state_of(y)).gap) < 1e-13 * case.body.radius


def test_a_flight_that_is_cut_short_keeps_its_velocity():
    """Rounding leaves slivers of time at the end of a flight, in which the coin goes on as it was."""
    body = scenario(air=AIR, release={"position": [0, 0, 1], "angular_velocity": [20, 0, 0]}).body
    for duration in np.concatenate([10.0 ** np.arange(-15, 0), np.linspace(1e-12, 3e-12, 40)]):
        y = np.zeros(13)
        y[2], y[5], y[6], y[10] = 1.2, -2.0, 1.0, 20.0
        assert fly_closed(body, y, duration, False).time == duration
        assert y[5] == pytest.approx(-2.0, abs=1.1 * 9.81 * duration + 1e-15)
        assert y[5] < -1.99 or duration > 1e-3


@pytest.mark.parametrize(("share", "slope", "least"), [(1.0, 0.0, 0.0), (0.1, 0.0, 0.5), (1.0, 1.5, 0.0)])
def test_no_derivative_of_the_height_in_air_passes_its_bound_or_stays_far_below_it(share, slope, least):
    """By the clock, which the air slows; the smaller the moments of inertia, the sooner.

    Args:
        share: of the moments of inertia of a disc.
        slope: of the floor [rad]: the weight speeds the coin up along it, too.
        least: of each bound is met.
    """
    rng, met = np.random.default_rng(65), np.zeros(3)
    J = share * ZLOTY["mass"] * ZLOTY["radius"] ** 2 / 4
    coin = {**ZLOTY, "inertia": [[J, 0, 0], [0, J, 0], [0, 0, 2 * J]]}
    for number in range(40):
        w, v = [*rng.uniform(-40, 40, 2) * (number % 2), 0], rng.uniform(-5, 2) * (number % 3 > 0)
        release = {**draw_release(rng), "velocity": [0, 0, v], "angular_velocity": w}
        case = scenario(
            coin=coin,
            air=STRONG_AIR,
            floor={"slope": slope},
            release={**release, "position": [0, 0, 3.0]},
        )
        body, y, series = case.body, state_at_release(case.release), np.empty((4, ORDER + 1))
        turning = turning_of(body, state_of(y))
        piece = expand(body, turning, y, np.inf, series)
        bounds = bounds_in_air(body, turning, piece, velocity_of(y))
        height, clock = Polynomial(series[3, : piece.order + 1]), np.linspace(0, piece.length, 50)
        acceleration, jerk = height.deriv(2)(clock), height.deriv(3)(clock)
        assert (-bounds.down <= acceleration).all()
        assert (acceleration <= bounds.up).all()
        assert (np.abs(jerk) <= bounds.jerk).all()
        parts = np.array([-acceleration, acceleration, np.abs(jerk)]).max(axis=1)
        met = np.maximum(met, parts / [bounds.down, max(bounds.up, 1e-9), bounds.jerk])
    assert (met >= least).all()
