"""The horizon of trust: against 113-bit arithmetic, and where two neighbouring tosses part."""

from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.horizon.horizon import (
    CLOSED_FORM,
    IMPULSE_ERROR,
    SAFETY,
    TIME_ERROR,
    TOUCH_COST,
    ErrorsMade,
)
from cointoss.analytic.runs import EventLog, horizon_of, run
from cointoss.analytic.toss import state_at_release
from cointoss.models.fields import UNITS, put
from cointoss.models.reading import load
from cointoss.models.records import Impacts
from cointoss.models.rows import fields_of
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_LAWS, THIN, draw_coin, draw_release, scenario


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
            or abs(impacts.time[i] - touch.time) > TIME_ERROR * (case.coin.radius / case.gravity) ** 0.5
            or strayed > IMPULSE_ERROR * float(np.linalg.norm(touch.impulse))
        ):
            break
        n += 1
    return n


@pytest.mark.parametrize(
    "tosses", [pytest.param(12, marks=pytest.mark.slow), pytest.param(200, marks=pytest.mark.long)]
)
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


def in_units(case: Scenario, length: float, time: float, mass: float) -> Scenario:
    """Return a scenario whose numbers are in units so many times smaller."""
    data, units = (
        case.model_dump(),
        {"m": length, "s": time, "kg": mass, "rad": 1.0, "Pa": mass / length / time**2},
    )
    for field, value in fields_of(case).items():
        if unit := UNITS.get(field):
            put(data, field, value * eval(unit, {}, units))
    return Scenario.checked(data)


@pytest.mark.parametrize("name", ["fig24c", "fig24e", "fig13", "contact_knurled", "contact_sliding_friction"])
def test_as_many_impacts_are_trusted_in_every_unit(name):
    """1e-7 s, as the time was once known to, is another part of a toss in another unit."""
    case = load(name)
    scales = [
        (1.0, 1.0, 1.0),
        (2.3, 1.0, 1.0),
        (1.0, 0.3, 1.0),
        (1.0, 3.7, 1.0),
        (1.0, 1.0, 41.0),
        (0.02, 0.1, 3.0),
    ]
    trusted = {analytic.toss(in_units(case, *scale)).trusted_impacts for scale in scales}
    assert len(trusted) == 1
    assert trusted.pop() > 2


THICK = {"mass": 0.01, "radius": 0.0125, "thickness": 0.01}
TRUSTED = {
    # Rounding keeps its zeros.
    **{
        f"flat, turns at {spin} rad/s": ({"release": {"angular_velocity": [0, 0, spin]}}, "all")
        for spin in (0.0, 30.0)
    },
    "flat, thrown down from the floor": (
        {"release": {"position": [0, 0, 1e-3], "velocity": [0, 0, -1.0]}},
        "all",
    ),
    "flat but for the last digit": ({"release": {"angles": [0, 3e-14, 0]}}, "none"),
    # The whole face touches at once, and the gap has no rate.
    "flat, turns about a diameter": (
        {
            "release": {"position": [0, 0, 1e-3], "angular_velocity": [5.0, 0, 0]},
            "ending": {"max_impacts": 3},
        },
        "none",
    ),
    # Its lowest point is taken under C up to 1e-14 rad: another impulse by half.
    **{
        f"upright but for {lean} rad": (
            {
                "coin": THICK,
                "floor": {"restitution": 0.5},
                "release": {"position": [0, 0, 0.05], "angles": [0, np.pi / 2 + lean, 0]},
            },
            "none",
        )
        for lean in (3.55e-15, 9.8e-15, 1.14e-14, 5e-14)
    },
    # Its impacts spin it at 1e5 rad/s, and to carry errors through the next flight would take an hour.
    "falls for a thousand seconds": (
        {
            "floor": {"restitution": 0.6},
            "release": {
                "position": [0, 0, 1e6],
                "quaternion": [0.9, 0.3, 0.3, 0.1],
                "angular_velocity": [3, 30, 5],
            },
        },
        "some",
    ),
}
"""Tosses, and which of their impacts are trusted."""


@pytest.mark.parametrize("name", TRUSTED)
def test_no_impact_is_trusted_that_rounding_decides_or_that_takes_an_hour(name):
    parts, trusted = TRUSTED[name]
    tossed = analytic.toss(scenario(**parts))
    assert len(tossed.impacts) > 0
    assert {0: "none", len(tossed.impacts): "all"}.get(tossed.trusted_impacts, "some") == trusted


FLAT = scenario(release={"angular_velocity": [0, 0, 5.0]}, ending={"max_impacts": 8})
"""It hardly turns, and takes few steps between its touches."""
NO_BODY = scenario(
    coin={**THIN, "inertia": [[1e-6, 0, 0], [0, 1e-6, 0], [0, 0, 1e-8]]},
    release={"angular_velocity": [10.0, 20.0, 0]},
    ending={"max_impacts": 1},
)
"""Its spin about the axis could be J_ξ/J_ζ times as fast as the coin turns: such steps are as short."""


@pytest.mark.parametrize(
    ("case", "cost", "trusted"),
    [
        (FLAT, 0, {0}),
        (FLAT, 6 * TOUCH_COST, {2, 3, 4, 5}),
        (FLAT, 200 * TOUCH_COST, {8}),
        (NO_BODY, 1e3, {0}),
        (NO_BODY, 1e5, {1}),
    ],
)
def test_errors_are_carried_as_far_as_their_cost_goes_and_no_impact_after_is_trusted(case, cost, trusted):
    made = ErrorsMade(most_carried=cost)
    assert horizon_of(case.body, case.rules, logged(case), made).impacts in trusted


CLOSED = SAFETY * CLOSED_FORM
"""Standard deviations that are carried, of the errors of a flight in closed form."""


def trusted_by(toss: EventLog, case: Scenario, **made: float) -> list[int]:
    """Return how many impacts are trusted with errors 2 % smaller than those made, and 2 % larger."""
    none = {"step": 0.0, "turn": 0.0}
    errors = [ErrorsMade(**none | {name: part * made[name] for name in made}) for part in (0.98, 1.02)]
    return [horizon_of(case.body, case.rules, toss, each).impacts for each in errors]


def logged(case: Scenario) -> EventLog:
    return run(case.body, case.rules, state_at_release(case.release))


def test_an_impact_is_trusted_whose_flight_keeps_clear_of_half_its_least_minimum():
    """A coin falls flat: the errors of its height are that of the start, of the speed there, and of the end.

    No minimum is below half of what the flight has noted; the errors may sink the coin so far.
    """
    case = scenario(coin=THIN, release={"position": [0, 0, 0.4]}, ending={"max_impacts": 1})
    toss, r, error = logged(case), case.body.radius, 1e-12
    falling = (2 * 0.4 / 9.81) ** 0.5 * (9.81 * r) ** 0.5
    sinking = CLOSED * error * (0.4**2 + falling**2 + r**2) ** 0.5
    started = toss.started._replace(grazes=np.full(len(toss.started.grazes), 2 * sinking))
    assert trusted_by(toss, case, step=error) == [1, 1]
    assert trusted_by(toss._replace(started=started), case, step=error) == [1, 0]


def test_the_tilt_at_a_trusted_touch_is_known_to_a_thousandth():
    """The upward vector errs twice as far as the Euler parameters, at the start and the end of the fall."""
    tilt = 1e-6
    release = {"position": [0, 0, 0.4], "angles": [0, tilt, 0]}
    case = scenario(coin=THIN, release=release, ending={"max_impacts": 1})
    assert trusted_by(logged(case), case, turn=1e-3 * tilt / (2 * 2**0.5 * CLOSED)) == [1, 0]


def test_the_speed_of_a_trusted_touch_is_known_to_a_thousandth():
    """A coin that flies past the floor touches it slowly: its speeds err in proportion to the largest."""
    past, down, lean = 1000.0, 1e-3, 1.0
    release = {
        "position": [0, 0, THIN["radius"] * np.sin(lean) + 1e-9],
        "velocity": [past, 0, -down],
        "angles": [0, lean, 0],
    }
    floor = {"contact": "perfectly_rough", "restitution": 0.999}
    case = scenario(coin=THIN, floor=floor, release=release, ending={"max_impacts": 1})
    toss = logged(case)
    speed = -toss.rows[0]["contact_velocity_before"][2]
    assert speed == pytest.approx(down, rel=0.02)
    assert trusted_by(toss, case, step=1e-3 * speed / (2**0.5 * CLOSED * past)) == [1, 0]


def test_the_flight_to_a_trusted_touch_is_known_to_a_thousandth_or_their_order_might_change():
    """An upright coin that leans lands on one rim and then on the other: the time between goes as its lean.

    Its errors go as those of the lean, by a factor between 1/4 and 4.
    """
    lean = 1e-5
    release = {"position": [0, 0, 0.05], "angles": [0, np.pi / 2 - lean, 0]}
    case = scenario(coin=THICK, floor={"restitution": 0.5}, release=release, ending={"max_impacts": 2})
    toss = logged(case)
    assert np.diff(toss.rows["time"]) < 0.1 * lean
    assert toss.rows["face"].tolist() == [1, 2]
    for part, trusted in ((4e-3, 1), (0.25e-3, 2)):
        assert trusted_by(toss, case, turn=part * lean / CLOSED) == [trusted, trusted]


def test_the_errors_after_a_touch_are_those_of_the_closed_form_of_a_fall():
    """All tosses touch at one height, earlier or later, and come as fast as their height at the start says.

    The speed of the start delays the touch, and gives none of its own: v² = v_0² + 2 g z, v_0 being 0.
    """
    z, chi, error, g = 0.4, 0.7, 1e-9, 9.81
    case = scenario(
        coin=THIN, floor={"restitution": chi}, release={"position": [0, 0, z]}, ending={"max_impacts": 1}
    )
    horizon = horizon_of(case.body, case.rules, logged(case), ErrorsMade(error, 0.0))
    assert horizon.impacts == 1
    made, r, v = CLOSED_FORM * error, case.body.radius, (2 * g * z) ** 0.5
    of_z, of_v, of_z_at_end, of_v_at_end = made * np.array([z, (g * r) ** 0.5, r, (g * r) ** 0.5 + v])
    covariance = horizon.errors.T @ horizon.errors
    of_height, of_speed, of_time = np.sqrt(np.diag(covariance))[[0, 3, 11]]
    assert of_height < 1e-5 * of_z  # what rounds the time at which the touch is found
    of_both = of_z**2 + of_z_at_end**2
    found = [of_speed, of_time, covariance[3, 11]]
    # What comes from higher comes later, and faster.
    expected = [
        chi * np.sqrt((g / v) ** 2 * of_both + of_v_at_end**2),
        np.sqrt(of_both + (of_v * v / g) ** 2) / v,
        chi * g * of_both / v**2,
    ]
    assert found == pytest.approx(expected, rel=1e-6, abs=0)
