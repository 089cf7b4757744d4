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
from tests.helpers.contacts import held, upright_coin
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario

SMOOTH = FloorFriction(0.0)
G, R_COIN, H = 9.81, ZLOTY["radius"], ZLOTY["thickness"]
MOST = G * H / R_COIN**2
"""The Ω ω_ζ of which J_ζ ω_ζ Ω is m g h/2, the moment about ζ that the edge has [1/s²]."""
HIGH = {"coin": {**ZLOTY, "center_of_mass": (0.0, 0.0, 0.4 * H / 2)}}
TURN = 20.0


def on_rims(body, turn_rate, roll_rate, rim):
    """Give a coin upright on the floor of which the lowest point of one rim does not slip [rad/s]."""
    y = upright_coin(body, 0.4, turn_rate, roll_rate)
    y[3:5] -= rims_of(body, y, rim)[0].velocity[:2]
    return y


def rims_of(body, y, rim):
    """Give the `RimContact` of a rim and that of the other."""
    return both_rims(body, SMOOTH, y)[:: -int(rim)]


@pytest.mark.parametrize(
    ("parts", "phase", "turn", "roll", "held_now", "steady"),
    [
        ({}, 0.0, 0.0, 0.0, True, True),
        *(
            ({}, 0.4, turn, part * MOST / TURN, abs(part) < 1, abs(part) < 1)
            for turn in (TURN, -TURN)
            for part in (0.999, 1.001, -0.999, -1.001)
        ),
        # C is off by c: (N_heads - N_tails) h/2 = m g c - J_ζ ω_ζ Ω.
        *((HIGH, 0.4, TURN, part * MOST / TURN, True, True) for part in (1.399, -0.599)),
        *((HIGH, 0.4, TURN, part * MOST / TURN, False, False) for part in (1.401, -0.601)),
        # In air the roll slows and may turn back.
        ({**HIGH, "air": AIR}, 0.4, TURN, 0.8 * MOST / TURN, True, False),
        # C is level with B: as it swings down and the coin rolls on, its spin would tip it.
        ({"coin": IMPERFECT}, 3 * np.pi / 4, 42.0 * 2**0.5, 0.0, True, False),
        ({"coin": IMPERFECT}, 3 * np.pi / 4, 0.0, 0.0, True, True),
    ],
)
def test_a_coin_stands_on_its_edge_while_it_does_not_turn_and_roll_too_fast(
    parts, phase, turn, roll, held_now, steady
):
    """Turning about the vertical at Ω it takes the moment J_ζ ω_ζ Ω to roll, however little it leans."""
    body = scenario(**parts).body
    y = upright_coin(body, phase, turn, roll)
    assert stands(held(body, SMOOTH, Mode.SLIDING, y), y) == steady
    for lean in (0.0, -5e-7, 5e-7):
        leaning = y.copy()
        upright.tilt(leaning, lean)
        assert held_on_edge(held(body, SMOOTH, Mode.SLIDING, leaning), leaning) == held_now


def test_a_coin_that_tips_over_keeps_the_pressed_rim_on_the_floor():
    body = scenario(coin=IMPERFECT).body
    for phase in np.linspace(0.1, 6.0, 12):
        y = upright_coin(body, phase, 5.0, 20.0)
        on_tails, on_heads = rim_forces(body, SMOOTH, y)
        tip_over(body, SMOOTH, y)
        up = rotation_matrix(tuple(y[6:10]))[2]
        assert 0 < up[2] * np.sign(on_tails - on_heads) < 2e-12
        assert abs(gap(body, y[2], up)) < 1e-17


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


@pytest.mark.parametrize("number", [5496, 6096, 4614, 7739])
def test_a_toss_that_comes_upright_on_a_rough_floor_is_followed_to_its_end(number):
    """Tosses of the study of endings in which the coin skids or rolls on both rims for a while."""
    case = draw_toss(np.random.default_rng((2008, 1, number)), imperfect=True)
    tossed = run(case.body, case.rules._replace(test=EndingTest.LYING), state_at_release(case.release))
    assert Mode.UPRIGHT in tossed.started.modes
    assert tossed.outcome != Outcome.UNDECIDED


@pytest.mark.parametrize(
    ("roll_rate", "mu", "is_held"), [(12.0, 0.5, True), (12.0, 0.01, False), (100.0, 0.5, False)]
)
def test_a_rolling_coin_stands_unless_it_skids_or_its_roll_tips_it(roll_rate, mu, is_held):
    body, friction = scenario(coin=IMPERFECT).body, FloorFriction(mu)
    y = on_rims(body, 0.0, roll_rate, 1.0)
    assert stands(held(body, friction, Mode.STICKING, y), y) == is_held
    assert rolls(body, friction, y)
    y[3] += 1.1 * SLOW * (G * R_COIN) ** 0.5
    assert not rolls(body, friction, y)


def wrench(force, arm):
    """Give a force at a point, and its moment about C, (6,)."""
    return [*force, *np.cross(arm, force)]


@pytest.mark.parametrize(
    ("rim", "mu", "turn_rate", "is_held"),
    [(-1.0, 0.3, 5.0, True), (1.0, 2.0, 5.0, True), (-1.0, 1e4, -5.0, True), (-1.0, 1e-3, 30.0, False)],
)
def test_a_rim_that_stuck_takes_the_slow_slip_at_which_friction_holds_it_or_none(rim, mu, turn_rate, is_held):
    """When the other lands, whose friction is μ N against its slip: D v/dt = 0, of the other the vertical."""
    body = scenario(coin=IMPERFECT).body
    y = on_rims(body, turn_rate, 0.0, rim)
    stuck, other = rims_of(body, y, rim)
    R, slow = np.array(stuck.R), SLOW * max(mu, 1) * (G * R_COIN) ** 0.5
    skids = -mu * np.array(other.velocity) / max(np.hypot(*other.velocity[:2]), slow) + [0, 0, 1]
    stopped = [*(wrench(unit, stuck.arm) for unit in np.eye(3)), wrench([0, 0, 1], other.arm)]
    none = np.zeros((3, 3))
    M = np.block([[body.mass * np.eye(3), none], [none, R @ body.inertia @ R.T]])
    gained = np.linalg.solve(M, np.transpose([*stopped[:3], wrench(skids, other.arm)]))
    F = np.linalg.solve(stopped @ gained, [*-np.array(stuck.free_acceleration), -other.free_acceleration[2]])
    start_slow_slip(held(body, FloorFriction(mu), Mode.STICKING, y)._replace(rim=rim), y)
    stuck, other = rims_of(body, y, rim)
    assert np.hypot(*F[:2]) > 1e-2 * F[2]
    assert stuck.velocity[:2] == pytest.approx(-F[:2] / (mu * F[2]) * slow * is_held, rel=1e-9, abs=1e-15)
    assert [stuck.velocity[2], other.velocity[2]] == pytest.approx([0, 0], abs=2e-17)
