"""Flights by power series: against an independent integration; and the proof that they are clear."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.gap_polynomials import DEGREE, TimeWindow, gap_polynomials, time_surely_clear
from cointoss.analytic.flight.integrated_flight import (
    first_step,
    flight_step,
    flight_work,
    sample_flight,
    within_step,
)
from cointoss.analytic.flight.power_series import COLUMNS, ORDER, ROWS, expand_flight
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.touch_search import fly_by_steps
from cointoss.analytic.toss import state_at_release
from cointoss.models.body import Body
from cointoss.models.geometry import evaluate_gap
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import Array
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_release, scenario

fly_by_steps = by_numba(fly_by_steps)
sample_flight = by_numba(sample_flight)
gap_polynomials = by_numba(gap_polynomials)
time_surely_clear = by_numba(time_surely_clear)
expand_flight = by_numba(expand_flight)


def coin_and_start(rng, *, thickness=2e-3, offset=PAPER_OFFSET, air=AIR, spin=40.0):
    if thickness == 0:
        offset = [*offset[:2], 0.0]
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        air=air,
        release=draw_release(rng, spin=spin),
    )
    return case.body, state_at_release(case.release)


def flown(body: Body, start: Array, duration: float) -> Array:
    """Give the state after a flight, step by step."""
    work, y, y_new, elapsed = flight_work(body), start.copy(), np.empty(13), 0.0
    while elapsed < duration:
        made, _, order = flight_step(body, y, first_step(body, y), duration - elapsed, work)
        within_step(body, y, made, order, work, y_new)
        y[:] = y_new
        elapsed += made
    return y


@pytest.mark.parametrize("air", [{}, AIR, {"normal": 20.0, "tangential": 5.0}])
@pytest.mark.parametrize("offset", [(0.0, 0.0, 0.0), PAPER_OFFSET])
def test_a_flight_by_power_series_is_that_of_an_independent_integration(air, offset):
    rng = np.random.default_rng(6)
    for spin in (0.3, 40.0, 400.0):
        body, start = coin_and_start(rng, air=air, offset=offset, spin=spin)

        def rate(_, y, body=body):
            dy = np.empty(13)
            derivative(body, y, dy)
            return dy

        turned = 8.0
        duration = min(turned / spin, 0.5)
        sizes = np.repeat([1.0, 10.0, 1.0, spin + 30], [3, 3, 4, 3])
        # An absolute tolerance of each part's own size: rounding would meet no smaller one.
        settings = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14 * sizes}
        other = solve_ivp(rate, (0, duration), start, **settings).y[:, -1]
        assert np.abs((flown(body, start, duration) - other) / sizes).max() < 3e-12


def test_the_order_of_the_series_follows_the_length_of_the_step():
    body, start = coin_and_start(np.random.default_rng(7))
    orders = []
    for longest in (1e-5, 1e-3, 1e-2, 1.0):
        series = np.empty((ROWS, COLUMNS))
        length, order = expand_flight(body, start, longest, series)
        assert length <= longest
        assert (length == longest) == (order < ORDER)
        orders.append(order)
    assert orders == sorted(set(orders))
    assert orders[-1] == ORDER


@pytest.mark.slow
@pytest.mark.parametrize("thickness", [0.0, 2e-3])
def test_what_is_surely_clear_is_clear_and_a_touch_is_not(thickness):
    """Over times before the first touch, up to it, and over times beyond it."""
    rng, proved = np.random.default_rng(9), 0
    for _ in range(12):
        body, start = coin_and_start(rng, thickness=thickness)
        end = start.copy()
        touch, touches, *_ = fly_by_steps(body, end, 10.0, False)
        assert touches
        # The last step before the touch, from a time at which it is still to come.
        y = flown(body, start, touch - 5e-3)
        series, coefficients = np.empty((ROWS, COLUMNS)), np.empty((2, DEGREE + 1))
        length, order = expand_flight(body, y, 8e-3, series)
        polynomials = gap_polynomials(body, series, order, length, coefficients)
        assert polynomials.degree <= 2 * order
        assert 0 < polynomials.rounding < 1e-12 * evaluate_gap(body, state_of(y)).gap

        def clear(inside: float, window: float, body=body, polynomials=polynomials) -> float:
            return time_surely_clear(body, polynomials, 0.0, TimeWindow(inside, window, 0.0))

        assert clear(0.0, length) <= 5e-3 * (1 + 1e-11)
        proved += clear(0.0, length) > 5e-3 * (1 - 1e-9)
        assert clear(1e-3, 3e-3) == 3e-3
        assert clear(1e-3, 5e-3) <= 4e-3 * (1 + 1e-11)
        assert clear(5e-3, 1e-3) < 1e-4
    assert proved > 8


def test_a_coin_that_hardly_leaves_the_floor_is_searched_in_a_few_steps():
    """Its gap grows with the cube of time, and bounds on accelerations alone would need hundreds."""
    body, y = coin_and_start(np.random.default_rng(10), air={}, offset=(-1e-3, 0.0, 0.0))
    y[2] -= evaluate_gap(body, state_of(y)).gap
    lift = evaluate_gap(body, state_of(y)).speed
    # Let the lowest point rest, and the coin's weight hardly act: the turning lifts it.
    y[5] -= lift
    body = body._replace(gravity=1e-3)
    start, states = y.copy(), np.empty((100, 13))
    flight = fly_by_steps(body, y, 10.0, False)
    assert flight.touches
    assert flight.evaluations < 40
    sample_flight(body, start, 0.0, flight.time * np.linspace(0.01, 0.99, len(states)), states)
    assert min(evaluate_gap(body, state_of(state)).gap for state in states) > 0


@pytest.mark.slow
def test_minima_near_the_floor_are_seen_on_the_way_and_change_nothing():
    """Of coins that have just left the floor too, whose first minimum lies in a time that is proved clear."""
    rng, least = np.random.default_rng(3), []
    for number in range(200):
        body, start = coin_and_start(rng, spin=150.0)
        if number < 150:
            gap = evaluate_gap(body, state_of(start))
            start[2] -= gap.gap
            start[5] += rng.uniform(0.01, 0.5) - gap.speed
        with_graze, without = start.copy(), start.copy()
        flight = fly_by_steps(body, with_graze, 10.0, True)
        assert flight[:4] == fly_by_steps(body, without, 10.0, False)[:4]
        assert np.array_equal(with_graze, without)
        states = np.empty((1500, 13))
        sample_flight(body, start, 0.0, flight.time * np.linspace(1e-4, 1 - 1e-4, len(states)), states)
        gaps = np.array([evaluate_gap(body, state_of(state)).gap for state in states])
        inner = gaps[1:-1][(gaps[1:-1] < gaps[:-2]) & (gaps[1:-1] <= gaps[2:])]
        assert inner.min(initial=np.inf) >= min(flight.graze / 2, body.radius / 10)
        least += [flight.graze] if flight.graze < body.radius / 10 else []
    assert len(least) > 5
