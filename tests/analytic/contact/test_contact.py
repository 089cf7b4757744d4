"""A coin that stays in contact: against closed forms, an independent integration, and what is conserved."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.analytic.contact import sliding, smooth
from cointoss.analytic.contact.automaton import Event, Mode, flow, margin_event
from cointoss.analytic.contact.edge.restoring import held_on_edge
from cointoss.analytic.contact.edge.standing import stands
from cointoss.analytic.contact.floor_force import friction_holds, holding_force, slip_direction, starting_slip
from cointoss.analytic.contact.integrator import contact_work, short_step, step_of_length
from cointoss.analytic.contact.landing import time_to_landing
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import rim_contact
from cointoss.analytic.contact.sampling import floor_force, sample_contact
from cointoss.analytic.numerics.tolerances import STEP_ERROR
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.barriers import energy
from cointoss.models.geometry import contact_velocity, lowest_point
from cointoss.models.kernel.compiled import by_numba
from tests.helpers.contacts import end_mode, follow_for, follow_step, held, put_on_floor
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, draw_coin, scenario

sample_contact = by_numba(sample_contact)

SMOOTH = FloorFriction(0.0)
G, R_COIN, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]


def up_of(y):
    return np.array(rotation_matrix(tuple(y[6:10]))[2])


def energy_of(body, y):
    return energy(body, y[2], tuple(y[3:6]), tuple(y[10:13]))


def velocity_of_lowest(body, y):
    """By `cointoss.models.geometry`, which flight and impact use."""
    R = rotation_matrix(tuple(y[6:10]))
    point, _ = lowest_point(body, R[2], tuple(y[10:13]))
    return np.array(contact_velocity(body, R, tuple(y[3:6]), tuple(y[10:13]), point))


def on_floor(body, mode, angles, w, v=(0.0, 0.0)):
    """Give a coin in contact, of this attitude and spin; `mode` says what its lowest point may do."""
    y = np.array([0, 0, 0, *v, 0, *quaternion_from_angles(angles), *w], dtype=float)
    put_on_floor(body, FloorFriction(0.0), mode, y)
    return y


def follow_to_its_end(body, friction, mode, y):
    """Advance y to the end of a contact that ends within a second; return what lands and the time."""
    time, dt, over, landing = 0.0, np.inf, False, Event.NONE
    while not over:
        step = follow_step(body, friction, mode, y, dt)
        time += step.elapsed
        dt, over, landing = step.next_dt, step.is_over, step.event
        assert time < 1
    return landing, time


def draw_wobble(rng, body, mode):
    """Draw a contact that goes on for a while: a tilted coin that turns moderately."""
    angles = rng.uniform(0, 6), rng.uniform(0.5, 1.2), rng.uniform(0, 6)
    return on_floor(body, mode, angles, rng.uniform(-12, 12, 3), rng.uniform(-0.1, 0.1, 2))


@pytest.mark.parametrize("backward", [1, -1])
def test_a_short_step_errs_by_the_fifth_power_of_its_length(backward):
    """The end of a contact is bracketed by such steps, 1e-2 times as long as the step that passed it."""
    rng, errors = np.random.default_rng(12), []
    body = scenario(coin=IMPERFECT).body
    for dt in (1.6e-3, 0.8e-3):
        error = 0.0
        for _ in range(10):
            y = draw_wobble(rng, body, Mode.SLIDING)
            contact, by_one, by_two = held(body, SMOOTH, Mode.SLIDING, y), y.copy(), y.copy()
            stages = contact_work(contact, y)
            step_of_length(contact, y, backward * dt, stages, by_one)
            short_step(contact, y, stages[0], backward * dt, by_two)
            error += np.abs(by_one - by_two)[10:13].max() / 12
        errors.append(error / 10)
        rng = np.random.default_rng(12)
    assert errors[0] == pytest.approx(32 * errors[1], rel=0.05)
    assert errors[1] < 1e-5


@pytest.mark.parametrize("seed", range(8))
def test_a_smooth_floor_is_one_whose_friction_is_0(seed):
    """Its normal force is found by itself, by fewer sums."""
    rng = np.random.default_rng([seed, 7])
    coin = {**draw_coin(rng), **({"thickness": 0.0, "center_of_mass": (1e-3, 2e-3, 0)} if seed % 2 else {})}
    body = scenario(coin=coin, air=AIR).body
    y = draw_wobble(rng, body, Mode.SLIDING)
    y[3:6] += rng.uniform(-1, 1, 3)
    dy, dy_general, contact = np.empty(13), np.empty(13), held(body, SMOOTH, Mode.SLIDING, y)
    left = smooth.flow(contact, y, dy)
    assert left == pytest.approx(sliding.flow_with_friction(contact, y, dy_general), rel=1e-12)
    assert dy == pytest.approx(dy_general, rel=1e-12, abs=1e-12)
    stopped = y.copy()
    smooth.project(contact, stopped)
    sliding.project_with_friction(contact, y)
    assert stopped == pytest.approx(y, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("air", [{}, AIR])
def test_an_ideal_coin_on_a_smooth_floor_gets_no_spin_about_its_axis(air):
    rng, body = np.random.default_rng(13), scenario(coin=ZLOTY, air=air).body
    for _ in range(20):
        y = draw_wobble(rng, body, Mode.SLIDING)
        y[12] = 0.0
        smooth.project(held(body, SMOOTH, Mode.SLIDING, y), y)
        for _ in range(10):
            follow_step(body, SMOOTH, Mode.SLIDING, y, 1e-3)
            assert y[12] == 0
            assert y[10:12].any()


@pytest.mark.parametrize("mode", [Mode.SLIDING, Mode.STICKING])
@pytest.mark.parametrize("tilt", [0.3, 1.0, 1.3])
def test_eulers_disk_precesses_at_its_rate(mode, tilt):
    """Ω² = 4 g/(r sin s) for a thin disk that rolls with C at rest: a state of the smooth floor too."""
    body = scenario(coin=THIN).body
    rate = np.sqrt(4 * G / (R_COIN * np.sin(tilt)))
    # Upright in the coin's plane the spin is Ω sin s, along the normal none; φ = 0 puts that axis along η.
    y = on_floor(body, mode, (0.2, tilt, 0.0), (0.0, rate * np.sin(tilt), 0.0))
    assert y[3:6] == pytest.approx(0, abs=1e-15)
    mu = 0.0 if mode == Mode.SLIDING else 0.5
    assert floor_force(held(body, FloorFriction(mu), mode, y), y) == pytest.approx([0, 0, M * G], abs=1e-14)
    states, times = follow_for(body, FloorFriction(mu), mode, y, 30 / rate)
    assert np.array([up_of(s)[2] for s in states]) == pytest.approx(np.cos(tilt), abs=1e-9)
    R = np.array(rotation_matrix(tuple(states[-1][6:10])))
    turned = np.arctan2(R[0, 2], -R[1, 2])
    assert np.angle(np.exp(1j * (turned - 0.2 - rate * times[-1]))) == pytest.approx(0, abs=1e-7)


def rolling_rates(_, q, body):
    """Give the rates of a thin disk that rolls: tilt s, ω along the horizontal diameter, upward in the plane,
    and along the normal; from the balance about C in the frame of these axes, with v_C = ω × r e2."""
    s, w1, w2, w3 = q
    J, J3, r, m = body.inertia[0][0], body.inertia[2][2], body.radius, body.mass
    precession = w2 / np.tan(s)
    a1 = -r * (m * r * w2 * w3 + m * G * np.cos(s)) - w2 * J3 * w3 + precession * J * w2
    return [
        w1,
        a1 / (J + m * r * r),
        (w1 * J3 * w3 - precession * J * w1) / J,
        m * r * r * w1 * w2 / (J3 + m * r * r),
    ]


@pytest.mark.parametrize("seed", range(4))
def test_a_rolling_disk_moves_as_its_own_equations_say(seed):
    rng = np.random.default_rng([seed, 2])
    body = scenario(coin=THIN).body
    tilt, w = rng.uniform(0.6, 1.3), rng.uniform(-15, 15, 3)
    y = on_floor(body, Mode.STICKING, (0.0, tilt, 0.0), w)
    time = 0.05
    states, _ = follow_for(body, FloorFriction(50.0), Mode.STICKING, y, time)
    # With ψ = φ = 0 the axes ξ, η, ζ are those of the frame at the start.
    expected = solve_ivp(
        rolling_rates, (0, time), [tilt, *y[10:13]], args=(body,), rtol=1e-11, atol=1e-11, method="DOP853"
    ).y[:, -1]
    end = states[-1]
    up = up_of(end)
    assert np.arccos(up[2]) == pytest.approx(expected[0], abs=1e-8)
    assert end[12] == pytest.approx(expected[3], rel=1e-8)
    upward = np.array([up[0], up[1], 0]) / np.hypot(up[0], up[1])
    assert end[10:13] @ upward == pytest.approx(expected[2], rel=1e-8, abs=1e-7)
    assert abs(expected[0] - tilt) > 0.01


@pytest.mark.parametrize("seed", range(6))
def test_a_coin_that_rolls_keeps_its_energy(seed):
    rng = np.random.default_rng([seed, 3])
    body = scenario(coin=draw_coin(rng)).body
    start = draw_wobble(rng, body, Mode.STICKING)
    y, time = start.copy(), 0.0
    while time < 0.1:
        step = follow_step(body, FloorFriction(100.0), Mode.STICKING, y, 0.1 - time)
        time += step.elapsed
        assert np.abs(velocity_of_lowest(body, y)).max() < 1e-12
        if step.is_over:
            break
    assert time > 0.01
    assert energy_of(body, y) == pytest.approx(energy_of(body, start), rel=1e-11)


@pytest.mark.parametrize("seed", range(20))
def test_slip_that_starts_keeps_the_direction_to_which_friction_turns_all_slip(seed):
    """A slip too small to move the coin, in any direction, turns into the one of `starting_slip`."""
    rng = np.random.default_rng([seed, 5])
    A = rng.normal(size=(3, 3))
    K = A @ A.T + 2 * np.eye(3)
    b = np.array([*rng.normal(size=2) * 4, -rng.uniform(0.5, 2)])
    mu = rng.uniform(0.05, 0.4)
    rows: Any = tuple(map(tuple, K))
    if friction_holds(mu, holding_force(rows, tuple(b))):
        b[:2] *= 20
    assert not friction_holds(mu, holding_force(rows, tuple(b)))
    s = np.array(starting_slip(rows, tuple(b), mu))

    def rate(_, v):
        direction = np.array([*(-mu * v / np.linalg.norm(v)), 1.0])
        N = -b[2] / (K[2] @ direction)
        return (b + N * K @ direction)[:2]

    grown = rate(0, s)
    assert np.cross([*s, 0], [*grown, 0])[2] == pytest.approx(0, abs=1e-12 * float(np.linalg.norm(b)))
    assert grown @ s > 0
    for angle in np.linspace(0, 6, 5):
        v = 1e-6 * np.array([np.cos(angle), np.sin(angle)])
        end = solve_ivp(rate, (0, 0.1), v, method="LSODA", rtol=1e-9, atol=1e-12).y[:, -1]
        assert end / np.linalg.norm(end) == pytest.approx(s, abs=1e-3)


def test_friction_holds_just_within_the_cone():
    body = scenario(coin=THIN).body
    y = on_floor(body, Mode.STICKING, (0.0, 1.0, 0.0), (1.0, 2.0, 3.0))
    F = floor_force(held(body, SMOOTH, Mode.STICKING, y), y)
    needed = np.hypot(F[0], F[1]) / F[2]
    assert 0.1 < needed < 2
    assert end_mode(body, FloorFriction(1.001 * needed), Mode.TOUCHING, y.copy()) == Event.SLIP_STOPS
    slipping, friction = y.copy(), FloorFriction(0.999 * needed)
    assert end_mode(body, friction, Mode.TOUCHING, slipping) == Event.SLIP_STARTS
    step = follow_step(body, friction, Mode.INCIPIENT_SLIP, slipping, 1e-3)
    assert (step.elapsed, step.is_over) == (1e-3, False)
    slip = velocity_of_lowest(body, slipping)
    assert 0 < np.hypot(slip[0], slip[1])
    assert slip[:2] @ F[:2] < 0, "slip starts against the force that would hold it"


def test_slip_stops_where_friction_can_hold_it():
    """A disk put down upright with a slip along its plane: μ m g stops the slip and lets it roll."""
    mu, body = 0.2, scenario(coin=THIN).body
    y = on_floor(body, Mode.SLIDING, (0.0, np.pi / 2, 0.0), (0.0, 0.0, 0.0), (0.3, 0.0))
    _, time = follow_to_its_end(body, FloorFriction(mu), Mode.SLIDING, y)
    # v falls by μ g t, and ω r rises by 2 μ g t: the slip v - ω r ends after v/(3 μ g), up to creep.
    assert time == pytest.approx(0.3 / (3 * mu * G), rel=2e-3)
    assert end_mode(body, FloorFriction(mu), Mode.SLIDING, y) == Event.SLIP_STOPS
    assert y[3] == pytest.approx(0.2, rel=2e-3)
    assert abs(y[12]) == pytest.approx(0.2 / R_COIN, rel=2e-3)
    assert velocity_of_lowest(body, y) == pytest.approx(0, abs=1e-13)


@pytest.mark.parametrize(
    ("mode", "slip", "expected"),
    [
        (Mode.SLIDING, 0.5, Event.SLIP_STOPS),
        (Mode.SLIDING, 0.6, Event.SLIDES),
        (Mode.INCIPIENT_SLIP, 1.0, Event.SLIDES),
        (Mode.INCIPIENT_SLIP, 0.9, Event.SLIP_STOPS),
    ],
)
@pytest.mark.parametrize("rounding", [-1e-12, 1e-12])
def test_a_mode_that_ends_at_its_bound_of_slip_does_not_go_on_for_rounding(mode, slip, expected, rounding):
    """An upright disk that slips along its plane: slip in 1e-3 √(g r); it would stop where friction holds."""
    body = scenario(coin=THIN).body
    speed = slip * (1 + rounding) * 1e-3 * np.sqrt(G * R_COIN)
    y = on_floor(body, Mode.SLIDING, (0.0, np.pi / 2, 0.0), (0.0, 0.0, 0.0), (speed, 0.0))
    assert margin_event(held(body, FloorFriction(0.2), mode, y), y) == expected


def test_a_coin_leaves_the_floor_when_it_would_have_to_be_held_back():
    """It rises fast from a small tilt: the force falls to zero, and the gap opens from there."""
    body = scenario(coin=THIN).body
    y = on_floor(body, Mode.SLIDING, (0.0, 3.067, 2.019), (-100.5, 39.9, -9.4))
    assert floor_force(held(body, SMOOTH, Mode.SLIDING, y), y)[2] > 0
    landing, _ = follow_to_its_end(body, SMOOTH, Mode.SLIDING, y)
    assert landing == Event.NONE
    assert floor_force(held(body, SMOOTH, Mode.SLIDING, y), y)[2] == pytest.approx(0, abs=1e-9 * M * G)
    assert margin_event(held(body, SMOOTH, Mode.SLIDING, y), y) == Event.LIFTS_OFF


def test_friction_does_not_press_down_a_point_that_free_flight_lifts():
    """Painlevé: on a floor rough enough incipient slip would have a second answer: to be pressed."""
    rng, body, mu = np.random.default_rng(3), scenario(coin=IMPERFECT).body, 1e4
    lifted = pressed = 0
    for _ in range(500):
        angles = rng.uniform(0, 6), rng.uniform(0.3, 1.5), rng.uniform(0, 6)
        y = on_floor(body, Mode.STICKING, angles, rng.uniform(-1, 1, 3) * [20, 20, 300])
        contact = held(body, FloorFriction(mu), Mode.INCIPIENT_SLIP, y)
        if rim_contact(body, y, contact.rim).free_acceleration[2] > 0:
            lifted += 1
            pressed += floor_force(contact, y)[2] > 0
            assert flow(contact, y, np.empty(13)) <= 0
            assert margin_event(contact, y) == Event.LIFTS_OFF
    assert lifted > 100
    assert pressed > 10


def test_a_coin_that_tips_over_its_edge_lands_on_the_other_rim():
    body = scenario().body
    y = on_floor(body, Mode.SLIDING, (0.0, 1.45, 0.0), (6.0, 0.0, 0.0))
    landing, _ = follow_to_its_end(body, SMOOTH, Mode.SLIDING, y)
    assert landing == Event.SECOND_RIM_LANDS
    assert 0 <= up_of(y)[2] < 1e-9
    other = y.copy()
    other[6:10] = quaternion_from_angles((0.0, np.pi / 2 + 1e-6, 0.0))
    assert velocity_of_lowest(body, other)[2] < -1e-3, "the other rim comes down"


def test_a_coin_that_falls_over_lands_on_its_face():
    body = scenario(coin=THIN).body
    y = on_floor(body, Mode.SLIDING, (0.0, 0.4, 0.0), (0.0, 0.0, 30.0))
    y[10] = y[11] = 0.0
    y[12] = 0.0
    landing, _ = follow_to_its_end(body, SMOOTH, Mode.SLIDING, y)
    assert landing == Event.FACE_LANDS
    up = up_of(y)
    assert np.hypot(up[0], up[1]) == pytest.approx(1e-7, rel=1e-3)


@pytest.mark.parametrize(("spins", "steady"), [((0, 0), True), ((20, 5), True), ((60, 60), False)])
def test_a_coin_stands_on_its_edge_while_it_does_not_turn_and_roll_too_fast(spins, steady):
    """Turning about the vertical at Ω it takes the moment J_ζ ω_ζ Ω to roll: the edge has m g h/2."""
    body = scenario().body
    spin, roll = spins
    y = on_floor(body, Mode.SLIDING, (0.0, np.pi / 2, 0.0), (0.0, spin, roll))
    assert (body.inertia[2][2] * spin * roll < M * G * body.thickness / 2) == steady
    assert stands(held(body, SMOOTH, Mode.SLIDING, y), y) == steady


def test_an_unbalanced_coin_that_spins_upright_is_not_said_to_stand():
    """It is held in this phase; as it rolls on, the moment of its spin about the vertical would tip it."""
    body = scenario(coin=IMPERFECT).body
    # C is level with B: it will swing down.
    spinning, still = (
        on_floor(body, Mode.SLIDING, (0.0, np.pi / 2, 3 * np.pi / 4), (s, -s, 0.0)) for s in (42.0, 0.0)
    )
    assert held_on_edge(held(body, SMOOTH, Mode.SLIDING, spinning), spinning)
    assert not stands(held(body, SMOOTH, Mode.SLIDING, spinning), spinning)
    assert stands(held(body, SMOOTH, Mode.SLIDING, still), still)


@pytest.mark.parametrize("mode", [Mode.SLIDING, Mode.STICKING])
def test_a_sampled_state_does_not_hang_on_the_other_times_asked_for(mode):
    body = scenario(coin=THIN).body
    y = on_floor(body, mode, (0.0, 1.0, 0.0), (3.0, 20.0, 3.0))
    mu, end = 0.0 if mode == Mode.SLIDING else 50.0, 2.0
    states, times = follow_for(body, FloorFriction(mu), mode, y, end)
    alone, among = np.empty((1, 13)), np.empty((301, 13))
    contact = held(body, FloorFriction(mu), mode, y)
    sample_contact(contact, y, 0.0, times[-2:-1], STEP_ERROR, alone)
    assert alone[0] == pytest.approx(states[-2], abs=1e-10)
    asked = np.append(np.linspace(0, times[-2], 301)[:-1], times[-2])
    sample_contact(contact, y, 0.0, asked, STEP_ERROR, among)
    assert np.array_equal(among[-1], alone[0])


def test_air_slows_a_wobbling_coin():
    body = scenario(coin=THIN, air=AIR).body
    y = on_floor(body, Mode.SLIDING, (0.0, 1.0, 0.0), (3.0, 20.0, 3.0))
    states, _ = follow_for(body, SMOOTH, Mode.SLIDING, y, 0.1)
    assert np.all(np.diff(np.array([energy_of(body, s) for s in states])) < 0)


def test_the_direction_of_no_slip_is_none():
    assert slip_direction((0.0, 0.0, 1.0), 0.3) == (0.0, 0.0)
    assert slip_direction((3.0, 4.0, 1.0), 0.0) == (0.0, 0.0)
    assert slip_direction((3.0, 4.0, 1.0), 0.3) == pytest.approx((0.6, 0.8))


@pytest.mark.parametrize("turning", [-0.3, 0.3])
def test_the_landing_ahead_is_where_the_other_rim_lands(turning):
    body, angle = scenario(coin=IMPERFECT).body, 0.01
    y = on_floor(body, Mode.SLIDING.value, (0.0, np.pi / 2 - angle, 0.0), (turning, 0.0, 0.0))
    contact, dy, at_landing = held(body, SMOOTH, Mode.SLIDING, y), np.empty(13), np.empty((1, 13))
    flow(contact, y, dy)
    ahead = time_to_landing(contact, y, dy)
    sample_contact(contact, y, 0.0, np.array([ahead]), 1e-12, at_landing)
    assert abs(up_of(at_landing[0])[2]) < angle / 20
    assert abs(up_of(y)[2]) > 0.99 * angle
    assert time_to_landing(contact._replace(body=scenario(coin=THIN).body), y, dy) == np.inf
