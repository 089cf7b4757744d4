"""When a face is settled: against a brute search for the lowest pass, and against tosses that go on."""

import numpy as np
import pytest

from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.barriers import barrier, energy, spin_barrier
from cointoss.models.drag import linear_drag, sliding_share
from cointoss.models.ending import final_face
from cointoss.models.geometry import gap
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import Ending, Outcome
from cointoss.models.state import state
from tests.helpers.draws import AIR, IMPERFECT, PAPER_OFFSET, ZLOTY, scenario

final_face = by_numba(final_face)
UNDECIDED = (Outcome.UNDECIDED, Ending.NONE)


def classified(case, tilt, v=(0.0, 0.0, 0.0), w=(0.0, 0.0, 0.0)):
    """Classify a coin that touches the floor at this tilt with these velocities."""
    body = case.body
    e = quaternion_from_angles((0.0, tilt, 0.0))
    up = rotation_matrix(e)[2]
    z = -gap(body, 0.0, up)
    touching = state((0.0, 0.0, z), v, e, w)
    return final_face(body, case.rules, touching, 0.0), energy(body, z, v, w), barrier(body, up[2])


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("tilt", "face"), [(0.3, Outcome.HEADS), (np.pi - 0.3, Outcome.TAILS)])
def test_a_slow_coin_is_settled_and_a_fast_one_is_not(tilt, face):
    case = scenario(air=AIR)
    for speed in (0.01, 0.2, 0.4, 0.6):
        (outcome, ending), E, pass_ = classified(case, tilt, v=(0.0, 0.0, speed))
        expected = (face, Ending.SETTLED) if pass_ > E else UNDECIDED
        assert (outcome, ending) == expected
    assert E > pass_, "one of the speeds should be above the pass"


def test_laws_that_may_add_energy_end_under_the_papers_name():
    case = scenario(floor={"contact": "knurled"})
    assert classified(case, 0.3)[0] == (Outcome.HEADS, Ending.PAPER)


def test_the_papers_tests_compare_with_m_g_r():
    mgr = 2e-3 * 9.81 * 1.25e-2
    slide = np.sqrt(2 * mgr / 2e-3)
    paper, smooth = scenario(ending={"test": "paper"}), scenario(ending={"test": "paper_smooth"})
    # Sliding fast over the floor, almost flat: eq. (20) leaves the sliding out.
    assert classified(paper, 0.01, v=(slide, 0.0, 0.0))[0] == UNDECIDED
    assert classified(smooth, 0.01, v=(slide, 0.0, 0.0))[0] == (Outcome.HEADS, Ending.PAPER_SMOOTH)
    assert classified(smooth, 0.01, w=(0.0, 0.0, 300.0))[0] == (Outcome.HEADS, Ending.PAPER_SMOOTH)


@pytest.mark.slow
def test_what_a_smooth_floor_conserves_settles_a_fast_spinning_coin():
    """In vacuum neither sliding nor spin about the normal can turn the ideal coin over."""
    fast = {"v": (2.0, 0.0, 0.0), "w": (0.0, 0.0, 300.0)}
    (outcome, ending), E, pass_ = classified(scenario(), 0.05, **fast)
    assert E > 10 * pass_
    assert (outcome, ending) == (Outcome.HEADS, Ending.SETTLED)
    for air in ({"tangential": 0.2, "exponent": 1.0}, {"normal": 0.8, "exponent": 0.5}):
        assert classified(scenario(air=air), 0.05, **fast)[0] == UNDECIDED
    assert classified(scenario(air={"exponent": 0.5}), 0.05, **fast)[0] == (Outcome.HEADS, Ending.SETTLED)
    assert classified(scenario(coin=IMPERFECT), 0.05, **fast)[0] == (Outcome.HEADS, Ending.SETTLED)


def test_in_linear_air_an_unbalanced_coin_is_settled_without_its_sliding_but_with_its_spin():
    sliding, spinning = {"v": (2.0, 0.0, 0.0)}, {"w": (0.0, 0.0, 300.0)}
    for coin in (ZLOTY, IMPERFECT):
        case = scenario(coin=coin, air=AIR)
        assert classified(case, 0.05, **sliding)[0] == (Outcome.HEADS, Ending.SETTLED)
        undecided = coin is IMPERFECT
        assert (classified(case, 0.05, **spinning)[0][1] == Ending.NONE) == undecided
        assert classified(case, 0.05, v=(8.0, 0.0, 0.0))[0][1] == Ending.NONE, "a twentieth of it may rise"


@pytest.mark.parametrize(("thickness", "ratio"), [(0.0, 2.0), (2e-3, 1.0), (2e-3, 8.0)])
def test_the_sliding_share_of_a_balanced_coin_is_its_closed_form(thickness, ratio):
    drag = linear_drag(0.0125, thickness, 0.2 * ratio, 0.2)
    root = (drag.force_normal / drag.force_tangential) ** 0.5
    assert sliding_share(drag, 0.0) == pytest.approx(((root - 1) / (root + 1)) ** 2, abs=2e-9)
    assert sliding_share(drag, 1e-3) > sliding_share(drag, 0.0)
    assert sliding_share(linear_drag(0.0125, thickness, 0.0, 0.0), 0.0) == 1


@pytest.mark.parametrize(("spin", "expected"), [(40.0, Ending.SETTLED), (-40.0, Ending.NONE)])
def test_a_coin_that_leans_near_its_edge_is_settled_if_its_spin_keeps_it_from_coming_upright(spin, expected):
    """L_z - L_ζ cos s grows on the way up for one sense of the spin, and shrinks for the other."""
    (outcome, ending), E, pass_ = classified(scenario(), np.pi / 2 - 0.05, w=(0.0, 25.0, spin))
    assert E > pass_
    assert ending == expected
    assert (outcome == Outcome.HEADS) == (expected == Ending.SETTLED)


@pytest.mark.parametrize(
    ("thickness", "expected"),
    [(0.0, UNDECIDED), (2e-3, (Outcome.EDGE, Ending.SETTLED))],
)
def test_an_upright_coin_is_not_settled_on_the_face_that_rounding_gives_it(thickness, expected):
    case = scenario(coin={**ZLOTY, "thickness": thickness})
    for tilt in np.pi / 2 + np.array([-1e-9, -1e-12, 0.0, 1e-12, 1e-9]):
        assert classified(case, tilt, w=(0.0, 60.0, 0.0))[0] == expected


@pytest.mark.parametrize(("turn", "roll", "held"), [(0, 0, 1), (60, 0, 1), (10, 11, 0.1), (-11, 10, 0.1)])
def test_an_upright_coin_is_held_on_its_edge_by_its_weight_against_its_spin(turn, roll, held):
    """C must rise by about g h²/(8 r); turning adds (J_ξ/m) (turn h/(2 r))²/2, rolling too lowers a pass."""
    r, h, J, g = 1.25e-2, 2e-3, 1.25e-2**2 / 4 + 2e-3**2 / 12, 9.81
    rise = g * (np.hypot(r, h / 2) - r) + J * (turn * h / (2 * r)) ** 2 / 2
    for part, expected in ((0.98 * held**2, (Outcome.EDGE, Ending.SETTLED)), (1.02, UNDECIDED)):
        moving = {"v": (0.5, 0.0, np.sqrt(2 * rise * part)), "w": (0, turn, roll)}
        assert classified(scenario(), np.pi / 2, **moving)[0] == expected
    tips = {"v": (0.5, 0.0, 0.0), "w": (0, 10, g * h / (r * r * 10))}
    assert classified(scenario(), np.pi / 2, **tips)[0] == UNDECIDED


def test_the_roll_of_a_balanced_coin_does_not_lift_it_off_its_edge_in_linear_air():
    for coin, exponent, expected in (
        (ZLOTY, 0, (Outcome.EDGE, Ending.SETTLED)),
        (ZLOTY, 0.5, UNDECIDED),
        (IMPERFECT, 0, UNDECIDED),
    ):
        case = scenario(coin=coin, air={**AIR, "exponent": exponent})
        assert classified(case, np.pi / 2, w=(0.0, 0.0, 60.0))[0] == expected


def test_an_imperfect_coin_is_settled_on_a_smooth_floor_only_below_every_way_over():
    """Upright it needs its height and, as L_z is conserved, the energy L_z²/(2 uᵀ J u) of turning."""
    rng = np.random.default_rng(4)
    case = scenario(coin=IMPERFECT)
    body, J = case.body, np.array(case.body.inertia)
    # From today's tilt on: the ways over lead through every tilt up to upright, each in some direction.
    ups = {
        tilt: np.array(
            [
                rotation_matrix(quaternion_from_angles((0.0, tilt, phi)))[2]
                for phi in np.linspace(0, 2 * np.pi, 73)
            ]
        )
        for tilt in np.linspace(0.3, np.pi / 2, 12)
    }
    seen = {True: 0, False: 0}
    for _ in range(200):
        w = tuple(rng.uniform(-60, 60, 3))
        (outcome, _), E, pass_ = classified(case, 0.3, w=w)
        if pass_ > E:
            continue
        up = np.array(rotation_matrix(quaternion_from_angles((0.0, 0.3, 0.0)))[2])
        L_z = up @ J @ w
        needed = max(
            min(2e-3 * 9.81 * -gap(body, 0.0, u) + L_z**2 / (2 * u @ J @ u) for u in directions)
            for directions in ups.values()
        )
        seen[outcome == Outcome.HEADS] += 1
        assert outcome == Outcome.UNDECIDED or needed > E
    assert min(seen.values()) > 5


@pytest.mark.parametrize("contact", ["smooth", "coulomb"])
@pytest.mark.parametrize(("spin", "lies"), [(300.0, True), (1500.0, False)])
def test_a_flat_coin_lies_unless_its_unbalanced_spin_lifts_it(contact, spin, lies):
    """It takes the moment J_ηζ ω² to spin flat; the weight has m g (r - |c|) at most."""
    case = scenario(coin=IMPERFECT, air=AIR, floor={"contact": contact, "friction": 0.2})
    J, c = case.body.inertia, float(np.linalg.norm(PAPER_OFFSET[:2]))
    moment = np.hypot(J[0][2], J[1][2]) * spin**2
    assert (moment < 0.5 * 2e-3 * 9.81 * (1.25e-2 - c)) == lies
    expected = (Outcome.HEADS, Ending.LYING) if lies else UNDECIDED
    assert classified(case, 0.0, w=(0.0, 0.0, spin))[0] == expected
    assert classified(case, 1e-3, w=(0.0, 0.0, 300.0))[0] == UNDECIDED, "it is tilted"


@pytest.mark.parametrize("tilt", [np.pi / 2 - 1e-10, np.pi / 2 + 1e-10])
def test_a_coin_as_thick_as_wide_does_not_lie_on_a_face_where_it_slides_upright(tilt):
    """It is then as high as flat."""
    thick = scenario(coin={**ZLOTY, "thickness": 2 * ZLOTY["radius"]}, floor={"contact": "coulomb"})
    assert classified(thick, tilt, v=(0.6, 0.0, 0.0))[0] == UNDECIDED
    assert classified(thick, 0.0, v=(0.6, 0.0, 0.0))[0] == (Outcome.HEADS, Ending.LYING)
    assert classified(thick, tilt)[0][0] == Outcome.EDGE


@pytest.mark.parametrize("center", [(0.0, 0.0, 0.0), (-1e-3, -1e-3, -2e-4)])
def test_a_thick_coin_is_caught_on_its_edge_below_both_passes(center):
    coin = {**ZLOTY, "thickness": 0.01, "center_of_mass": center}
    for tilt in (np.pi / 2 - 0.05, np.pi / 2 + 0.05):
        (outcome, ending), E, pass_ = classified(scenario(coin=coin, air=AIR), tilt)
        assert pass_ > E
        assert (outcome, ending) == (Outcome.EDGE, Ending.SETTLED)
    fast = classified(scenario(coin=coin, air=AIR), np.pi / 2 - 0.05, v=(0.0, 0.0, 0.2))
    assert fast[0] == UNDECIDED


@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
@pytest.mark.parametrize("test", ["rigorous", "paper", "paper_smooth"])
def test_a_coin_flat_on_the_floor_lies_under_every_test_whatever_spin_it_has_left(law, test):
    case = scenario(floor={"contact": law, "friction": 0.3}, ending={"test": test})
    (outcome, ending), E, pass_ = classified(case, 0.0, v=(3.0, 0.0, 0.0), w=(0.0, 0.0, 300.0))
    assert E > pass_
    assert outcome == Outcome.HEADS
    # What the smooth floor conserves settles the face before, and eq. (20) leaves the same energies out.
    by_energy = {("smooth", "rigorous"): Ending.SETTLED}
    if test == "paper_smooth":
        by_energy[law, test] = Ending.PAPER_SMOOTH
    assert ending == by_energy.get((law, test), Ending.LYING)
    sharp = scenario(floor={"contact": "sharp_edge"}, ending={"test": "rigorous"})
    assert classified(sharp, 0.0, v=(3.0, 0.0, 0.0))[0][1] == Ending.NONE


def test_lying_is_waited_for_beyond_the_settled_face():
    """A tilt s raises C by m g r s, up to the thickness; still to the eye is a thousandth of m g r."""
    waiting = scenario(ending={"test": "lying"})
    for tilt, lies in ((0.1, False), (1.1e-3, False), (0.9e-3, True)):
        assert classified(scenario(), tilt)[0] == (Outcome.HEADS, Ending.SETTLED)
        expected = (Outcome.HEADS, Ending.LYING) if lies else UNDECIDED
        assert classified(waiting, tilt)[0] == expected


@pytest.mark.parametrize("center", [(0.0, 0.0, 0.0), PAPER_OFFSET])
def test_a_coin_upright_within_rounding_still_needs_its_spin(center):
    body, w = scenario(coin={**ZLOTY, "center_of_mass": center}).body, (0.0, 30.0, 0.0)
    exactly, beyond = (spin_barrier(body, (0.0, sine, 0.0), w) for sine in (1.0, np.nextafter(1.0, 2.0)))
    assert beyond == pytest.approx(exactly, rel=1e-12)
    assert exactly > body.mass * body.gravity * body.radius / 2
