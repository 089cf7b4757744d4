"""The horizon of trust: against 113-bit arithmetic, and where two neighbouring tosses part."""

from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.events import EventLog, run
from cointoss.analytic.horizon.horizon import (
    IMPULSE_ERROR,
    TIME_ERROR,
    TOUCH_COST,
    ErrorsMade,
    horizon_of,
)
from cointoss.analytic.toss import state_at_release
from cointoss.models.records import Impacts
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_LAWS, draw_coin, draw_release, scenario


def draw_toss(rng: np.random.Generator, number: int) -> Scenario:
    """Draw a toss; the six laws take turns."""
    return scenario(
        coin=draw_coin(rng),
        air=AIR if rng.integers(2) else {},
        floor={
            "contact": str(PAPER_LAWS[number % len(PAPER_LAWS)]),
            "friction": rng.uniform(0, 0.5),
            "restitution": rng.uniform(0.2, 0.95),
        },
        release=draw_release(rng),
        ending={"max_impacts": 30, "test": "paper"},
    )


def true_horizon(case: Scenario, impacts: Impacts) -> int:
    """Count the leading impacts that agree with 113-bit arithmetic in face, time and impulse."""
    pytest.importorskip("heyoka", reason="heyoka has wheels for Linux on x86-64 only")
    from tests.helpers.extended import Extended

    n = 0
    for i, touch in zip(range(len(impacts)), Extended(case).toss(), strict=False):
        strayed = float(np.linalg.norm(impacts.impulse[i] - touch.impulse))
        if (
            (impacts.face[i] == 1) != touch.heads
            or abs(impacts.time[i] - touch.time) > TIME_ERROR
            or strayed > IMPULSE_ERROR * float(np.linalg.norm(touch.impulse))
        ):
            break
        n += 1
    return n


@pytest.mark.parametrize("tosses", [12, pytest.param(200, marks=pytest.mark.slow)])
def test_no_trusted_impact_is_wrong_and_few_right_ones_are_left_out(tosses):
    """In the median the horizon is within two impacts of the true one."""
    rng = np.random.default_rng(1)
    left_out, trusted = [], []
    for number in range(tosses):
        case = draw_toss(rng, number)
        tossed = analytic.toss(case)
        true = true_horizon(case, tossed.impacts)
        assert tossed.trusted_impacts <= true
        left_out.append(true - tossed.trusted_impacts)
        trusted.append(tossed.trusted_impacts)
    assert np.median(left_out) <= 2
    assert np.median(trusted) >= 6


def difference(a: Any, b: Any) -> np.ndarray:
    """Give by how much the impacts of two tosses differ: the time [s], and 1 for another face."""
    n = min(len(a), len(b))
    return np.abs(a["time"][:n] - b["time"][:n]) + (a["face"][:n] != b["face"][:n])


def test_neither_of_two_neighbouring_tosses_trusts_the_impact_at_which_they_part():
    """A spin is bisected, to its last digit, towards a jump: a graze that becomes a touch, another face."""
    rng = np.random.default_rng(51)
    jumps, trusted_up_to_it = 0, 0
    for number in range(24):
        case = draw_toss(rng, number)
        body, rules, release = case.body, case.rules._replace(max_impacts=8), state_at_release(case.release)

        def tossed(spin: float, case: tuple[Any, ...] = (body, rules, release)) -> EventLog:
            start = case[2].copy()
            start[11] = spin
            return run(case[0], case[1], start)

        low, high = release[11], release[11] + 10
        while (middle := (low + high) / 2) not in (low, high):
            rows = tossed(middle).rows
            jumps_below = (
                difference(tossed(low).rows, rows).sum() >= difference(tossed(high).rows, rows).sum()
            )
            low, high = (low, middle) if jumps_below else (middle, high)
        a, b = tossed(low), tossed(high)
        apart = difference(a.rows, b.rows) > 1e-4
        if not apart.any():
            continue
        jumps += 1
        trusted = [horizon_of(body, rules, toss).impacts for toss in (a, b)]
        assert max(trusted) <= np.argmax(apart)
        trusted_up_to_it += max(trusted) == np.argmax(apart)
    assert jumps >= 10
    assert trusted_up_to_it >= 5


def test_larger_errors_shorten_the_horizon():
    case = draw_toss(np.random.default_rng(53), 4)
    toss = run(case.body, case.rules, state_at_release(case.release))
    trusted = [
        horizon_of(case.body, case.rules, toss, ErrorsMade(1e-15 * factor, 3e-15 * factor)).impacts
        for factor in (1, 1e2, 1e4, 1e8)
    ]
    assert trusted == sorted(trusted, reverse=True)
    assert trusted[0] > trusted[1] > trusted[2] > trusted[3] >= 0


def test_a_coin_kept_flat_by_symmetry_is_trusted_to_its_end():
    """Rounding keeps its zeros; tilted in the last digit the coin isn't trusted to land on one point."""
    for spin in (0.0, 30.0):
        flat = analytic.toss(scenario(release={"angular_velocity": [0, 0, spin]}))
        assert flat.trusted_impacts == len(flat.impacts) > 5
    thrown_down = analytic.toss(scenario(release={"position": [0, 0, 1e-3], "velocity": [0, 0, -1.0]}))
    assert thrown_down.impacts.time[0] == 0
    assert thrown_down.trusted_impacts == len(thrown_down.impacts) > 2
    tilted = analytic.toss(scenario(release={"angles": [0, 3e-14, 0]}))
    assert tilted.trusted_impacts == 0


def test_errors_are_carried_through_so_many_steps_and_no_impact_after_them_is_trusted():
    """A coin that hardly turns takes few between its touches."""
    case = scenario(release={"angular_velocity": [0, 0, 5.0]}, ending={"max_impacts": 8})
    log = run(case.body, case.rules, state_at_release(case.release))
    few = [ErrorsMade(most_carried=touches * 2 * TOUCH_COST) for touches in (0, 3, 100)]
    trusted = [horizon_of(case.body, case.rules, log, made).impacts for made in few]
    assert trusted[0] == 0
    assert 2 <= trusted[1] < 6
    assert trusted[2] == 8


def test_a_coin_that_falls_for_a_thousand_seconds_is_not_trusted_beyond_what_takes_seconds():
    """Its impacts spin it at 1e5 rad/s, and to carry errors through the next flight would take an hour."""
    release = {"position": [0, 0, 1e6], "quaternion": [0.9, 0.3, 0.3, 0.1], "angular_velocity": [3, 30, 5]}
    tossed = analytic.toss(scenario(floor={"restitution": 0.6}, release=release))
    assert 0 < tossed.trusted_impacts < len(tossed.impacts)


@pytest.mark.parametrize("lean", [3.55e-15, 9.8e-15, 1.14e-14, 5e-14])
def test_a_touch_so_near_to_upright_that_either_rim_may_land_is_not_trusted(lean):
    """Its lowest point is taken under C up to 1e-14 rad: another impulse by half."""
    coin = {"mass": 0.01, "radius": 0.0125, "thickness": 0.01}
    release = {"position": [0, 0, 0.05], "angles": [0, np.pi / 2 + lean, 0]}
    assert (
        analytic.toss(scenario(coin=coin, floor={"restitution": 0.5}, release=release)).trusted_impacts == 0
    )


def test_a_flat_coin_that_turns_and_does_not_fall_is_not_trusted():
    """The whole face touches at once, and the gap has no rate."""
    release = {"position": [0, 0, 1e-3], "angular_velocity": [5.0, 0, 0]}
    tossed = analytic.toss(scenario(release=release, ending={"max_impacts": 3}))
    assert len(tossed.impacts) > 0
    assert tossed.trusted_impacts == 0
