"""A coin that stays in contact: against closed forms, an independent integration, and what is conserved."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.analytic.air import force
from cointoss.analytic.air.quadrature import CONTACT_NODES
from cointoss.analytic.contact import smooth
from cointoss.analytic.contact.automaton import Event, Mode, flow, margin_event
from cointoss.analytic.contact.floor_force import friction_holds, holding_force, starting_slip
from cointoss.analytic.contact.integrator import contact_work, short_step, step_of_length
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import rim_contact
from cointoss.analytic.contact.sampling import floor_force
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from tests.helpers.contacts import follow_step, held, put_on_floor
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, scenario

SMOOTH = FloorFriction(0.0)
G, R_COIN, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]


def up_of(y):
    return np.array(rotation_matrix(tuple(y[6:10]))[2])


def on_floor(body, mode, angles, w, v=(0.0, 0.0)):
    """Give a coin in contact, of this attitude and spin; `mode` says what its lowest point may do."""
    y = np.array([0, 0, 0, *v, 0, *quaternion_from_angles(angles), *w], dtype=float)
    put_on_floor(body, FloorFriction(0.0), mode, y)
    return y


SLIP_STOPPED = 2 / 3 * 0.3
"""Of a disc put down at 0.3 m/s: v falls by μ g t, ω r rises by 2 μ g t, and both meet after v/(3 μ g)."""


@pytest.mark.parametrize(
    ("coin", "mu", "angles", "w", "speed", "landing", "event", "held_values"),
    [
        pytest.param(
            *(THIN, 0.2, (0.0, np.pi / 2, 0.0), (0.0, 0.0, 0.0), 0.3, Event.NONE, Event.SLIP_STOPS),
            {
                "time": pytest.approx(0.3 / (3 * 0.2 * G), rel=2e-3),
                "v": pytest.approx(SLIP_STOPPED, rel=2e-3),
                "roll": pytest.approx(SLIP_STOPPED / R_COIN, rel=2e-3),
            },
            id="slip stops where friction can hold it",
        ),
        pytest.param(
            *(THIN, 0.0, (0.0, 3.067, 2.019), (-100.5, 39.9, -9.4), 0.0, Event.NONE, Event.LIFTS_OFF),
            {"force": pytest.approx(0, abs=1e-9)},
            id="rising fast from a small tilt a coin leaves the floor",
        ),
        pytest.param(
            *(ZLOTY, 0.0, (0.0, 1.45, 0.0), (6.0, 0.0, 0.0), 0.0, Event.SECOND_RIM_LANDS, Event.SLIDES),
            {"n_z": pytest.approx(0, abs=1e-9)},
            id="tipping over its edge a coin lands on the other rim",
        ),
        pytest.param(
            *(THIN, 0.0, (0.0, 0.4, 0.0), (0.0, 0.0, 0.0), 0.0, Event.FACE_LANDS, Event.SLIDES),
            {"sine": pytest.approx(1e-7, rel=1e-3)},
            id="falling over a coin lands on its face",
        ),
    ],
)
def test_a_contact_ends_as_its_closed_form_says(coin, mu, angles, w, speed, landing, event, held_values):
    body, friction, mode, time = scenario(coin=coin).body, FloorFriction(mu), Mode.SLIDING, 0.0
    y = on_floor(body, mode, angles, w, (speed, 0.0))
    assert floor_force(held(body, friction, mode, y), y)[2] > 0
    step = follow_step(body, friction, mode, y, np.inf)
    while not step.is_over and time < 1:
        time += step.elapsed
        step = follow_step(body, friction, mode, y, step.next_dt)
    contact, up = held(body, friction, mode, y), up_of(y)
    found = {"time": time + step.elapsed, "v": y[3], "roll": abs(y[12]), "n_z": up[2]}
    found |= {"sine": np.hypot(up[0], up[1]), "force": floor_force(contact, y)[2] / (M * G)}
    assert (step.event, margin_event(contact, y)) == (landing, event)
    assert {name: found[name] for name in held_values} == held_values


@pytest.mark.parametrize("air", [{}, AIR])
def test_an_ideal_coin_on_a_smooth_floor_gets_no_spin_about_its_axis(air):
    rng, body, dy = np.random.default_rng(13), scenario(coin=ZLOTY, air=air).body, np.empty(13)
    for _ in range(20):
        y = draw_wobble(rng, body, Mode.SLIDING)
        y[12] = 0.0
        contact = held(body, SMOOTH, Mode.SLIDING, y)
        smooth.project(contact, y)
        flow(contact, y, dy)
        assert y[12] == dy[12] == 0
        assert dy[10:12].any()


def draw_wobble(rng, body, mode):
    """Draw a contact that goes on for a while: a tilted coin that turns moderately."""
    angles = rng.uniform(0, 6), rng.uniform(0.5, 1.2), rng.uniform(0, 6)
    return on_floor(body, mode, angles, rng.uniform(-12, 12, 3), rng.uniform(-0.1, 0.1, 2))


@pytest.mark.parametrize("backward", [1, -1])
def test_a_short_step_errs_by_the_fifth_power_of_its_length(backward):
    """The end of a contact is bracketed by such steps, 1e-2 times as long as the step that passed it."""
    body, errors = scenario(coin=IMPERFECT).body, np.zeros(2)
    for seed in range(10):
        y = draw_wobble(np.random.default_rng([12, seed]), body, Mode.SLIDING)
        contact = held(body, SMOOTH, Mode.SLIDING, y)
        stages = contact_work(contact, y)
        for number, dt in enumerate((1.6e-3, 0.8e-3)):
            by_one, by_two = y.copy(), y.copy()
            step_of_length(contact, y, backward * dt, stages, by_one)
            short_step(contact, y, stages[0], backward * dt, by_two)
            errors[number] += np.abs(by_one - by_two)[10:13].max() / 120
    assert errors[0] == pytest.approx(32 * errors[1], rel=0.05)
    assert errors[1] < 1e-5


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


@pytest.mark.parametrize("mode", [Mode.SLIDING, Mode.STICKING])
def test_in_contact_air_is_integrated_once_a_rate_of_change_and_not_to_put_the_coin_down(mode, monkeypatch):
    given, change_about_B = [], force.change_about_B
    monkeypatch.setattr(force, "change_about_B", lambda *of: given.append(of[2]) or change_about_B(*of))
    body = scenario(coin=ZLOTY, air={**AIR, "exponent": 0.5}).body
    y = on_floor(body, mode, (0.3, 0.2, 0.1), (10.0, 5.0, 2.0), (0.2, 0.1))
    flow(held(body, FloorFriction(0.2), mode, y), y, np.empty(13))
    assert [nodes is CONTACT_NODES for nodes in given] == [True]
