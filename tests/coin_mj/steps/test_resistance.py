"""MuJoCo's coin on a floor that resists rolling and pivoting: closed forms, rest, energy, Euler's disk."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj.model import state
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import Friction, MujocoSettings
from cointoss.coin_mj.steps import held_step, resistance
from cointoss.coin_mj.steps.resistance import Coefficients, PointMotion
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.kernel.vectors import cross
from cointoss.models.records import ApproximationWarning, Outcome, UnsupportedError
from tests.helpers.draws import AIR, THIN, ZLOTY, draw_coin, draw_quaternion, draw_release, scenario
from tests.helpers.states import energies
from tests.helpers.tuples import quaternion, vector

state_of = by_numba(state.state_of)
resisted_force = by_numba(resistance.resisted_force)
shortest_stop = by_numba(resistance.shortest_stop)
next_step = by_numba(held_step.next_step)
sustained_step = by_numba(held_step.sustained_step)

pytestmark = [
    pytest.mark.filterwarnings(f"ignore::{ApproximationWarning.__module__}.ApproximationWarning"),
    pytest.mark.usefixtures("without_horizon"),
]

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
UNIT = (G / R) ** 0.5
NO_LEAN = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def set_down(speed, spin=0.0, coin=THIN, law="coulomb", **floor):
    """Give a coin that is set down upright: it rolls along x, or turns about the vertical."""
    return scenario(
        coin=coin,
        floor={"contact": law, "friction": 0.5, "restitution": 0.3, **floor},
        release={
            "position": [0, 0, R],
            "velocity": [speed, 0, 0],
            "angles": [0, np.pi / 2, 0],
            "angular_velocity": [0, spin, -speed / R],
        },
    )


def test_on_a_smooth_floor_a_coin_pivots_nearly_to_rest_and_slides_on():
    """The toss ends while the coin still turns: with the little spin left it can't rise over its edge."""
    case = set_down(0.0, 20.0, law="smooth", pivoting_friction=1e-3, rolling_friction=1e-3)
    case = case.replace("release.velocity.x", 0.2)
    tossed, loss = coin_mj.toss(case), 1e-3 * M * G / case.body.inertia[1][1]
    at_half, at_end = tossed.sample([10.0 / loss, tossed.end_time]).angular_velocity[:, 1]
    assert at_half == pytest.approx(10.0, rel=2e-3)
    assert at_end == pytest.approx(20.0 - loss * tossed.end_time, abs=1e-3)
    assert 0 < at_end < 0.1
    assert tossed.sample(tossed.end_time).velocity[0, :2] == pytest.approx([0.2, 0], abs=1e-12)


def point_motion(numbers: Iterable[float]) -> PointMotion:
    x, y, z, a, b, c = map(float, numbers)
    return x, y, z, a, b, c


def draw_contact(rng):
    """Draw the Delassus matrix of a disc of mass 1 and radius 1 at its rim, and the motion there."""
    turn, angle = np.array(rotation_matrix(quaternion(draw_quaternion(rng)))), rng.uniform(0, 2 * np.pi)
    arm = turn @ [np.cos(angle), np.sin(angle), 0.0]
    J_inverse = turn @ np.diag([4.0, 4.0, 2.0]) @ turn.T
    # v_A = v + ω × a, and the moment of an impulse there about C is a × S.
    across = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    K = np.block(
        [[np.eye(3) - across @ J_inverse @ across, -across @ J_inverse], [J_inverse @ across, J_inverse]]
    )
    coefficients = Coefficients(*vector(rng.uniform(0.02, 0.3, 3)), 0.0)
    return K, coefficients, point_motion(rng.normal(size=6))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("seed", range(20))
def test_no_moment_is_larger_than_the_floor_has_and_each_takes_energy(seed):
    """In a short step: against the motion where it goes on."""
    rng = np.random.default_rng(seed)
    K, coefficients, motion = draw_contact(rng)
    dt, normal = 1e-3, 3.0
    free = np.array(motion) + dt * rng.normal(size=6)
    F, moment = resisted_force(K, coefficients, normal, motion, point_motion(free), NO_LEAN, dt)
    mu, delta, p, _ = coefficients
    N = normal + F[2]
    middle = free + dt * (K @ np.array([*F, *moment])) / 2
    assert N > 0
    assert F[:2] == pytest.approx(-mu * N * middle[:2] / np.hypot(*middle[:2]), abs=1e-2 * mu * N)
    assert moment[:2] == pytest.approx(
        -delta * N * middle[3:5] / np.hypot(*middle[3:5]), abs=1e-2 * delta * N
    )
    assert moment[2] == pytest.approx(-p * N * np.sign(middle[5]), rel=1e-9)
    # MuJoCo prescribes the vertical acceleration: nothing else changes it.
    assert K[2] @ np.array([*F, *moment]) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_a_coin_at_rest_is_held_by_what_pulls_it_and_no_more(seed):
    rng = np.random.default_rng([3, seed])
    K, _, _ = draw_contact(rng)
    dt, still, normal = 1e-3, point_motion(np.zeros(6)), 10.0
    free = point_motion(dt * K @ (rng.uniform(-1, 1, 6) * [1, 1, 0, 1, 1, 1]))
    F, moment = resisted_force(K, Coefficients(1.0, 0.5, 0.5, 0.0), normal, still, free, NO_LEAN, dt)
    after = np.array(free) + dt * K @ np.array([*F, *moment])
    assert np.delete(after, 2) == pytest.approx(0, abs=1e-11)
    F, weak = resisted_force(K, Coefficients(0.0, 1e-3, 2e-3, 0.0), normal, still, free, NO_LEAN, dt)
    assert F[:2] == (0.0, 0.0)
    assert np.hypot(*weak[:2]) == pytest.approx(1e-3 * (normal + F[2]), rel=1e-9)
    assert abs(weak[2]) == pytest.approx(2e-3 * (normal + F[2]), rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_the_contours_moment_acts_along_the_lean_against_the_spin_there(seed):
    """Of the size arm · N while the coin turns, and no more than stops it."""
    rng = np.random.default_rng([5, seed])
    K, _, motion = draw_contact(rng)
    angle, dt, normal = rng.uniform(0, 6), 1e-3, 3.0
    lean = np.array([np.cos(angle), np.sin(angle), 0.0])
    leans = (vector(lean), vector(lean))
    F, moment = resisted_force(K, Coefficients(0.0, 0.0, 0.0, 0.1), normal, motion, motion, leans, dt)
    size = -0.1 * (normal + F[2]) * np.sign(lean @ motion[3:])
    assert np.array(moment) == pytest.approx(size * lean, abs=1e-12)
    assert K[2] @ np.array([*F, *moment]) == pytest.approx(0, abs=1e-12)
    still = point_motion(1e-7 * np.array(motion))
    F, moment = resisted_force(K, Coefficients(0.0, 0.0, 0.0, 0.1), normal, still, still, leans, dt)
    after = np.array(still) + dt * K @ np.array([*F, *moment])
    assert lean @ after[3:] == pytest.approx(0, abs=1e-15)


def test_without_resistance_no_bit_of_a_toss_changes():
    rng = np.random.default_rng(8)
    for law in ("smooth", "coulomb"):
        floor = {"contact": law, "friction": 0.3, "restitution": 0.4}
        case = scenario(coin=draw_coin(rng), floor=floor, air=AIR, release=draw_release(rng))
        zeros = case.replace("floor.rolling_friction", 0.0, "floor.pivoting_friction", 0.0)
        tiny = case.replace("floor.rolling_friction", 1e-12, "floor.pivoting_friction", 1e-12)
        plain, zero, near = (coin_mj.toss(each) for each in (case, zeros, tiny))
        assert np.array_equal(plain.impacts.impulse, zero.impacts.impulse)
        assert (plain.end_time, plain.outcome, plain.ending) == (zero.end_time, zero.outcome, zero.ending)
        # Impacts have no resistance, so those before the first contact have no other bits either.
        first = plain.contacts[0, 0] if len(plain.contacts) else np.inf
        before = plain.impacts.time < first
        assert before.any()
        assert np.array_equal(plain.impacts.impulse[before], near.impacts.impulse[: before.sum()])


@pytest.mark.parametrize("size", [5e-5, 5e-4])
@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
def test_energy_never_rises(law, size):
    rng = np.random.default_rng([int(1e6 * size), len(law)])
    for _ in range(4):
        floor = {"contact": law, "friction": 0.3, "restitution": 0.4}
        floor.update(rolling_friction=size, pivoting_friction=size)
        case = scenario(coin=draw_coin(rng), floor=floor, release=draw_release(rng))
        tossed = coin_mj.toss(case)
        energy = energies(case, tossed.sample(np.linspace(0, tossed.end_time, 1001)))
        gain = np.max(energy - np.minimum.accumulate(energy)) / energy[0]
        # As without resistance: MuJoCo's steps in a contact change about 1e-3 of the energy in a second.
        assert gain < 2e-3
        assert tossed.outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)


def eulers_disk(viscosity=0.0, **floor):
    """Follow a thin disc that rolls round its resting mass centre: times, tilts, energies and ω_z."""
    tilt = 0.3
    rate = 2 * (G * np.sin(tilt) / R) ** 0.5
    case = scenario(
        coin=THIN,
        air={"viscosity": viscosity},
        floor={"contact": "perfectly_rough", "restitution": 0.3, **floor},
        release={
            "position": [0, 0, R * np.sin(tilt)],
            "angles": [0, tilt, 0],
            "angular_velocity": [0, rate, 0],
        },
    )
    machine = machine_of(case, MujocoSettings())
    coin, J, time, rows = machine.coin, np.array(case.body.inertia), 0.0, []
    while time < 1.6:
        x, v, e, w, _ = state_of(coin)
        turn = np.array(rotation_matrix(e))
        kinetic = (np.dot(v, v) * M + np.array(w) @ J @ np.array(w)) / 2
        rows.append(
            (time, np.arcsin(np.hypot(*turn[2, :2])), kinetic / (M * G * R) + x[2] / R, turn[2] @ np.array(w))
        )
        up = tuple(turn[2])
        dt, lands = next_step(coin, 0.3, up, cross(up, w), w, 0.0)
        assert not lands
        dt = min(dt, shortest_stop(coin, up, w))
        sustained_step(coin, 0.3, w, dt)
        time += dt
    return np.array(rows).T


@pytest.mark.slow
def test_eulers_disk_falls_flat_as_the_square_of_the_time_left_under_resistance_to_rolling():
    """dα/dt = -(4/3) √(g/r) (δ/r) √α, so √α falls steadily: the disk lies after a finite time."""
    delta = 2e-4
    times, tilts, energies, _ = eulers_disk(rolling_friction=delta)
    low = tilts < 0.05
    slope, root = np.polyfit(times[low], tilts[low] ** 0.5, 1)
    # Corrections of √α, and of the steps.
    assert slope == pytest.approx(-2 / 3 * UNIT * delta / R, rel=3e-2)
    assert -root / slope == pytest.approx(1.5 * R / (delta * UNIT) * 0.3**0.5, rel=0.06)
    assert np.max(energies - np.minimum.accumulate(energies)) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(
    ("losses", "power", "slope"),
    [
        ({"contour_friction": 1.6e-3 * R}, 1.5, 2 * 1.6e-3),
        ({"contour_viscosity": 3.4e-4 * R / UNIT}, 2, 16 / 3 * 3.4e-4),
        ({"viscosity": 8.5e-5 * M * UNIT / R}, 3, 2 * np.pi * 8.5e-5),
    ],
)
def test_eulers_disk_stops_as_its_closed_form_says(losses, power, slope):
    """α^(3/2), α² or α³ falls steadily, by E = 3/2 m g r α and φ' = 2 √(g/(r α))."""
    times, tilts, energies, _ = eulers_disk(**losses)
    low = (tilts > 0.05) & (tilts < 0.2)
    found = -np.polyfit(times[low], tilts[low] ** power, 1)[0]
    # Corrections of α², and of the steps.
    assert found == pytest.approx(slope * UNIT, rel=3e-2)
    assert np.max(energies - np.minimum.accumulate(energies)) < 1e-6


@pytest.mark.slow
def test_eulers_disk_loses_its_pivoting_at_first_at_the_rate_of_the_closed_form():
    """DE/dt = -p m g |ω_z|."""
    p = 2e-4
    times, _, energies, pivots = eulers_disk(pivoting_friction=p)
    first = times < 0.1
    rate = -np.polyfit(times[first], energies[first], 1)[0]
    assert rate == pytest.approx(p / R * np.mean(pivots[first]), rel=5e-3)
    assert abs(pivots[-1]) < 0.05 * pivots[0]


def test_beside_native_friction_resistance_is_refused_by_name():
    native = replace(coin_mj.FINE, friction=Friction.NATIVE)
    with pytest.raises(UnsupportedError, match=r"floor\.pivoting_friction = 0\.0002: .*native friction: 0"):
        coin_mj.toss(set_down(0.1, pivoting_friction=2e-4), settings=native)
    with pytest.raises(UnsupportedError, match=r"air\.viscosity = 2e-05: .*native friction: 0"):
        coin_mj.toss(set_down(0.1).replace("air.viscosity", 2e-5), settings=native)
