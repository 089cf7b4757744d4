"""Flights by power series: against an independent integration; and the proof that they are clear."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.gap_polynomials import gap_polynomials, time_surely_clear
from cointoss.analytic.flight.integrated_flight import sample_flight
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
    states = np.empty((1, 13))
    sample_flight(body, start, 0.0, np.array([duration]), states)
    return states[0]


@pytest.mark.parametrize("air", [{}, AIR, {"normal": 20.0, "tangential": 5.0}])
@pytest.mark.parametrize(
    ("thickness", "offset"), [(2e-3, (0.0, 0.0, 0.0)), (0.1, (0.0, 0.0, 0.0)), (2e-3, PAPER_OFFSET)]
)
def test_a_flight_by_power_series_is_that_of_an_independent_integration(air, thickness, offset):
    rng = np.random.default_rng(6)
    for spin in (0.3, 40.0, 400.0):
        body, start = coin_and_start(rng, thickness=thickness, air=air, offset=offset, spin=spin)

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
