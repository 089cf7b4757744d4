"""What both engines must do alike: each toss of one table keeps what it must, and agrees with the other's."""

from collections import Counter
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation
from cointoss.compare.engines import Engine
from cointoss.compare.metrics.trajectories import attitude_angle, distance
from cointoss.models import certificate
from cointoss.models.attitude import rotation_matrix
from cointoss.models.certificate import law_residuals
from cointoss.models.drag import linear_drag
from cointoss.models.reading import load
from cointoss.models.records import ApproximationWarning, Ending, Outcome
from cointoss.models.restitution import restitution_at_speed
from cointoss.models.scenario import Scenario
from tests.helpers.corpus import states_of_hands
from tests.helpers.draws import (
    AIR,
    IMPERFECT,
    PAPER_OFFSET,
    THIN,
    ZLOTY,
    draw_coin,
    draw_release,
    on_floor,
    scenario,
)
from tests.helpers.engines import toss, toss_many
from tests.helpers.states import energies
from tests.helpers.symmetries import SYMMETRIES

pytestmark = pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning")
WITHOUT = pytest.mark.usefixtures("without_horizon")
ENGINES = pytest.mark.parametrize("engine", list(Engine))

G, M, R, H = 9.81, ZLOTY["mass"], ZLOTY["radius"], ZLOTY["thickness"]
LEAN = 1.1
RESISTANCE = {"rolling_friction": 5e-4, "pivoting_friction": 1e-4}
TUMBLING: dict[str, Any] = {
    "position": [0.0, 0.0, 0.3],
    "velocity": [0.1, -0.2, 0.3],
    "angles": [0.4, 0.6, 0.1],
    "angular_velocity": [20.0, 35.0, -10.0],
}
LOW = {
    "position": [0.0, 0.0, 0.05],
    "velocity": [0.1, -0.2, 0.0],
    "quaternion": list(scenario(release={"angles": [0.4, 0.6, 0.1]}).release.attitude),
    "angular_velocity": [5.0, 10.0, -3.0],
}
NEARLY_UPRIGHT = {
    "position": [0.0, 0.0, 1.35e-2],
    "velocity": [0.0, 0.0, 0.0],
    "quaternion": list(scenario(release={"angles": [0, np.pi / 2 - 0.03, 0.3]}).release.attitude),
    "angular_velocity": [15 * np.sin(0.3), 15 * np.cos(0.3), 0.0],
}
ROLLING = {
    "position": [0, 0, R * np.sin(LEAN) + H / 2 * np.cos(LEAN)],
    "angles": [0, LEAN, 0],
    "angular_velocity": [0, 40.0, 3.0],
}
UPRIGHT = {"position": [0, 0, 0.0145], "angles": [0.0, 1.57, 4.7], "angular_velocity": [-2.0, 2.0, -50.0]}
SETTLED = (Ending.SETTLED, Ending.PAPER, Ending.LYING, Ending.STANDING)


class Kept(NamedTuple):
    """A toss that ends on the floor, and what is known of it."""

    case: Scenario
    outcome: Outcome | None = None
    """None where it depends on errors that impacts amplify."""
    endings: tuple[Ending, ...] = SETTLED
    slip: tuple[float, float] = (0.0, 99.0)
    """Between which the median of the slip in its longest contact lies [m/s]."""
    presses: bool = False
    """Whether its floor's force is compared."""


def lands(coin, law, release, floor=None, **known) -> Kept:
    """Return a toss in air on a floor of χ 0.5 and μ 0.3, or others."""
    floor = {"restitution": 0.5, "contact": law, "friction": 0.3} | (floor or {})
    return Kept(scenario(coin=coin, floor=floor, air=AIR, release=release), **known)


def set_down(coin, speed, tilt=np.pi / 2, spin=0.0, **floor) -> Scenario:
    """Return a coin that is set down at a tilt, and rolls along x without slip."""
    height = R * np.sin(tilt) + coin["thickness"] / 2 * abs(np.cos(tilt))
    motion = {"velocity": [speed, 0.0, 0.0], "angles": [0.0, tilt, 0.0]}
    motion |= {"position": [0.0, 0.0, height], "angular_velocity": [0.0, spin, -speed / R]}
    floor = {"contact": "coulomb", "friction": 0.9, "restitution": 0.3, **floor}
    return scenario(coin=coin, floor=floor, release=motion)


THICK, PAPER = {**ZLOTY, "thickness": 4e-3}, (Ending.PAPER,)
LOSSY = {"restitution": 0.3}
TOSSES = {
    "slides on a smooth floor": lands(IMPERFECT, "smooth", LOW, slip=(0.22, 0.25)),
    "slides on a rough floor": lands(IMPERFECT, "coulomb", LOW, slip=(0.025, 0.045)),
    "sticks after sliding": lands(ZLOTY, "coulomb", LOW, slip=(0.0, 0.003)),
    "rolls on a perfectly rough floor": lands(IMPERFECT, "perfectly_rough", LOW, slip=(0.0, 0.003)),
    "upright on a smooth floor": lands(ZLOTY, "smooth", NEARLY_UPRIGHT, outcome=Outcome.EDGE),
    "upright on a rough floor": lands(ZLOTY, "coulomb", NEARLY_UPRIGHT, outcome=Outcome.EDGE),
    "slips about in air": lands(ZLOTY, "smooth", ROLLING, LOSSY, presses=True),
    "slides in air": lands(
        ZLOTY,
        "coulomb",
        {**ROLLING, "velocity": [1.0, 0.3, 0.0]},
        {"friction": 0.1, **LOSSY},
        presses=True,
    ),
    "sticks in air": lands(ZLOTY, "coulomb", ROLLING, {"friction": 0.9, **LOSSY}, presses=True),
    "upright in air": lands(IMPERFECT, "smooth", UPRIGHT, LOSSY, presses=True),
    "rolls to rest": Kept(set_down(THIN, 0.3, rolling_friction=1e-3), Outcome.EDGE, (Ending.AT_REST,)),
    "is caught on its edge": Kept(set_down(THICK, 0.4, **RESISTANCE), Outcome.EDGE, PAPER),
    "is caught by its contour": Kept(set_down(THICK, 0.4, contour_friction=5e-4), Outcome.EDGE, PAPER),
    "rolls in a circle and falls": Kept(set_down(ZLOTY, 0.5, 1.35, **RESISTANCE), Outcome.HEADS, PAPER),
    "spins and falls": Kept(set_down(ZLOTY, 0.0, 1.2, 35.0, **RESISTANCE), Outcome.HEADS, PAPER),
}
LIMITS = {
    certificate.LAW: (1e-12, 2e-3),
    certificate.MOMENTUM: (1e-12, 3e-3),
    certificate.IMPACT_ENERGY: (1e-11, 1e-3),
    certificate.GAIN: (1e-12, 1e-6),
    certificate.FLIGHT_ENERGY: (1e-9, 1e-4),
    certificate.CONTACT_ENERGY: (1e-7, 2e-2),
    certificate.KEPT: (1e-7, 1e-2),
    certificate.LANDING: (1e-6, 0.5),
    certificate.NORM: (1e-13, 1e-13),
}
"""The largest residuals by the analytic engine and by MuJoCo: the coin turns in its contact of a microsecond,
and its steps in a sustained contact change about 1e-3 of the energy in a second."""


@cache
def tossed(engine, name):
    return toss(engine, TOSSES[name].case)


def longest_contact(toss, inside=0.0):
    """Return times spread over the longest contact, without the part `inside` of it at either end."""
    start, end = toss.contacts[np.argmax(np.diff(toss.contacts, axis=1))]
    assert end - start > 0.01, "the coin should stay on the floor"
    return np.linspace(start + inside * (end - start), end - inside * (end - start), 400)


@WITHOUT
@ENGINES
@pytest.mark.parametrize("name", TOSSES)
def test_a_toss_keeps_what_it_must(engine, name):
    """Its residuals are small, its energy falls, its contact point stays on the floor, its events follow."""
    known, found = TOSSES[name], tossed(engine, name)
    case, mujoco, impacts, contacts = known.case, engine is Engine.MUJOCO, found.impacts, found.contacts
    measured = {line.name: float(line.value) for line in found.certificate if line.name in LIMITS}
    assert {line: value for line, value in measured.items() if value > LIMITS[line][mujoco]} == {}
    assert known.outcome in (None, found.outcome)
    assert found.ending in known.endings
    assert np.all(np.diff(impacts.time) > 0)
    assert np.all(np.diff(contacts.ravel()) >= 0)
    assert np.all(contacts[:, 0] < contacts[:, 1])
    assert max(impacts.time.max(initial=0.0), contacts[-1, 1]) <= found.end_time
    during = (impacts.time[:, None] > contacts[:, 0]) & (impacts.time[:, None] < contacts[:, 1])
    assert not during.any()
    path = found.sample(np.linspace(0, found.end_time, 2001))
    energy = energies(case, path)
    assert np.max(energy - np.minimum.accumulate(energy)) < (2e-3 if mujoco else 1e-9) * energy[0]
    assert energy[-1] < 0.98 * energy[0]
    states = found.sample(longest_contact(found, inside=0.05))
    lowest = states.lowest_points(case)
    # MuJoCo's steps hold the point to 3e-3 where the coin rolls fast.
    assert np.abs(lowest[:, 2]).max() < (1e-2 if mujoco else 1e-12) * R
    turn = np.array([rotation_matrix(tuple(e)) for e in states.quaternion])
    spin = np.einsum("nij,nj->ni", turn, states.angular_velocity)
    slip = np.median(
        np.linalg.norm((states.velocity + np.cross(spin, lowest - states.position))[:, :2], axis=1)
    )
    assert known.slip[0] <= slip < known.slip[1]


@WITHOUT
@ENGINES
@pytest.mark.parametrize("name", list(TOSSES)[:6])
def test_a_path_is_continuous_and_meets_its_impacts(engine, name):
    found = tossed(engine, name)
    release, at_release = found.scenario.release, found.sample([0.0])
    assert at_release.position[0] == pytest.approx(release.position, abs=1e-16)
    assert at_release.angular_velocity[0] == pytest.approx(release.angular_velocity, rel=1e-15)
    assert found.sample(found.impacts.time).position == pytest.approx(found.impacts.position, abs=1e-12)
    events = np.unique([*found.impacts.time, *found.contacts.ravel()])
    events, moment = events[(events > 0) & (events < found.end_time)][:200], 1e-9
    before, after = found.sample(events - moment), found.sample(np.minimum(events + moment, found.end_time))
    # Nothing moves faster than 2 m/s or turns faster than 500 rad/s; MuJoCo's steps join to rounding.
    assert distance(before, after).max(initial=0) < 2 * moment * 3.5 + 1e-12
    assert attitude_angle(before, after).max(initial=0) < 2 * moment * 500 + 3e-8
    times, dt = longest_contact(found), 1e-4
    states = found.sample(np.arange(times[0], min(times[-1], times[0] + 0.3), dt))
    mean = (states.velocity[1:] + states.velocity[:-1]) / 2
    # MuJoCo's steps put the point back onto the floor. Measured: 4e-4 and 0.02 m/s.
    most = {Engine.ANALYTIC: 1e-3, Engine.MUJOCO: 0.05}[engine] * dt
    assert np.abs(np.diff(states.position, axis=0) - mean * dt).max() < most


@WITHOUT
@ENGINES
@pytest.mark.parametrize("name", [name for name, known in TOSSES.items() if known.presses])
def test_the_floors_force_is_what_momentum_gains_beyond_weight_and_drag(engine, name):
    """Of m g. MuJoCo's is the mean of a step's ends, and in one of 0.12 rad it changes by up to a tenth."""
    found, case, apart = tossed(engine, name), TOSSES[name].case, 1e-5
    times = longest_contact(found, inside=0.03)[::10]
    states = found.sample(times)
    faster, slower = (found.sample(times + step).velocity for step in (apart / 2, -apart / 2))
    drag = linear_drag(R, H, AIR["normal"], AIR["tangential"])
    turn = np.array([rotation_matrix(tuple(e)) for e in states.quaternion])
    of_B = np.einsum("nji,nj->ni", turn, states.velocity)
    of_B -= np.cross(states.angular_velocity, case.coin.center_of_mass)
    along = of_B * [drag.force_tangential, drag.force_tangential, drag.force_normal]
    expected = M * ((faster - slower) / apart + [0, 0, G]) + np.einsum("nij,nj->ni", turn, along)
    force = found.floor_force(times)
    error = np.linalg.norm(force - expected, axis=1) / (M * G)
    assert np.quantile(error, 0.9) < {Engine.ANALYTIC: 1e-5, Engine.MUJOCO: 6e-2}[engine]
    assert np.median(np.linalg.norm(force, axis=1)) > 0.1 * M * G
    start, end = found.contacts[-1]
    at_end, before = found.floor_force([end, end - 1e-6 * (end - start)])
    assert at_end == pytest.approx(before, abs=1e-2 * M * G)
    first = min(found.impacts.time.min(initial=np.inf), found.contacts[0, 0])
    assert not found.floor_force(np.linspace(0, 0.999 * first, 20)[: 20 * (first > 0)]).any()


@WITHOUT
@ENGINES
@pytest.mark.parametrize(
    ("name", "symmetry"),
    [
        ("slides on a smooth floor", "a turn about the vertical"),
        *(("slides on a rough floor", name) for name in SYMMETRIES if not SYMMETRIES[name].balanced),
        *(("sticks after sliding", name) for name in SYMMETRIES if SYMMETRIES[name].balanced),
        *(("upright on a smooth floor", name) for name in SYMMETRIES),
    ],
)
def test_a_symmetry_of_the_release_is_one_of_the_whole_toss(engine, name, symmetry):
    """Its impacts until the coin stays on the floor, and how it ends; a rattle's later impacts are many."""
    change, here, case = SYMMETRIES[symmetry], tossed(engine, name), TOSSES[name].case
    release = NEARLY_UPRIGHT if "upright" in name else LOW
    there = toss(engine, case.replace("release", change.release(release)))
    n = min(6, int(np.sum(here.impacts.time < here.contacts[0, 0])))
    assert n >= 3
    # Rounding moves MuJoCo's first step in a contact, and six impacts multiply it: at most 7e-8 s, 2e-6.
    late, part = {Engine.ANALYTIC: (1e-10, 1e-9), Engine.MUJOCO: (5e-7, 2e-5)}[engine]
    a, b = here.impacts[:n], there.impacts[:n]
    assert b.time == pytest.approx(a.time, abs=late)
    expected = change.vector(a.impulse)
    assert np.abs(b.impulse - expected).max() < part * np.abs(expected).max()
    assert b.position == pytest.approx(change.vector(a.position) + change.shift, abs=2 * late)
    assert b.point == pytest.approx(a.point @ change.body.T, abs=part * R)
    swapped = {1: 2, 2: 1} if change.swaps_faces else {}
    assert b.face.tolist() == [swapped.get(face, face) for face in a.face.tolist()]
    assert there.contacts[0, 0] == pytest.approx(here.contacts[0, 0], abs=late)
    assert (there.ending, there.outcome) == (here.ending, swapped.get(here.outcome, here.outcome))
    # An ending is noticed at the end of a step.
    assert there.end_time == pytest.approx(here.end_time, abs=0.01)


@WITHOUT
@ENGINES
@pytest.mark.parametrize("coin", [ZLOTY, IMPERFECT], ids=["balanced", "imperfect"])
def test_a_smooth_slope_in_vacuum_is_a_level_floor_that_accelerates(engine, coin):
    """The same impacts as over a level floor under g cos(a), moved along x by g sin(a) t²/2."""
    slope, release = 0.4, {**draw_release(np.random.default_rng(3)), "position": [0.0, 0.0, 0.1]}
    case = scenario(coin=coin, release=release, floor={"restitution": 0.6}, ending={"max_impacts": 4})
    other = toss(engine, case.replace("gravity", G * np.cos(slope))).impacts
    sloping = toss(engine, case.replace("floor.slope", slope)).impacts
    assert sloping.time == pytest.approx(other.time, rel=1e-5)
    moved = G * np.sin(slope) * other.time**2 / 2
    assert sloping.position[:, 0] - other.position[:, 0] == pytest.approx(moved, rel=1e-4, abs=1e-7)
    size = np.linalg.norm(other.impulse, axis=1)
    assert np.linalg.norm(sloping.impulse - other.impulse, axis=1) == pytest.approx(0, abs=1e-3 * size.max())


def drawn(seed: int, **parts) -> Scenario:
    """Return a toss of two impacts from a drawn release, low enough that it bounces on."""
    release = draw_release(np.random.default_rng(seed))
    return scenario(release=release, ending={"max_impacts": 2}, **parts)


THIN_OFF = {**THIN, "center_of_mass": [*PAPER_OFFSET[:2], 0.0]}
AGREED = {
    **{
        f"draw {seed}": drawn(seed, coin=draw_coin(np.random.default_rng(seed)), air=AIR)
        for seed in range(12)
    },
    **{
        f"b = {b}": scenario(
            coin=coin, air={**AIR, "exponent": b}, release=TUMBLING, ending={"max_impacts": 1}
        )
        for b, coin in ((0.5, THIN_OFF), (1.0, IMPERFECT))
    },
    **{
        f"slope, {contact}, {coin is ZLOTY}, {bool(air)}": drawn(
            5,
            coin=coin,
            air=air,
            floor={"contact": contact, "friction": 0.3, "restitution": 0.6, "slope": 0.3},
        ).replace("release.position.z", 0.15, "ending.max_impacts", 6)
        for contact in ("smooth", "coulomb")
        for air in ({}, AIR)
        for coin in (ZLOTY, IMPERFECT)
    },
}


@pytest.mark.parametrize("name", AGREED)
def test_engines_agree_up_to_the_first_touch_and_within_their_trust(name):
    """In a contact of MuJoCo the coin turns for a third of a microsecond, and impacts amplify that."""
    case = AGREED[name]
    here, there = (toss(engine, case) for engine in Engine)
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n >= 1
    a, b = here.impacts[:n], there.impacts[:n]
    assert b.face.tolist() == a.face.tolist()
    assert b.time == pytest.approx(a.time, rel=2e-3)
    assert b.time[0] == pytest.approx(a.time[0], abs=1e-9 if case.air.exponent else 1e-8)
    assert b.position[:, 0] == pytest.approx(a.position[:, 0], rel=5e-3, abs=1e-9)
    assert b.impulse[0] == pytest.approx(
        a.impulse[0], rel=4e-4, abs=1e-3 * float(np.linalg.norm(a.impulse[0]))
    )
    for each, most in ((here, 1e-6 if case.air.exponent else 1e-9), (there, 1e-4)):
        flown = [float(line.value) for line in each.certificate if line.name == certificate.FLIGHT_ENERGY]
        assert max(flown, default=0.0) < most
    times = np.linspace(0, min(a.time[0], b.time[0]), 20)[:-1]
    assert distance(here.sample(times), there.sample(times)).max() < 1e-6 * R
    assert attitude_angle(here.sample(times), there.sample(times)).max() < 1e-6


@WITHOUT
@pytest.mark.parametrize(
    "name", [name for name, known in TOSSES.items() if known.case.floor.rolling_friction]
)
def test_engines_agree_on_how_resistance_stops_a_coin(name):
    here, there = (tossed(engine, name) for engine in Engine)
    # An end is noticed after a step, here of some 5 ms, and in a second MuJoCo's change 1e-3 of the energy.
    assert there.end_time == pytest.approx(here.end_time, rel=2e-2, abs=5e-3)
    times = np.linspace(0, min(there.end_time, here.end_time), 200)
    E, other = (energies(TOSSES[name].case, each.sample(times)) for each in (here, there))
    # In a second MuJoCo's steps change up to 4e-3 of the energy, and a fast spin 1e-3 at once.
    assert other == pytest.approx(E, abs=6e-3 * E[0])
    path, beside = (each.sample(times).position[:, :2] for each in (here, there))
    assert np.linalg.norm(path[-1] - beside[-1]) < 0.02 * np.linalg.norm(np.diff(path, axis=0), axis=1).sum()


FLOORS = {
    "threshold": {"restitution_threshold": 1.2},
    "power": {"restitution": 0.5, "restitution_exponent": 0.25},
    "viscous": {"restitution": 1.0, "restitution_viscous": 0.3},
    "both": {"restitution": 0.6, "restitution_exponent": 0.25, "restitution_viscous": 0.2},
}
BY = {
    "analytic": (analytic, analytic.FINE, 1e-9),
    **{
        f"mujoco, {contact}, {name}": (coin_mj, replace(settings, contact=contact), near)
        for contact in Realisation
        for name, settings, near in (("fine", coin_mj.FINE, 2e-4), ("many", coin_mj.MANY, 3e-3))
    },
}
"""Engines with their settings, and how near a rebound is to its part of a touch's speed."""


@WITHOUT
@pytest.mark.parametrize("by", BY.values(), ids=BY)
@pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)
def test_each_impact_rebounds_as_its_speed_says(by, floor):
    package, settings, near = by
    case = on_floor(load("fig24a"), floor)
    case = case.replace("ending.max_impacts", 6 if case.floor.restitution_threshold else 3)
    impacts = package.toss(case, settings=settings).impacts
    speeds = -impacts.contact_velocity_before[:, 2]
    expected = np.array([restitution_at_speed(case.rules, speed) for speed in speeds])
    assert np.ptp(expected) > 0.03
    assert np.abs(impacts.contact_velocity_after[:, 2] / speeds - expected).max() < near
    assert law_residuals(case.body, case.rules, impacts).max() < near


@WITHOUT
@pytest.mark.parametrize("by", BY.values(), ids=BY)
def test_the_threshold_itself_is_plastic_and_touches_above_it_keep_their_bits(by):
    package, settings, near = by
    case = load("fig24a").replace("ending.max_impacts", 3)
    free = package.toss(case, settings=settings).impacts
    speeds = -free.contact_velocity_before[:, 2]
    which, slowest = int(np.argmin(speeds)), float(speeds.min())
    below, at = (
        package.toss(case.replace("floor.restitution_threshold", size), settings=settings).impacts
        for size in (np.nextafter(slowest, 0), slowest)
    )
    assert np.array_equal(below.impulse, free.impulse)
    assert np.array_equal(at.impulse[:which], free.impulse[:which])
    assert at.contact_velocity_after[which, 2] == pytest.approx(0, abs=near * slowest)
    assert free.contact_velocity_after[which, 2] > 0.5 * slowest


@WITHOUT
@pytest.mark.parametrize("contact", list(Realisation))
@pytest.mark.parametrize("floor", FLOORS)
@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
def test_the_impacts_on_a_floor_of_restitution_by_speed_are_those_of_the_other_engine(contact, floor, law):
    rng, settings = np.random.default_rng([11, len(law)]), replace(coin_mj.FINE, contact=contact)
    for _ in range(3):
        parts = {"coin": draw_coin(rng), "air": AIR, "release": draw_release(rng)}
        rough = {"contact": law, "friction": 0.3, "restitution": 0.5, **FLOORS[floor]}
        case = scenario(**parts, floor=rough, ending={"max_impacts": 1})
        expected, found = analytic.toss(case).impacts, coin_mj.toss(case, settings=settings).impacts
        assert np.linalg.norm(found.impulse - expected.impulse) < 1e-4 * np.linalg.norm(expected.impulse)
        # By its own law each errs by what MuJoCo's solimp leaves, 1e-4, and by how far the coin turns.
        assert law_residuals(case.body, case.rules, found).max() < 5e-4


@WITHOUT
@pytest.mark.parametrize("settings", [coin_mj.FINE, coin_mj.MANY], ids=["fine", "many"])
def test_the_impacts_of_a_viscous_floor_end_in_contact_on_both_engines(settings):
    case = on_floor(load("fig24a"), {"restitution": 0.9, "restitution_viscous": 0.2})
    case = case.replace("ending.test", "lying", "ending.max_time", 3.0)
    found, expected = coin_mj.toss(case, settings=settings), analytic.toss(case)
    for each in (found, expected):
        assert each.ending == Ending.MAX_TIME
        assert each.contacts[-1, 1] == each.end_time == 3.0
    # The paths differ by then: in the other engine the coin loses as much in as many bounces.
    assert found.contacts[0, 0] == pytest.approx(expected.contacts[0, 0], rel=0.1)


@WITHOUT
@ENGINES
@pytest.mark.parametrize("exponent", [0.0, 0.5])
def test_in_air_an_unbalanced_coin_is_caught_where_its_path_without_a_hand_comes_down(engine, exponent):
    release, hand = {**TUMBLING, "position": [0.0, 0.0, 1.0], "velocity": [0.2, 0.0, 3.0]}, 1.2
    air = {"normal": 4.0, "tangential": 1.0, "exponent": exponent}
    free = toss(engine, scenario(coin=IMPERFECT, air=air, release=release, ending={"max_time": 0.6}))
    caught = toss(engine, free.scenario.replace("ending.caught", hand))
    down = brentq(lambda t: free.sample([t]).position[0, 2] - hand, 0.3, 0.6, xtol=1e-14)
    assert caught.ending == Ending.CAUGHT
    assert caught.end_time == pytest.approx(down, abs=1e-9)
    # The air has taken more than 1 ms.
    assert down < (3 + np.sqrt(9 - 2 * G * (hand - 1))) / G - 1e-3


@WITHOUT
@ENGINES
def test_in_vacuum_the_exponent_of_the_air_changes_nothing(engine):
    case = scenario(coin=IMPERFECT, release=TUMBLING, ending={"max_impacts": 3})
    known, found = toss(engine, case), toss(engine, case.replace("air.exponent", 0.5))
    assert np.array_equal(found.impacts.time, known.impacts.time)
    assert np.array_equal(found.impacts.impulse, known.impacts.impulse)


@WITHOUT
@ENGINES
def test_the_euro_on_the_table_comes_to_lie_with_the_same_face_up(engine):
    lies = toss(engine, load("table"))
    assert (lies.outcome, lies.ending, lies.sequence[:3]) == (Outcome.HEADS, Ending.LYING, "HTH")
    # It wobbles for two seconds; the steps of MuJoCo's contact err by a thousandth of the energy in a second.
    assert lies.end_time == pytest.approx(2.52, abs=0.02)
    assert np.isfinite(lies.floor_force([lies.end_time])).all()
    with pytest.raises(ValueError, match="is outside the toss"):
        lies.floor_force([lies.end_time + 1])
    assert lies.sample([]).quaternion.shape == (0, 4)
    with pytest.raises(ValueError, match=r"shape \(1, 2\)"):
        lies.sample([[0.0, 0.1]])


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
    found = [
        toss_many(engine, case, states_of_hands(np.random.default_rng(1993), n, aside=10.0))
        for engine in Engine
    ]
    for outcomes in found:
        assert set(outcomes.ending) <= {Ending.PAPER, Ending.LYING, Ending.AT_REST}
    counts = [Counter(outcomes.outcome.tolist()) for outcomes in found]
    for outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE):
        assert abs(counts[0][outcome] - counts[1][outcome]) < 4 * (2 * n * 0.25) ** 0.5
    assert np.mean(found[0].end_time) == pytest.approx(np.mean(found[1].end_time), rel=0.1)
