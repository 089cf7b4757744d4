"""A thick coin upright on both rims: what friction does, what presses it, when it tips."""

import numpy as np
import pytest

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.edge.restoring import held_on_edge
from cointoss.analytic.contact.edge.standing import on_edge, rolls, stands
from cointoss.analytic.contact.resets import tip_over
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import both_rims
from cointoss.analytic.contact.upright import rim_forces, start_slow_slip
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import gap
from cointoss.models.laws import EndingTest
from cointoss.models.records import Outcome
from tests.helpers.contacts import follow_for, held, upright_coin
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario

SMOOTH = FloorFriction(0.0)
G, R_COIN, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]


def test_a_still_coin_presses_its_rims_as_the_lever_says():
    body = scenario(coin={**ZLOTY, "center_of_mass": (0.0, 0.0, 2e-4)}).body
    # Tails' rim and heads', whose face is at ζ = h/2 = 1 mm.
    forces = rim_forces(body, SMOOTH, upright_coin(body, 0.4, 0.0, 0.0))
    assert forces == pytest.approx((0.4 * M * G, 0.6 * M * G), rel=1e-12)


def test_a_coin_that_tips_over_keeps_the_pressed_rim_on_the_floor():
    body = scenario(coin=IMPERFECT).body
    for phase in np.linspace(0.1, 6.0, 12):
        y = upright_coin(body, phase, 5.0, 20.0)
        on_tails, on_heads = rim_forces(body, SMOOTH, y)
        tip_over(body, SMOOTH, y)
        up = rotation_matrix(tuple(y[6:10]))[2]
        assert 0 < up[2] * np.sign(on_tails - on_heads) < 2e-12
        assert abs(gap(body, y[2], up)) < 1e-17


def test_a_coin_is_tried_on_either_rim_however_it_leans():
    """Turning tips a rolling coin, or does not: leaning less than `ON_EDGE` must change neither."""
    body, found = scenario(coin=IMPERFECT).body, set()
    for turn in np.linspace(-70.0, 70.0, 29):
        level = upright_coin(body, 0.4, turn, 20.0)
        is_held = held_on_edge(held(body, SMOOTH, Mode.SLIDING, level), level)
        found.add(is_held)
        for lean in (-5e-7, 5e-7):
            leaning = level.copy()
            upright.tilt(leaning, lean)
            assert held_on_edge(held(body, SMOOTH, Mode.SLIDING, leaning), leaning) == is_held
    assert found == {True, False}


@pytest.mark.parametrize("thickness", [2e-3, 8e-3])
@pytest.mark.parametrize(("part", "is_on_it"), [(0.999e-3, True), (1.001e-3, False)])
def test_a_coin_is_on_its_edge_by_parts_of_what_tips_it(thickness, part, is_on_it):
    """Up to a thousandth of h/(2 r), from where its weight no longer turns it back, and of that √(g/r)."""
    body = scenario(coin={**ZLOTY, "thickness": thickness}).body
    level, most = upright_coin(body, 0.4, 3.0, 20.0), part * thickness / (2 * R_COIN)
    assert on_edge(body, level)
    for side in (-1, 1):
        leaning, turning = level.copy(), level.copy()
        upright.tilt(leaning, side * most)
        assert abs(rotation_matrix(tuple(leaning[6:10]))[2][2]) == pytest.approx(most, rel=1e-6)
        up = rotation_matrix(tuple(level[6:10]))[2]
        # The rate of n_z is that at which it turns about the floor's line below it.
        turning[10:12] += side * most * (G / R_COIN) ** 0.5 * np.array([-up[1], up[0]])
        assert on_edge(body, leaning) == on_edge(body, turning) == is_on_it


def test_without_loss_a_coin_stands_if_it_is_held_in_the_course_of_its_own_roll():
    """(N_heads - N_tails) h/2 = m g c_ζ - J_ζ ω_ζ Ω, about C: below m g h/2 both rims are pressed.

    In air the roll slows and may turn back: then the coin is not held.
    """
    coin, half = {**ZLOTY, "center_of_mass": (0.0, 0.0, 4e-4)}, ZLOTY["thickness"] / 2
    vacuum, in_air = scenario(coin=coin).body, scenario(coin=coin, air=AIR).body
    roll = 0.8 * M * G * half / (vacuum.inertia[2][2] * 20.0)
    for turn, held_now in ((20.0, True), (-20.0, False)):
        difference = M * G * 4e-4 - vacuum.inertia[2][2] * roll * turn
        assert (abs(difference) < M * G * half) == held_now
        y = upright_coin(vacuum, 0.4, turn, roll)
        N_tails, N_heads = rim_forces(vacuum, SMOOTH, y)
        assert (N_heads - N_tails) * half == pytest.approx(difference, rel=1e-9)
        assert stands(held(vacuum, SMOOTH, Mode.SLIDING, y), y) == held_now
        assert not stands(held(in_air, SMOOTH, Mode.SLIDING, y), y)


def rolling(body, roll_rate):
    """Give a coin upright on the floor that rolls straight on [rad/s]."""
    y = upright_coin(body, 0.4, 0.0, roll_rate)
    R = np.array(rotation_matrix(tuple(y[6:10])))
    y[3:5] = -np.cross(R @ y[10:13], lowest_arm(body, R))[:2]
    return y


def lowest_arm(body, R):
    """Give the point of the floor below an upright coin, seen from C, space frame, (3,)."""
    return np.array([0, 0, -R_COIN]) - R @ np.array(body.center)


def test_a_coin_that_slides_upright_ends_rolling_at_two_thirds_of_its_speed():
    """Angular momentum about a point of the floor: m v₀ r = m v r + (m r²/2) v/r."""
    body, mu = scenario(coin=ZLOTY).body, 0.3
    y = upright_coin(body, 0.4, 0.0, 0.0)
    n = np.array(rotation_matrix(tuple(y[6:10])))[:, 2]
    along = np.cross([0, 0, 1], n)
    y[3:6] = 0.5 * along
    assert not rolls(body, FloorFriction(mu), y)
    states, _ = follow_for(body, FloorFriction(mu), Mode.UPRIGHT, y, 2 * 0.5 / (mu * G))
    assert states[-1][3:6] == pytest.approx(0.5 * 2 / 3 * along, abs=1e-6)
    assert rolls(body, FloorFriction(mu), states[-1])
    assert stands(held(body, FloorFriction(mu), Mode.STICKING, states[-1]), states[-1])


@pytest.mark.parametrize(
    ("roll_rate", "mu", "is_held"), [(12.0, 0.5, True), (12.0, 0.01, False), (100.0, 0.5, False)]
)
def test_a_rolling_coin_stands_unless_it_skids_or_its_roll_tips_it(roll_rate, mu, is_held):
    body = scenario(coin=IMPERFECT).body
    y = rolling(body, roll_rate)
    assert stands(held(body, FloorFriction(mu), Mode.STICKING, y), y) == is_held


@pytest.mark.parametrize("number", [5496, 6096, 4614, 7739])
def test_a_toss_that_comes_upright_on_a_rough_floor_is_followed_to_its_end(number):
    """Tosses of the study of endings in which the coin skids or rolls on both rims for a while."""
    case = draw_toss(np.random.default_rng((2008, 1, number)), imperfect=True)
    tossed = run(case.body, case.rules._replace(test=EndingTest.LYING), state_at_release(case.release))
    assert Mode.UPRIGHT in tossed.started.modes
    assert tossed.outcome != Outcome.UNDECIDED


def pivoting(body, turn_rate, rim):
    """Give a coin upright on the floor that turns about the lowest point of one rim [rad/s]."""
    y = upright_coin(body, 0.4, turn_rate, 0.0)
    y[3:5] -= rim_velocity(body, y, rim)[:2]
    return y


def rims_of(body, y, rim):
    """Give the `RimContact` of a rim and that of the other."""
    tails, heads = both_rims(body, SMOOTH, y)
    return (tails, heads) if rim < 0 else (heads, tails)


def rim_velocity(body, y, rim):
    """Give the velocity of the lowest point of a rim, space frame, (3,)."""
    return np.array(rims_of(body, y, rim)[0].velocity)


def holding_force_of_the_rim_that_stuck(body, mu, rim, y):
    """Solve for the force at its lowest point, (3,), and the normal force at the other.

    The other rim skids, with friction μ N against its slip, less where that is slow.
    """
    held, other = rims_of(body, y, rim)
    R, arm, b = held.R, held.arm, held.free_acceleration
    other_arm, other_b, other_slip = other.arm, other.free_acceleration, other.velocity
    J = np.array(R) @ np.array(body.inertia) @ np.array(R).T
    speed = max(np.hypot(*other_slip[:2]), SLOW * max(mu, 1) * (G * R_COIN) ** 0.5)
    direction = np.append(-mu * np.array(other_slip[:2]) / speed, 1.0)

    def gained(force, at, seen_at):
        return force / body.mass + np.cross(np.linalg.solve(J, np.cross(at, force)), seen_at)

    forces = [(unit, arm) for unit in np.eye(3)] + [(direction, other_arm)]
    A = np.array([[*gained(f, at, arm), gained(f, at, other_arm)[2]] for f, at in forces]).T
    return np.linalg.solve(A, [*(-np.array(b)), -other_b[2]])[:3]


@pytest.mark.parametrize(("rim", "mu", "turn_rate"), [(-1.0, 0.3, 5.0), (1.0, 2.0, 5.0), (-1.0, 1e4, -5.0)])
def test_a_rim_that_stuck_takes_the_slow_slip_at_which_friction_holds_it(rim, mu, turn_rate):
    """When the other, which skids round it, lands: its slip hardly changes."""
    body = scenario(coin=IMPERFECT).body
    y = pivoting(body, turn_rate, rim)
    start = y.copy()
    start_slow_slip(held(body, FloorFriction(mu), Mode.STICKING, y)._replace(rim=rim), y)
    F = holding_force_of_the_rim_that_stuck(body, mu, rim, start)
    slip = -F[:2] / (mu * F[2]) * SLOW * max(mu, 1) * (G * R_COIN) ** 0.5
    assert np.hypot(*F[:2]) > 1e-2 * F[2]
    assert rim_velocity(body, y, rim)[:2] == pytest.approx(slip, rel=1e-9)
    assert [rim_velocity(body, y, s)[2] for s in (1.0, -1.0)] == pytest.approx([0, 0], abs=1e-17)


def test_a_rim_that_friction_cannot_hold_takes_no_slip():
    body = scenario(coin=IMPERFECT).body
    y = pivoting(body, 30.0, -1.0)
    before = y.copy()
    start_slow_slip(held(body, FloorFriction(1e-3), Mode.STICKING, y)._replace(rim=-1.0), y)
    assert np.all(y == before)
