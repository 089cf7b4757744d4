"""What both engines must do alike where the floor resists rolling and pivoting."""

from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.models.records import Ending, Outcome
from tests.helpers.corpus import states_of_hands
from tests.helpers.draws import AIR, THIN, ZLOTY, scenario
from tests.helpers.engines import toss, toss_many
from tests.helpers.states import energies

pytestmark = pytest.mark.usefixtures("without_horizon")

G, R = 9.81, ZLOTY["radius"]
THICK = {**ZLOTY, "thickness": 4e-3}
HOOP = {**THIN, "inertia": (np.diag([0.5, 0.5, 1.0]) * ZLOTY["mass"] * R * R).tolist()}
RESISTANCE = {"rolling_friction": 5e-4, "pivoting_friction": 1e-4}


def set_down(coin, speed, tilt=np.pi / 2, spin=0.0, **floor):
    """Give a coin that is set down at a tilt, and rolls along x without slip."""
    half = coin["thickness"] / 2
    return scenario(
        coin=coin,
        floor={"contact": "coulomb", "friction": 0.9, "restitution": 0.3, **floor},
        release={
            "position": [0.0, 0.0, R * np.sin(tilt) + half * abs(np.cos(tilt))],
            "velocity": [speed, 0.0, 0.0],
            "angles": [0.0, tilt, 0.0],
            "angular_velocity": [0.0, spin, -speed / R],
        },
    )


CASES = {
    "rolls to rest": (set_down(THIN, 0.3, rolling_friction=1e-3), Outcome.EDGE, Ending.AT_REST),
    "is caught on its edge": (set_down(THICK, 0.4, **RESISTANCE), Outcome.EDGE, Ending.PAPER),
    "is caught by its contour": (set_down(THICK, 0.4, contour_friction=5e-4), Outcome.EDGE, Ending.PAPER),
    "rolls in a circle and falls": (
        set_down(ZLOTY, 0.5, 1.35, **RESISTANCE),
        Outcome.HEADS,
        Ending.PAPER,
    ),
    "spins and falls": (
        set_down(ZLOTY, 0.0, 1.2, 35.0, **RESISTANCE),
        Outcome.HEADS,
        Ending.PAPER,
    ),
}
BOTH = [pytest.param(engine, name, id=f"{engine}-{name}") for engine in Engine for name in CASES]


@cache
def tossed(engine, name):
    return toss(engine, CASES[name][0])


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_a_coin_comes_to_rest_as_its_name_says(engine, name):
    found = tossed(engine, name)
    assert (found.outcome, found.ending) == CASES[name][1:]


@pytest.mark.parametrize("name", CASES)
def test_engines_agree_on_when_and_where(name):
    analytic, mujoco = (tossed(engine, name) for engine in (Engine.ANALYTIC, Engine.MUJOCO))
    # An end is noticed after a step, here of some 5 ms, and in a second MuJoCo's change 1e-3 of the energy.
    assert mujoco.end_time == pytest.approx(analytic.end_time, rel=2e-2, abs=5e-3)
    times = np.linspace(0, min(mujoco.end_time, analytic.end_time), 200)
    here, there = (energies(CASES[name][0], each.sample(times)) for each in (analytic, mujoco))
    # In a second MuJoCo's steps change up to 4e-3 of the energy, and a fast spin 1e-3 at once.
    assert there == pytest.approx(here, abs=6e-3 * here[0])
    path, other = (each.sample(times).position[:, :2] for each in (analytic, mujoco))
    assert np.linalg.norm(path[-1] - other[-1]) < 0.02 * np.linalg.norm(np.diff(path, axis=0), axis=1).sum()


@pytest.mark.parametrize(
    ("floor", "air", "power"),
    [
        ({"contour_friction": 1.6e-3 * R}, {}, 1.5),
        ({"contour_viscosity": 3.4e-4 * R * (R / G) ** 0.5}, {}, 2),
        ({}, {"viscosity": 8.5e-5 * ZLOTY["mass"] / R * (G / R) ** 0.5}, 3),
    ],
)
def test_engines_agree_on_how_a_disk_that_wobbles_stops(floor, air, power):
    """Its face is settled at once, and the path goes on: the tilts, until it lies."""
    tilt, disk = 0.3, set_down(THIN, 0.0, 0.3, **floor)
    case = disk.replace(
        *("air", {**disk.air.model_dump(), **air}, "ending.until", 2.2),
        *("release.angular_velocity", [0.0, 2 * (G / R * np.sin(tilt)) ** 0.5, 0.0]),
    )
    times = np.append(np.linspace(0, 1.65, 50), 2.1)
    here, there = (
        np.arcsin(np.hypot(*toss(engine, case).sample(times).normal[:, :2].T)) for engine in Engine
    )
    # What falls steadily is that power of the tilt; of the energy MuJoCo errs as above.
    assert (there / tilt) ** power == pytest.approx((here / tilt) ** power, abs=6e-3 * power)
    assert 0.04 < here[-2] < 0.2
    assert here[-1] < 1e-6


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_energy_falls(engine, name):
    found, case = tossed(engine, name), CASES[name][0]
    energy = energies(case, found.sample(np.linspace(0, found.end_time, 1001)))
    gain = np.max(energy - np.minimum.accumulate(energy)) / energy[0]
    # MuJoCo's steps in a contact change about 1e-3 of the energy in a second.
    assert gain < {Engine.ANALYTIC: 1e-9, Engine.MUJOCO: 2e-3}[engine]
    assert energy[-1] < 0.98 * energy[0]


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize("law", ["perfectly_rough", "coulomb"])
@pytest.mark.parametrize(("coin", "share"), [(THIN, 0.5), (HOOP, 1.0)])
def test_a_disc_and_a_hoop_that_roll_upright_come_to_rest_where_the_closed_form_says(
    engine, law, coin, share
):
    """(J_ζ + m r²) dω_ζ/dt = -δ m g: v falls by δ g/(r (1 + J_ζ/(m r²))) a second."""
    delta, speed = 1e-3, 0.3
    slowing = delta * G / (R * (1 + share))
    found = toss(engine, set_down(coin, speed, contact=law, rolling_friction=delta))
    assert (found.outcome, found.ending) == (Outcome.EDGE, Ending.AT_REST)
    # Rest is found at 1e-3 √(g/r).
    late = {Engine.ANALYTIC: 3e-3, Engine.MUJOCO: 2e-3}[engine]
    assert found.end_time == pytest.approx(speed / slowing, rel=late)
    end = found.sample(found.end_time)
    assert end.position[0, 0] == pytest.approx(speed**2 / (2 * slowing), rel=1e-4)
    times = np.linspace(0, 0.9 * found.end_time, 9)
    # Within a step of MuJoCo's path states are interpolated.
    assert found.sample(times).velocity[:, 0] == pytest.approx(speed - slowing * times, rel=2e-4)


@pytest.mark.parametrize("engine", list(Engine))
def test_a_disc_that_turns_upright_is_slowed_by_resistance_to_pivoting_alone(engine):
    """J_ξ dω_z/dt = -p m g."""
    p, spin = 1e-3, 80.0
    case = set_down(THIN, 0.0, spin=spin, pivoting_friction=p, rolling_friction=p)
    slowing = p * ZLOTY["mass"] * G / case.body.inertia[1][1]
    found = toss(engine, case)
    times, near = np.linspace(0, 0.95 * spin / slowing, 9), {Engine.ANALYTIC: 1e-6, Engine.MUJOCO: 1e-4}
    left = found.sample(times).angular_velocity[:, 1]
    assert left == pytest.approx(spin - slowing * times, rel=near[engine])
    assert found.end_time == pytest.approx(spin / slowing, rel=1e-3)
    kept = toss(engine, case.replace("floor.pivoting_friction", 0.0, "ending.max_time", 0.1))
    assert kept.sample(0.1).angular_velocity[0, 1] == pytest.approx(spin, rel=near[engine])


@pytest.mark.parametrize("engine", list(Engine))
def test_a_thick_coin_that_rolls_upright_is_caught_on_its_edge_at_the_height_of_the_pass(engine):
    """3/4 m v² there is the energy of the pass over either rim."""
    speed = 0.6
    caught = (G * (np.hypot(R, THICK["thickness"] / 2) - R) / 0.75) ** 0.5
    slowing = RESISTANCE["rolling_friction"] * G / (1.5 * R)
    found = toss(engine, set_down(THICK, speed, **RESISTANCE))
    assert (found.outcome, found.ending) == (Outcome.EDGE, Ending.PAPER)
    assert found.end_time == pytest.approx((speed - caught) / slowing, rel=0.02)


@pytest.mark.parametrize(("engine", "steps"), [(Engine.ANALYTIC, 3000), (Engine.MUJOCO, 200)])
def test_a_coin_that_still_rolls_upright_when_a_budget_ends_is_named_so(engine, steps):
    case = set_down(THICK, 0.6, rolling_friction=5e-5, pivoting_friction=1e-5)
    by_time = toss(engine, case.replace("ending.max_time", 0.3))
    by_steps = engine.package.toss(case, settings=replace(engine.package.FINE, contact_steps=steps))
    # After 64 √(r/g), or 2.3 s, a coin that nothing slows would stand.
    late = toss(engine, case.replace("ending.max_time", 4.0))
    for found in (by_time, by_steps, late):
        assert (found.outcome, found.ending) == (Outcome.EDGE, Ending.ROLLING)
        assert np.hypot(*found.sample(found.end_time).velocity[0, :2]) > 0.1
    assert by_time.end_time == pytest.approx(0.3)
    assert toss(engine, set_down(THICK, 0.6)).ending == Ending.STANDING


@pytest.mark.slow
def test_nickels_tossed_by_hand_come_to_rest_alike_on_both_engines():
    """Within four standard deviations of what 100 tosses leave, and none rolls or stands for ever."""
    n = 100
    case = scenario(
        coin={"mass": 5e-3, "radius": 10.605e-3, "thickness": 1.95e-3},
        air=AIR,
        floor={"contact": "coulomb", "friction": 0.3, "restitution": 0.5, "restitution_threshold": 0.02}
        | {"rolling_friction": 1e-3, "pivoting_friction": 1e-3},
    )
    starts = states_of_hands(np.random.default_rng(1993), n, aside=10.0)
    found = [toss_many(engine, case, starts) for engine in Engine]
    for outcomes in found:
        assert set(outcomes.ending) <= {Ending.PAPER, Ending.LYING, Ending.AT_REST}
        assert set(outcomes.outcome) <= {Outcome.HEADS, Outcome.TAILS, Outcome.EDGE}
    counts = [Counter(outcomes.outcome.tolist()) for outcomes in found]
    for outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE):
        assert abs(counts[0][outcome] - counts[1][outcome]) < 4 * (2 * n * 0.25) ** 0.5
    times = [np.mean(outcomes.end_time) for outcomes in found]
    assert times[0] == pytest.approx(times[1], rel=0.1)
    free = case.replace("floor.rolling_friction", 0.0, "floor.pivoting_friction", 0.0)
    ended = toss_many(Engine.ANALYTIC, free.replace("floor.restitution_threshold", 0.0), starts).ending
    assert Ending.STANDING in ended, "without resistance some roll on upright for ever"
