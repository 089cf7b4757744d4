"""MuJoCo's coin in flight: the order of its steps and where it lands."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from cointoss import analytic, coin_mj
from cointoss.coin_mj import MANY
from cointoss.coin_mj.model import state
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.steps import free_step as stepping
from cointoss.coin_mj.steps import gap_evaluation, touch_search
from cointoss.coin_mj.steps.flight import FlightExit, fly
from cointoss.coin_mj.steps.free_step import free_step_from, rates_of_step
from cointoss.coin_mj.steps.knots import nothing_recorded
from cointoss.coin_mj.steps.touch_search import arc_of
from cointoss.models.batch import rows_of
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.reading import load
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_release, scenario

motion_of, set_motion, state_of = (
    by_numba(state.motion_of),
    by_numba(state.set_motion),
    by_numba(state.state_of),
)
free_step, free_rate = by_numba(stepping.free_step), by_numba(stepping.free_rate)
nudge = by_numba(stepping.nudge)
evaluate_gap = by_numba(gap_evaluation.evaluate_gap)
first_touch = by_numba(touch_search.first_touch)

pytestmark = pytest.mark.usefixtures("without_horizon")

BALANCED = ZLOTY


def flying(coin, seed=0, height=0.0, **settings):
    release = draw_release(np.random.default_rng(seed))
    release["position"][2] += height
    case = scenario(coin=coin, air=AIR, release=release, ending={"max_impacts": 1})
    return case, machine_of(case, replace(MANY, **settings))


@by_numba
def fly_alone(coin, rules):
    return fly(coin, rules, 0.0, 1000, nothing_recorded(False))[:3]


def flight(case, machine, longest):
    return fly_alone(machine.coin, case.rules._replace(max_time=longest))


@by_numba
def step_arc(coin, start, duration):
    """Return the arc of a step of free flight from a state."""
    rates, end_rate = rates_of_step(), np.empty(13)
    set_motion(coin, start)
    free_rate(coin, rates[0], False)
    free_step_from(coin, start, rates, duration)
    free_rate(coin, end_rate, False)
    return arc_of(start, rates[0], motion_of(coin), end_rate, duration)


def gap_after(coin, start, duration):
    set_motion(coin, start)
    free_step(coin, duration)
    return evaluate_gap(coin).gap


@pytest.mark.parametrize("thickness", [0.0, 2e-3, 4e-2], ids=["thin", "thick", "rod"])
def test_a_symmetric_top_without_air_turns_exactly_in_a_step_of_any_length(thickness):
    case = scenario(coin={**ZLOTY, "thickness": thickness}, release=draw_release(np.random.default_rng(4)))
    case = case.replace("release.position", [0.0, 0.0, 5.0])
    turn = 3 / math.hypot(*case.release.angular_velocity)
    machine = machine_of(case, MANY)
    free_step(machine.coin, turn)
    x, v, e, w = map(np.array, state_of(machine.coin)[:4])
    exact = analytic.toss(case).sample([turn])
    # MuJoCo's inertia is wider by `INERTIA_WIDENED`.
    assert e * np.sign(e @ exact.quaternion[0]) == pytest.approx(exact.quaternion[0], abs=1e-10)
    assert w == pytest.approx(exact.angular_velocity[0], abs=1e-9)
    assert x == pytest.approx(exact.position[0], abs=1e-14)
    assert v == pytest.approx(exact.velocity[0], abs=1e-13)


@pytest.mark.parametrize(
    ("coin", "median", "worst"),
    # Of steps of 0.5 rad in a frame at rest, by the same method over the same flights: place of the rim in
    # radii, and ω in rad/s.
    [(BALANCED, (3.6e-7, 2.8e-6), (2.8e-6, 4.3e-5)), (IMPERFECT, (1.2e-6, 3.0e-6), (5.3e-6, 4.4e-5))],
    ids=["balanced", "imperfect"],
)
def test_the_turning_frame_makes_up_for_longer_steps(coin, median, worst):
    errors = []
    for seed in range(30):
        case, machine = flying(coin, seed, height=5.0)
        turn = 4 / math.hypot(*case.release.angular_velocity)
        steps = math.ceil(4 / machine.coin.flight_angle)
        for _ in range(steps):
            free_step(machine.coin, turn / steps)
        exact = analytic.toss(case).sample([turn])
        x, _, e, w = map(np.array, state_of(machine.coin)[:4])
        e *= np.sign(e @ exact.quaternion[0])
        place = np.abs(x - exact.position[0]).max() / ZLOTY["radius"]
        turned = 2 * np.abs(e - exact.quaternion[0]).max()
        errors.append((place + turned, np.abs(w - exact.angular_velocity[0]).max()))
    assert np.all(np.median(errors, axis=0) < median)
    assert np.all(np.max(errors, axis=0) < worst)


@pytest.mark.parametrize("coin", [BALANCED, IMPERFECT], ids=["balanced", "imperfect"])
def test_a_nudge_is_a_short_step(coin):
    case, machine = flying(coin, seed=3)
    start, dt = motion_of(machine.coin), 1e-6 / math.hypot(*case.release.angular_velocity)
    for way in (dt, -dt):
        set_motion(machine.coin, start)
        free_step(machine.coin, way)
        exact = np.array(motion_of(machine.coin))
        set_motion(machine.coin, start)
        free_rate(machine.coin, np.empty(13), False)
        nudge(machine.coin, way)
        assert np.abs(exact - start).max() > 1e-8, "it should move"
        assert np.array(motion_of(machine.coin)) == pytest.approx(exact, rel=1e-12, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("coin", [BALANCED, IMPERFECT], ids=["balanced", "imperfect"])
def test_the_first_touch_in_a_step_is_that_of_bisection(coin):
    rng, touched = np.random.default_rng(2), 0
    machine = flying(coin)[1]
    for _ in range(20):
        # Its edges come down and rise again: the gap has up to three zeros in a step.
        e, w = rng.normal(size=4), rng.normal(size=3)
        duration = 0.75 / 60
        start = (0.0, 0.0, rng.uniform(0.0126, 0.02), *(e / np.linalg.norm(e)), 0.0, 0.0)
        start += (rng.uniform(-1.5, 0.3), *(60 * w / np.linalg.norm(w)))
        found = first_touch(machine.coin, step_arc(machine.coin, start, duration), 1e-9)
        times = np.linspace(0, duration, 400)
        below = [gap_after(machine.coin, start, time) < 0 for time in times]
        if not any(below):
            assert found == np.inf
            continue
        touched += 1
        first = int(np.argmax(below))
        exact = brentq(lambda time, y=start: gap_after(machine.coin, y, time), times[first - 1], times[first])
        # The error of the quintics over 0.75 rad; measured: 5e-5 over 300 draws.
        assert found == pytest.approx(exact, abs=1e-4 * duration)
    assert 5 < touched < 19


@pytest.mark.slow
def test_no_touch_is_found_where_a_step_ends():
    """A coin of Fig. 24(a) that has just been released, and moves down again at the end of the step."""
    case = load("fig24a")
    machine = machine_of(case, MANY)
    start = (-0.237, 0.421, 3.1657158e-3, 0.98839466, 0.070338652, -0.052213038, -0.124105907)
    start += (-0.126, 0.226, 0.605490072, -29.154056082, 36.380102787, 17.126660991)
    for duration in np.linspace(0.0151, 0.0153, 60):
        assert first_touch(machine.coin, step_arc(machine.coin, start, duration), 1e-10) == np.inf
        assert gap_after(machine.coin, start, duration) > 1e-3
    assert evaluate_gap(machine.coin).speed < 0


@pytest.mark.slow
def test_a_coin_that_rocks_below_the_floor_touches_as_its_other_rim_comes_down():
    case, machine = flying({**ZLOTY, "thickness": 8e-3})
    # Its mass centre is over the lower rim, which rises.
    half = (np.pi / 2 + 1e-7) / 2
    upright = (0.0, 0.0, 0.0125 - 1e-9, np.cos(half), np.sin(half), 0.0, 0.0, 0.0, 0.0, 0.0)
    for spin in (1.0, -1.0):
        set_motion(machine.coin, (*upright, spin, 0.0, 0.0))
        before = evaluate_gap(machine.coin)
        assert before.gap < 0
        time, way, steps_left = flight(case, machine, 1.0)
        assert way == FlightExit.TOUCHES
        assert steps_left >= 998
        assert (time > 0) == (before.speed > 0)
        assert -1e-8 < evaluate_gap(machine.coin).gap < 0
        assert evaluate_gap(machine.coin).speed < 0


def test_a_toss_flies_no_more_steps_than_its_budget():
    case, _ = flying(BALANCED, height=1.0)
    settings = replace(MANY, flight_steps=7)
    one = coin_mj.toss(case, settings=settings)
    assert (one.outcome, one.ending) == (Outcome.UNDECIDED, Ending.FLIGHT_STEPS)
    many = coin_mj.toss_rows(rows_of(case, 1), settings=settings)
    assert (many.ending[0], many.end_time[0]) == (Ending.FLIGHT_STEPS, one.end_time)
    whole = coin_mj.toss(case, settings=MANY)
    assert whole.ending == Ending.MAX_IMPACTS
    assert one.end_time < whole.end_time
