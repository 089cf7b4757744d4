"""Resistance to rolling and pivoting: closed forms, rest, and Euler's disk; its power is in test_power.py."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import lower_rim_of
from cointoss.analytic.contact.resistance import FloorFriction, moment_per_force
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.contact.rim_contact import both_rims, rim_contact
from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR, SLOW
from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.certificate import CONTACT_ENERGY, turned
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import eulers_disk, follow_for, held, put_on_floor, set_upright, tilts_of
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import IMPERFECT, THIN, ZLOTY, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
UNIT = (G / R) ** 0.5
HOOP = {**THIN, "inertia": np.diag([0.5, 0.5, 1.0]) * M * R * R}


def rolling_state(body, speed):
    """Return the state of a coin that rolls straight on along x."""
    y = set_upright(THIN, speed, (0.0, 0.0, speed / R))
    A = rim_contact(body, y, -1.0)
    if abs(A.velocity[0]) > 1e-9:
        y[12] *= -1
    return y


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
        body, FloorFriction(50.0, 0.0, p), Mode.STICKING, set_upright(spin=(0.0, spin, 0.0)), time
    )
    assert states[:, 11] == pytest.approx(spin - slowing * times, rel=1e-9)
    _, kept = follow_for(
        body, FloorFriction(50.0, 1e-3), Mode.STICKING, set_upright(spin=(0.0, spin, 0.0)), 0.1
    )
    assert kept[-1] == pytest.approx(0.1)


def test_slow_motion_is_resisted_in_proportion_to_it():
    body, friction = scenario().body, FloorFriction(0.0, 2e-4, 3e-4)
    slow = SLOW * UNIT
    fast = moment_per_force(body, friction, (0.0, 0.0, 1.0), (3.0, -4.0, 5.0))
    assert fast == pytest.approx((-1.2e-4, 1.6e-4, -3e-4), rel=1e-14)
    half = moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, slow / 2, -slow / 4))
    assert half == pytest.approx((0.0, -1e-4, 0.75e-4), rel=1e-14)
    assert moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def test_without_resistance_nothing_is_added():
    body, y = scenario().body, set_upright(spin=(1.0, 2.0, 3.0))
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
    y = set_upright()
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


def fall(friction, time, least=0.0):
    """Return times, tilts, energies in m g r and ω_z of Euler's disk, until a time or a tilt."""
    body = scenario(coin=THIN).body
    y, times = follow_for(
        body, friction, Mode.STICKING, eulers_disk(0.3), time, least=least, error=CONTACT_STEP_ERROR
    )
    turning = np.sum(y[:, 10:13] ** 2 @ np.array(body.inertia), axis=1) / 2
    energies = (M * (np.sum(y[:, 3:6] ** 2, axis=1) / 2 + G * y[:, 2]) + turning) / (M * G * R)
    return times, tilts_of(y), energies, turned(y[:, 6:10], y[:, 10:13])[:, 2]


def test_eulers_disk_falls_flat_as_the_square_of_the_time_left_under_resistance_to_rolling():
    """E = 3/2 m g r sin α and |ω_h| = Ω sin α cos α with Ω² sin α = 4 g/r.

    So dα/dt = -(4/3) √(g/r) (δ/r) √α, and √α falls steadily.
    """
    delta, start = 2e-5, eulers_disk(0.3)
    slip = rim_contact(scenario(coin=THIN).body, start, lower_rim_of(start)).velocity
    assert np.allclose(slip, 0, atol=1e-12)
    times, tilts, _, _ = fall(FloorFriction(50.0, delta), 30.0, 1e-4)
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
    p = 1e-4
    times, tilts, E, pivots = fall(FloorFriction(50.0, 0.0, p), 3.0)
    first, last = times < 0.1, times > 2.5
    assert E[0] == pytest.approx(1.5 * np.sin(0.3), rel=1e-3)
    assert -np.polyfit(times[first], E[first], 1)[0] == pytest.approx(
        p / R * np.mean(pivots[first]), rel=1e-2
    )
    assert np.abs(pivots[last]).max() < 0.02 * pivots[0]
    assert E[last][0] - E[last][-1] < 1e-4 * E[0]
    assert tilts[last].min() > 0.2
