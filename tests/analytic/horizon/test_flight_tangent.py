"""The tangent map of a toss: against differences of the engine itself, and what is known of it."""

import numpy as np
import pytest

from cointoss.analytic.flight.flying import sample
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.horizon.flight_tangent import COARSE, FINE, flight_tangent
from cointoss.analytic.runs import event_tangent, run
from cointoss.analytic.toss import state_at_release
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.laws import ContactLaw
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_release, scenario

flight_tangent = by_numba(flight_tangent)
sample = by_numba(sample)

SIZES = np.array([1e-2, 1e-2, 1e-2, *[1.0] * 7, *[50.0] * 3])
"""Of the components of a state: length, speed, attitude, spin."""
THICKNESSES_AND_OFFSETS = [
    (0.0, [0.0, 0.0, 0.0]),
    (2e-3, [0.0, 0.0, 0.0]),
    (0.0, [*PAPER_OFFSET[:2], 0.0]),
    (2e-3, PAPER_OFFSET),
]


def flown(case: Scenario, start: np.ndarray, duration: float) -> np.ndarray:
    """Give the state at the end of a flight."""
    states = np.empty((1, 13))
    sample(case.body, start, 0.0, np.array([duration]), states)
    return states[0]


def tangent_of(case: Scenario, start: np.ndarray, duration: float, accuracy: float = FINE) -> np.ndarray:
    """Give the tangent map of a flight."""
    changes, end = np.eye(13), flown(case, start, duration)
    flight_tangent(case.body, state_of(start), state_of(end), duration, accuracy, changes)
    return changes.T


def directions(start: np.ndarray) -> np.ndarray:
    """Give one change of a state in each row, which keep the quaternion's norm, (12, 13)."""
    rows = np.delete(np.diag(SIZES), 9, axis=0)
    e = start[6:10]
    a, b, c, d = e
    rows[6:9, 6:10] = [[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]]
    return rows


def strayed(case: Scenario, start: np.ndarray, duration: float, accuracy: float) -> list[float]:
    """Give how far the tangent map is off central differences of the flight, of each change's growth."""
    tangent, small, off = tangent_of(case, start, duration, accuracy), 1e-5, []
    for change in directions(start):
        ends = [flown(case, start + sign * small * change, duration) for sign in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * small) / SIZES
        off.append(np.abs((tangent @ change) / SIZES - difference).max() / np.abs(difference).max())
    return off


@pytest.mark.parametrize(("thickness", "offset"), THICKNESSES_AND_OFFSETS)
@pytest.mark.parametrize("air", [{}, AIR])
@pytest.mark.parametrize("slope", [0.0, 0.4])
def test_a_flight_s_tangent_map_is_its_derivative(thickness, offset, air, slope):
    """To what the differences err by, or as coarsely as the horizon wants it, or nearly so."""
    coin = {**ZLOTY, "thickness": thickness, "center_of_mass": offset}
    floor = {"contact": "smooth", "slope": slope}
    case = scenario(coin=coin, air=air, floor=floor, release=draw_release(np.random.default_rng(41)))
    start = state_at_release(case.release)
    assert max(strayed(case, start, 0.2, FINE)) < 1e-6
    assert max(strayed(case, start, 0.2, COARSE)) < 3 * COARSE


def test_the_steps_of_the_tangent_map_are_of_the_fourth_order():
    case = scenario(
        coin={**ZLOTY, "center_of_mass": PAPER_OFFSET},
        air=AIR,
        release=draw_release(np.random.default_rng(4)),
    )
    start = state_at_release(case.release)
    exact = tangent_of(case, start, 0.2)
    errors = [
        np.abs((tangent_of(case, start, 0.2, accuracy) - exact) / SIZES[:, None]).max()
        for accuracy in (1.6e-2, 1e-3)
    ]
    assert 11 < errors[0] / errors[1] < 22


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [0.5, 1.0])
def test_where_air_takes_quadratures_the_growth_is_known_as_well(exponent):
    coin = {**ZLOTY, "center_of_mass": PAPER_OFFSET}
    air = {"normal": 2.0, "tangential": 0.5, "exponent": exponent}
    case = scenario(coin=coin, air=air, release=draw_release(np.random.default_rng(41)))
    start = state_at_release(case.release)
    assert max(strayed(case, start, 0.05, FINE)) < 1e-4
    assert max(strayed(case, start, 0.05, COARSE)) < 3 * COARSE


@pytest.mark.parametrize("air", [{}, AIR])
def test_a_flight_shrinks_volumes_as_the_air_s_drag_says(air):
    """Liouville: without air volumes of states are kept; with b = 0 they shrink by the drag's trace."""
    rng = np.random.default_rng(42)
    case = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}, air={**air}, release=draw_release(rng))
    body, start, duration = case.body, state_at_release(case.release), 0.2
    end, tangent = flown(case, start, duration), tangent_of(case, start, duration)
    before, after = directions(start), directions(end)
    # On the sphere of quaternions both ends have an orthonormal base of three.
    volumes = np.linalg.lstsq(after.T, tangent @ before.T, rcond=None)[0]
    drag, c = body.drag, np.array(body.center)
    force = np.diag([drag.force_tangential, drag.force_tangential, drag.force_normal])
    moment = np.diag([drag.moment_tangential, drag.moment_tangential, drag.moment_normal])
    arm = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
    turning = np.linalg.solve(np.array(body.inertia), moment + arm.T @ force @ arm)
    trace = np.trace(force) / body.mass + np.trace(turning)
    assert (trace > 0) == bool(air)
    assert np.linalg.det(volumes) == pytest.approx(np.exp(-trace * duration), rel=1e-9)


@pytest.mark.parametrize(("thickness", "offset"), THICKNESSES_AND_OFFSETS)
def test_without_losses_the_tangent_map_keeps_every_change_of_energy(thickness, offset):
    """Smooth floor, χ = 1, vacuum: E is the same after each impact, for the changed toss too."""
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        floor={"restitution": 1.0},
        release=draw_release(np.random.default_rng(44)),
        ending={"max_impacts": 5},
    )
    body, rules = case.body, case.rules
    toss = run(body, rules, state_at_release(case.release))

    def energy_change(y: np.ndarray) -> np.ndarray:
        J = np.array(body.inertia)
        weight, motion = [0, 0, body.mass * body.gravity], body.mass * y[3:6]
        return np.array([*weight, *motion, *[0.0] * 4, *(J @ y[10:13]), 0.0])

    assert len(toss.rows) == 5
    for i in range(5):
        before, after = (energy_change(y) for y in toss.started.states[i : i + 2])
        tangent = event_tangent(body, rules, toss, i)
        sizes = np.append(SIZES, 1)
        scale = float(np.abs(before * sizes).max())
        for change in directions(toss.started.states[i]):
            kept = after @ tangent @ np.append(change, 0)
            # Central differences over 1e-5 of the scales err by some 1e-10, times what an impact makes of it.
            assert kept == pytest.approx(before[:13] @ change, abs=1e-7 * scale)


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("number", range(4))
def test_the_tangent_map_of_impacts_is_their_derivative(law, number):
    """From release to after the third impact: the state there and its time, against central differences."""
    rng = np.random.default_rng([43, int(law), number])
    thickness, offset = THICKNESSES_AND_OFFSETS[number]
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        air=AIR if number % 2 else {},
        floor={"contact": str(law), "friction": 0.2, "restitution": 0.7},
        release=draw_release(rng),
        ending={"max_impacts": 3, "test": "paper"},
    )
    body, rules, start = case.body, case.rules, state_at_release(case.release)
    toss = run(body, rules, start)
    assert len(toss.rows) == 3
    tangent = np.eye(14)
    for i in range(3):
        tangent = event_tangent(body, rules, toss, i) @ tangent

    def event(change: np.ndarray) -> np.ndarray:
        moved = run(body, rules, start + change)
        assert np.array_equal(moved.rows["face"], toss.rows["face"])
        return np.append(moved.started.states[3], moved.started.times[3])

    for change in directions(start):
        expected = (tangent @ np.append(change, 0)) / np.append(SIZES, 1)
        grown = np.abs(expected).max()
        errors = []
        for at_end in (1e-5, 1e-6, 1e-7):
            size = at_end / grown
            difference = (event(size * change) - event(-size * change)) / (2 * size) / np.append(SIZES, 1)
            errors.append(np.abs(difference - expected).max() / grown)
        # Large differences suffer from curvature, small ones from rounding.
        assert min(errors) < 2e-4
