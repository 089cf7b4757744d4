"""Resistance to rolling and pivoting: closed forms, Newton's law, energy, rest, and Euler's disk."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode, flow
from cointoss.analytic.contact.contact import lower_rim_of
from cointoss.analytic.contact.integrator import contact_work, step_contact
from cointoss.analytic.contact.resistance import FloorFriction, moment_per_force
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.contact.rim_contact import both_rims, rim_contact
from cointoss.analytic.contact.sampling import floor_force
from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR, SLOW
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.certificate import CONTACT_ENERGY
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import assert_lowest_point_stays, follow_for, held, put_on_floor
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import IMPERFECT, THIN, ZLOTY, draw_coin, scenario

step_contact = by_numba(step_contact)

pytestmark = pytest.mark.usefixtures("without_horizon")

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
UNIT = (G / R) ** 0.5
HOOP = {**THIN, "inertia": np.diag([0.5, 0.5, 1.0]) * M * R * R}


def upright_state(spin, velocity=(0.0, 0.0, 0.0)):
    """Return the state of a balanced coin upright on the floor; ζ is along -y, and η upwards."""
    return np.array([0, 0, R, *velocity, *quaternion_from_angles((0.0, np.pi / 2, 0.0)), *spin])


def rolling_state(body, speed):
    """Return the state of a coin that rolls straight on along x."""
    y = upright_state((0.0, 0.0, speed / R), (speed, 0.0, 0.0))
    A = rim_contact(body, y, -1.0)
    if abs(A.velocity[0]) > 1e-9:
        y[12] *= -1
    return y


def energy_of(body, y):
    turning = np.array(y[10:13]) @ np.array(body.inertia) @ np.array(y[10:13]) / 2
    return body.mass * (np.dot(y[3:6], y[3:6]) / 2 + body.gravity * y[2]) + turning


@pytest.mark.parametrize(("coin", "share"), [(THIN, 0.5), (HOOP, 1.0)])
def test_a_disc_and_a_hoop_that_roll_upright_stop_where_the_closed_form_says(coin, share):
    """(J_ζ + m r²) dω_ζ/dt = -δ m g: v falls by δ g/(r (1 + J_ζ/(m r²))) a second."""
    delta, speed, body = 1e-3, 0.3, scenario(coin=coin).body
    y = rolling_state(body, speed)
    slowing = delta * G / (R * (1 + share))
    states, times = follow_for(body, FloorFriction(50.0, delta), Mode.STICKING, y, 0.98 * speed / slowing)
    assert states[:, 3] == pytest.approx(speed - slowing * times, abs=1e-9 * speed)
    run = speed * times[-1] - slowing * times[-1] ** 2 / 2
    assert states[-1, 0] == pytest.approx(run, rel=1e-9)
    assert run == pytest.approx(speed**2 * R * (1 + share) / (2 * delta * G), rel=1e-3)


def test_a_disc_that_pivots_upright_is_slowed_by_its_resistance():
    """J_ξ dω_z/dt = -p m g."""
    p, spin, body = 1e-4, 80.0, scenario(coin=THIN).body
    slowing = p * M * G / body.inertia[1][1]
    time = 0.9 * spin / slowing
    states, times = follow_for(
        body, FloorFriction(50.0, 0.0, p), Mode.STICKING, upright_state((0.0, spin, 0.0)), time
    )
    assert states[:, 11] == pytest.approx(spin - slowing * times, rel=1e-9)
    _, kept = follow_for(body, FloorFriction(50.0, 1e-3), Mode.STICKING, upright_state((0.0, spin, 0.0)), 0.1)
    assert kept[-1] == pytest.approx(0.1)


def test_slow_motion_is_resisted_in_proportion_to_it():
    body, friction = scenario().body, FloorFriction(0.0, 2e-4, 3e-4)
    slow = SLOW * UNIT
    fast = moment_per_force(body, friction, (0.0, 0.0, 1.0), (3.0, -4.0, 5.0))
    assert fast == pytest.approx((-1.2e-4, 1.6e-4, -3e-4), rel=1e-14)
    half = moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, slow / 2, -slow / 4))
    assert half == pytest.approx((0.0, -1e-4, 0.75e-4), rel=1e-14)
    assert moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def contact_states(seed):
    """Give states in each mode, with the coin's body and the floor's friction."""
    rng = np.random.default_rng(seed)
    coin = draw_coin(rng)
    body = scenario(coin=coin).body
    friction = FloorFriction(*(rng.uniform(0.1, 0.9), *rng.uniform(1e-5, 4e-3, 2)))
    for mode in (Mode.SLIDING, Mode.INCIPIENT_SLIP, Mode.STICKING, Mode.UPRIGHT):
        angles = (rng.uniform(0, 6), rng.uniform(0.2, 1.4), rng.uniform(0, 6))
        y = np.array(
            [0, 0, 0, *rng.uniform(-0.3, 0.3, 3), *quaternion_from_angles(angles), *rng.uniform(-20, 20, 3)]
        )
        if mode == Mode.UPRIGHT:
            if coin["thickness"] == 0:
                continue
            y[6:10] = quaternion_from_angles((angles[0], np.pi / 2, angles[2]))
        put_on_floor(body, friction, mode, y)
        yield body, friction, mode, y


@pytest.mark.parametrize("seed", range(12))
def test_the_lowest_point_stays_on_the_floor_and_stays_there_where_friction_holds_it(seed):
    met = 0
    for body, friction, mode, y in contact_states(seed):
        if mode != Mode.UPRIGHT:
            assert_lowest_point_stays(body, friction, mode, y)
            met += 1
    assert met == 3


@pytest.mark.parametrize("seed", range(12))
def test_the_floor_takes_energy_at_the_rate_of_slip_roll_and_pivot(seed):
    """DE/dt = F · v_A - N (δ |ω_h| + p |ω_z|) in every mode, with the N of that very instant."""
    for body, friction, mode, y in contact_states(seed):
        dy, w = np.empty(13), np.array(rotation_matrix(tuple(y[6:10]))) @ y[10:13]
        contact = held(body, friction, mode, y)
        flow(contact, y, dy)
        F = np.array(floor_force(contact, y))
        power = M * np.dot(y[3:6], dy[3:6]) + M * G * y[5]
        power += y[10:13] @ np.array(body.inertia) @ dy[10:13]
        taken = F[2] * (friction.rolling * np.hypot(w[0], w[1]) + friction.pivoting * abs(w[2]))
        if mode == Mode.UPRIGHT:
            rims = both_rims(body, friction, y)
            N = upright.rim_forces(body, friction, y)
            slow = SLOW * (G * R) ** 0.5
            for A, pressed in zip(rims, N, strict=True):
                slip = np.hypot(A.velocity[0], A.velocity[1])
                taken += friction.sliding * pressed * slip * min(slip / slow, 1.0)
        else:
            v_A = np.array(rim_contact(body, y, lower_rim_of(y)).velocity)
            taken -= F @ v_A
        assert power == pytest.approx(-taken, abs=1e-11)
        assert abs(taken) > 1e-7


@pytest.mark.parametrize("seed", range(6))
def test_the_moment_on_the_coin_is_that_of_the_normal_force_of_the_same_instant(seed):
    """J dω/dt + ω × J ω = a × F + N (-δ ω_h/|ω_h| - p ω_z/|ω_z| ẑ)."""
    for body, friction, mode, y in contact_states(seed):
        if mode == Mode.UPRIGHT:
            continue
        dy, Rm = np.empty(13), np.array(rotation_matrix(tuple(y[6:10])))
        contact = held(body, friction, mode, y)
        flow(contact, y, dy)
        F = np.array(floor_force(contact, y))
        J, w = np.array(body.inertia), y[10:13]
        arm = np.array(rim_contact(body, y, lower_rim_of(y)).arm)
        moment = Rm @ (J @ dy[10:13] + np.cross(w, J @ w)) - np.cross(arm, F)
        turn = Rm @ w
        expected = [
            *(-friction.rolling * turn[:2] / np.hypot(*turn[:2])),
            -friction.pivoting * np.sign(turn[2]),
        ]
        assert moment == pytest.approx(F[2] * np.array(expected), abs=1e-13)


def test_without_resistance_nothing_is_added():
    body, y = scenario().body, upright_state((1.0, 2.0, 3.0))
    A, _ = both_rims(body, FloorFriction(0.5), y)
    assert A == rim_contact(body, y, -1.0)
    assert np.array_equal(np.array(A.delassus), np.array(A.delassus).T)
    assert A != both_rims(body, FloorFriction(0.5, 1e-9), y)[0]


def test_little_resistance_changes_a_contact_in_proportion():
    body = scenario(coin=IMPERFECT).body
    start = np.array([0, 0, 0, 0.1, 0, 0, *quaternion_from_angles((0.0, 1.0, 0.3)), 3.0, 1.0, 30.0])
    put_on_floor(body, FloorFriction(0.3), Mode.SLIDING, start)

    def end(size):
        return follow_for(body, FloorFriction(0.3, size, size), Mode.SLIDING, start, 2e-3)[0][-1]

    without = end(0.0)
    large, small = (np.linalg.norm(end(size) - without) for size in (1e-6, 1e-8))
    assert large == pytest.approx(100 * small, rel=1e-2)
    assert 0 < small < 1e-4


@pytest.mark.parametrize("lean", [0.5, -0.9, 1.2])
def test_a_coin_at_rest_stays_while_its_mass_centre_is_within_delta_of_the_contact(lean):
    """The weight's moment is m g a, a the horizontal distance of C from A."""
    delta, body = 1e-3, scenario(coin=THIN).body
    y = upright_state((0.0, 0.0, 0.0))
    y[6:10] = quaternion_from_angles((0.0, np.pi / 2 + np.arcsin(lean * delta / R), 0.0))
    put_on_floor(body, FloorFriction(0.3), Mode.STICKING, y)
    for mu in (0.0, 0.3):
        mode = Mode.STICKING if mu else Mode.SLIDING
        assert rests(held(body, FloorFriction(mu, delta, 0.0), mode, y), y) == (abs(lean) < 1)
    assert not rests(held(body, FloorFriction(0.3, 0.0, delta), Mode.STICKING, y), y)
    y[10] = 0.1 * UNIT
    assert not rests(held(body, FloorFriction(0.3, delta, 0.0), Mode.STICKING, y), y)


@pytest.mark.parametrize("seed", range(8))
def test_contacts_of_random_tosses_never_gain_energy(seed):
    rng = np.random.default_rng((17, seed))
    case = draw_toss(rng, imperfect=seed % 2 == 1)
    law = ("smooth", "coulomb", "perfectly_rough")[seed % 3]
    case = case.replace(
        "floor.contact",
        law,
        "floor.restitution_kind",
        "kinematic",
        "floor.restitution",
        0.4,
        "floor.rolling_friction",
        rng.uniform(1e-5, 1e-3),
        "floor.pivoting_friction",
        rng.uniform(1e-5, 1e-3),
    )
    tossed = analytic.toss(case)
    gained = [float(setting.value) for setting in tossed.certificate if setting.name == CONTACT_ENERGY]
    assert max(gained, default=0.0) < 1e-7
    assert len(tossed.contacts) > 0 or tossed.ending in (Ending.SETTLED, Ending.PAPER)
    assert tossed.outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)


def test_periodic_is_no_ending_of_a_coin_that_resistance_slows():
    case = scenario(
        coin=THIN,
        floor={"contact": "perfectly_rough", "restitution": 0.1},
        release={"position": [0, 0, 0.013], "angles": [0, 1.3, 0], "angular_velocity": [0, 0, 60]},
        ending={"max_time": 4.0},
    )
    assert analytic.toss(case).ending == Ending.PERIODIC
    slow = case.replace("floor.rolling_friction", 1e-9, "floor.pivoting_friction", 1e-9)
    assert analytic.toss(slow).ending == Ending.MAX_TIME
    fast = slow.replace("floor.rolling_friction", 5e-4, "ending.max_time", 100.0)
    assert analytic.toss(fast).outcome in (Outcome.HEADS, Outcome.TAILS)


def euler_disk(tilt):
    """Return the state of a thin disc that rolls round its fixed mass centre at a small tilt.

    Ω² sin α = 4 g/r for the thin disc; ω lies along the diameter through A, with |ω| = Ω sin α.
    """
    y = np.array([0, 0, R * np.sin(tilt), 0, 0, 0, *quaternion_from_angles((0.0, tilt, 0.0)), 0, 0, 0])
    rate = 2 * (G / (R * np.sin(tilt))) ** 0.5 * np.sin(tilt)
    y[11] = rate
    return y


def fall(body, friction, time, least=0.0):
    """Return times, tilts, energies and ω_z of Euler's disk, until a time or a tilt."""
    y, dt, seen = euler_disk(0.3), np.inf, [(0.0, 0.3, 0.0, 0.0)]
    stages = contact_work(held(body, friction, Mode.STICKING, y), y)
    while seen[-1][0] < time and seen[-1][1] > least:
        step = step_contact(held(body, friction, Mode.STICKING, y), y, dt, CONTACT_STEP_ERROR, stages)
        assert not step.is_over
        dt = step.next_dt
        Rm = np.array(rotation_matrix(tuple(y[6:10])))
        tilt = np.arcsin(np.hypot(*Rm[2][:2]))
        seen.append((seen[-1][0] + step.elapsed, tilt, energy_of(body, y), Rm[2] @ y[10:13]))
    return np.array(seen[1:]).T


def test_eulers_disk_falls_flat_as_the_square_of_the_time_left_under_resistance_to_rolling():
    """E = 3/2 m g r sin α and |ω_h| = Ω sin α cos α with Ω² sin α = 4 g/r.

    So dα/dt = -(4/3) √(g/r) (δ/r) √α, and √α falls steadily.
    """
    delta, body = 2e-5, scenario(coin=THIN).body
    start = euler_disk(0.3)
    assert np.allclose(rim_contact(body, start, lower_rim_of(start)).velocity, 0, atol=1e-12)
    times, tilts, _, _ = fall(body, FloorFriction(50.0, delta), 30.0, 1e-4)
    low = tilts < 3e-3
    slope = np.polyfit(times[low], tilts[low] ** 0.5, 1)[0]
    assert slope == pytest.approx(-2 / 3 * UNIT * delta / R, rel=1e-2)
    # The disk nutates, so its fall is measured over many of its turns.
    even = np.linspace(times[low][0], times[low][-1], 40)
    seen = np.interp(even, times, tilts)
    falls, middle = -np.diff(seen), (seen[1:] + seen[:-1]) / 2
    assert 1 / (1 - np.polyfit(np.log(middle), np.log(falls), 1)[0]) == pytest.approx(2, abs=0.05)


def test_eulers_disk_stops_pivoting_and_wobbles_on_under_resistance_to_pivoting_alone():
    """There is a steady motion with ω_z = 0 at every tilt, which nothing slows."""
    p, body = 1e-4, scenario(coin=THIN).body
    times, tilts, energies, pivots = fall(body, FloorFriction(50.0, 0.0, p), 3.0)
    E, first, last = energies / (M * G * R), times < 0.1, times > 2.5
    assert E[0] == pytest.approx(1.5 * np.sin(0.3), rel=1e-3)
    assert -np.polyfit(times[first], E[first], 1)[0] == pytest.approx(
        p / R * np.mean(pivots[first]), rel=1e-2
    )
    assert np.abs(pivots[last]).max() < 0.02 * pivots[0]
    assert E[last][0] - E[last][-1] < 1e-4 * E[0]
    assert tilts[last].min() > 0.2
