"""Coulomb's force in MuJoCo's contacts: closed forms, then impacts against the law `coulomb`."""

import math

import numpy as np
import pytest

from cointoss import analytic
from cointoss.coin_mj import Friction, MujocoSettings, Realisation, impacts_of, toss
from cointoss.coin_mj.steps.coulomb import coulomb_force
from cointoss.compare.metrics.impulses import match
from cointoss.models.records import ApproximationWarning, Ending
from tests.helpers.draws import ZLOTY, draw_release, scenario
from tests.helpers.impacts import draw_single_impact
from tests.helpers.tuples import vector

pytestmark = pytest.mark.usefixtures("without_horizon")

BALL = np.diag([3.5, 3.5, 1.0])
"""Delassus matrix of a solid ball of 1 kg at its lowest point."""
GIVING = np.array([[2.0, 0, 0.6], [0, 2.0, 0], [0.6, 0, 1.2]])
JAMMED = np.array([[2.0, 0, 1.2], [0, 2.0, 0], [1.2, 0, 1.0]])
FORCES = {
    "slides: μ times its weight": (BALL, 0.2, (3.0, -4.0), (3.0, -4.0), (-0.2 * 10 * 0.6, 0.2 * 10 * 0.8)),
    # At rest, and pulled by 1 N at the contact.
    "sticks: held by what pulls it": (BALL, 0.2, (0.0, 0.0), (3.5e-3, 0.0), (-1.0, 0.0)),
    "is pulled off: no more than μ N": (BALL, 0.05, (0.0, 0.0), (3.5e-3, 0.0), (-0.5, 0.0)),
    "stops within the step: 1 mm/s is gone after it": (BALL, 0.5, (1e-3, 0.0), (1e-3, 0.0), (-1 / 3.5, 0.0)),
    # A friction of 0.5 N stops 1 mm/s after 1/(2.5 + 3.5 · 0.5) ms, and then acts the other way.
    "is driven back": (BALL, 0.05, (1e-3, 0.0), (-1.5e-3, 0.0), (0.5 - 1 / 4.25, 0.0)),
    # With N = N_0 - g f and f = -μ N s: f = -μ N_0/(1 - μ g) for s = 1.
    "N gives way to it": (GIVING, 0.4, (5.0, 0.0), (5.0, 0.0), (-4 / (1 - 0.4 * 0.5), 0.0)),
    # Sliding has no solution, and the slip of 1 m/s stops at once.
    "jams": (JAMMED, 1.0, (1.0, 0.0), (1.0, 0.0), (-1e3 / (2 - 1.44), 0.0)),
}
"""Delassus matrices, μ, the slip before and after 1 ms without friction [m/s], and the force [N]."""


@pytest.mark.parametrize("name", FORCES)
def test_the_force_of_a_step_under_10_n_is_its_closed_form(name):
    K, mu, slip, free, force = FORCES[name]
    assert coulomb_force(K, mu, 10.0, slip, free, 1e-3) == pytest.approx(
        force, rel=1e-3 if name == "is driven back" else 1e-9, abs=1e-12
    )


@pytest.mark.parametrize("slip", [0.0, 2e-3, 0.1])
@pytest.mark.parametrize("angle", [0.5, 2.1])
def test_in_axes_turned_about_the_vertical_friction_is_turned(angle, slip):
    """Where the point sticks, where it stops, and where it slides on; K_xy is 0 in one frame only."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    K = np.array([[3.5, 0.0, 0.6], [0.0, 1.0, -0.3], [0.6, -0.3, 1.2]])
    before, after = (slip, -slip, 0.0), (slip + 2e-3, 1e-3 - slip, 0.0)
    f = coulomb_force(K, 0.3, 10.0, before[:2], after[:2], 1e-3)
    before, after = vector(turn @ before), vector(turn @ after)
    f_turned = coulomb_force(turn @ K @ turn.T, 0.3, 10.0, before[:2], after[:2], 1e-3)
    assert f_turned == pytest.approx(turn[:2, :2] @ f, rel=1e-9)


def test_a_step_is_the_sum_of_512_steps():
    """Where the slip stops, turns, or turns back. Measured over 600: 7e-4 at worst, 4e-6 in the median."""
    rng = np.random.default_rng(67)
    for _ in range(20):
        A, mu = rng.normal(size=(3, 6)), float(rng.choice([0.02, 0.2, 0.5]))
        K = A @ A.T
        G = K[:2, :2] - np.outer(K[:2, 2], K[2, :2]) / K[2, 2]
        slip, driven = rng.normal(size=(2, 2)) * mu * np.linalg.norm(K) * 10 ** rng.uniform(-3, 0.5, (2, 1))
        f, v, mean = coulomb_force(K, mu, 1.0, tuple(slip), tuple(slip + driven), 1.0), slip, np.zeros(2)
        for _ in range(512):
            part = coulomb_force(K, mu, 1.0, tuple(v), tuple(v + driven / 512), 1 / 512)
            v, mean = v + (driven + G @ part) / 512, mean + np.array(part) / 512
        assert f == pytest.approx(mean, abs=8e-4 * math.hypot(*mean))


def errors_and_kinds(rng, count, **settings):
    """Errors of impulses, and whether the slip stops, keeps its direction, or turns by a right angle."""
    errors, kinds = [], []
    for _ in range(count):
        case, law = draw_single_impact(rng, "coulomb")
        errors.append(match(law, impacts_of(case, settings=MujocoSettings(**settings))).impulse[0])
        before, after = law.contact_velocity_before[0, :2], law.contact_velocity_after[0, :2]
        kinds.append(
            "sticks"
            if np.hypot(*after) < 1e-9 * np.hypot(*before)
            else "slides"
            if before @ after > 0
            else "turns"
        )
    return np.array(errors), np.array(kinds)


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("realisation", "median", "worst"),
    # Asked: median 2e-3, worst 1e-2. Measured over 150: 2.4e-5 and 4e-5; 1.3e-6 and 7e-4.
    [(Realisation.SPRING, 6e-5, 5e-4), (Realisation.ONE_STEP, 1e-5, 3e-3)],
)
def test_first_impacts_meet_rouths_law(realisation, median, worst):
    errors, kinds = errors_and_kinds(np.random.default_rng(61), 100, contact=realisation)
    for kind in ("sticks", "slides", "turns"):
        chosen = errors[kinds == kind]
        assert len(chosen) > 10, kind
        assert 1e-7 < np.median(chosen) < median, kind
        assert chosen.max() < worst, kind


def test_mujocos_own_friction_is_far_from_coulombs():
    """Its convex cone pushes a sliding contact apart."""
    assert (
        5e-3 < np.median(errors_and_kinds(np.random.default_rng(61), 40, friction=Friction.NATIVE)[0]) < 0.1
    )


def test_a_perfectly_rough_floor_is_one_of_large_friction():
    rng = np.random.default_rng(62)
    for _ in range(10):
        case, law = draw_single_impact(rng, "perfectly_rough")
        with pytest.warns(ApproximationWarning, match=r'"perfectly_rough": MuJoCo tosses .* friction 100'):
            impacts = toss(case).impacts
        assert match(law, impacts).impulse[0] < 1e-3


def test_a_flat_landing_is_without_friction():
    """The impulse goes through C, as in the paper's mechanics."""
    case = scenario(
        floor={"contact": "coulomb", "friction": 0.5},
        release={"velocity": [0.3, 0, 0], "angular_velocity": [0, 0, 5.0]},
        ending={"max_impacts": 1},
    )
    after = toss(case).impacts.velocity_after[0]
    assert after == pytest.approx(analytic.toss(case).impacts.velocity_after[0], rel=1e-4)


def test_a_flat_landing_that_turns_has_friction():
    """A rim goes down first: it slips on while the coin turns out of the plane of the floor."""
    h = ZLOTY["thickness"]
    case = scenario(
        floor={"contact": "coulomb", "friction": 0.2},
        release={
            "position": [0, 0, h / 2 + 1e-12],
            "velocity": [0.5, 0, -0.5],
            "angular_velocity": [0, 30, 0],
        },
        ending={"max_impacts": 1},
    )
    S = toss(case).impacts.impulse[0]
    assert S[0] == pytest.approx(-0.2 * S[2], rel=0.02)
    assert S[0] < 0


def test_one_step_contacts_meet_newtons_law_down_to_restitution_0():
    rng = np.random.default_rng(65)
    for restitution in (0.0, 0.005, 0.5, 1.0):
        case = scenario(
            floor={"restitution": restitution}, release=draw_release(rng), ending={"max_impacts": 1}
        )
        error = match(
            analytic.toss(case).impacts,
            toss(case, settings=MujocoSettings(contact=Realisation.ONE_STEP)).impacts,
        )
        assert error.impulse[0] < 3e-5


def test_a_toss_of_one_step_contacts_ends():
    case = scenario(floor={"restitution": 0.5}, release=draw_release(np.random.default_rng(66)))
    tossed = toss(case, settings=MujocoSettings(contact=Realisation.ONE_STEP))
    assert tossed.ending == Ending.SETTLED
    names = {setting.name for setting in tossed.certificate}
    assert "length of the step" in names
    dead = case.replace("floor.restitution", 0.0)
    assert toss(dead, settings=MujocoSettings(contact=Realisation.ONE_STEP)).ending == Ending.SETTLED
