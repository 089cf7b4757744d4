"""The contact laws: the identities of eqs (85)-(92), the law's own constraint, energy, limits."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.impact.laws import delassus, spin_gained
from cointoss.models.attitude import rotation_matrix
from cointoss.models.barriers import energy
from cointoss.models.contact_laws import sliding_friction
from cointoss.models.contact_laws.table import LAWS, laws_that
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Ending
from tests.helpers.draws import AIR, PAPER_LAWS, draw_release, scenario
from tests.helpers.impacts import asked, draw_impact, struck

COUNT = 200


@pytest.mark.parametrize("law", PAPER_LAWS)
def test_every_law_obeys_newton_momentum_and_its_own_constraint(law):
    rng = np.random.default_rng(int(law))
    for _ in range(COUNT):
        case, y = draw_impact(rng, law)
        row, after, ending = struck(case, y)
        assert ending == Ending.NONE
        chi, mu, m = case.floor.restitution, case.floor.friction, case.coin.mass
        before_A, after_A = row["contact_velocity_before"], row["contact_velocity_after"]
        speed = np.abs(before_A).max() + np.abs(after_A).max()
        R = np.array(rotation_matrix(tuple(y[6:10])))
        arm = R @ (row["point"] - case.coin.center_of_mass)
        S = row["impulse"]

        assert after_A[2] == pytest.approx(-chi * before_A[2], abs=1e-12 * speed)
        assert np.abs(m * (after[3:6] - y[3:6]) - S).max() < 1e-12 * np.abs(S).max()
        turned = R @ case.coin.inertia_about_C @ (after[10:13] - y[10:13])
        assert np.abs(turned - np.cross(arm, S)).max() < 1e-12 * np.abs(np.cross(arm, S)).max()
        assert np.array_equal(after[:3], y[:3])
        assert np.array_equal(after[6:10], y[6:10])

        edge = R @ np.array([-row["point"][1], row["point"][0], 0])
        tau = edge / np.linalg.norm(edge)
        assert abs(tau[2]) < 1e-15
        nu = np.cross([0, 0, 1], tau)
        kept = 1e-12 * speed
        match law:
            case ContactLaw.SHARP_EDGE:
                assert nu @ after_A == pytest.approx(0, abs=kept)
                assert tau @ after_A == pytest.approx(tau @ before_A, abs=kept)
            case ContactLaw.KNURLED:
                assert nu @ after_A == pytest.approx(nu @ before_A, abs=kept)
                assert tau @ after_A == pytest.approx(0, abs=kept)
            case ContactLaw.PERFECTLY_ROUGH:
                assert np.abs(after_A[:2]).max() < kept
            case ContactLaw.SLIP_PRESERVING:
                assert np.abs(after_A[:2] - before_A[:2]).max() < kept
            case ContactLaw.SMOOTH:
                assert S[0] == S[1] == 0
            case ContactLaw.SLIDING_FRICTION:
                slip = before_A[:2] / np.linalg.norm(before_A[:2])
                assert np.abs(S[:2] + mu * S[2] * slip).max() < 1e-15 * np.abs(S).max() + 1e-18


def test_the_smooth_law_never_adds_energy_and_loses_none_at_restitution_one():
    rng = np.random.default_rng(11)
    for _ in range(COUNT):
        row, _, _ = struck(*draw_impact(rng, ContactLaw.SMOOTH))
        assert row["energy_change"] < 0
        row, _, _ = struck(*draw_impact(rng, ContactLaw.SMOOTH, restitution=1.0))
        assert abs(row["energy_change"]) < 1e-13 * row["energy"]


@pytest.mark.parametrize("law", [ContactLaw.KNURLED, ContactLaw.SLIP_PRESERVING])
def test_laws_that_keep_slip_can_add_energy(law):
    rng = np.random.default_rng(12)
    gains = [struck(*draw_impact(rng, law, restitution=0.5))[0]["energy_change"] for _ in range(COUNT)]
    assert max(gains) > 0 > min(gains)


def spins_of(law, coin, release):
    """ω_ζ after the impacts before the first sustained contact, of an ideal coin that is tossed in air."""
    floor = {"contact": str(law), "restitution": 0.8, "friction": 0.3}
    case = scenario(coin=coin, air=AIR, floor=floor, release=release, ending={"max_impacts": 40})
    toss = analytic.toss(case)
    free = toss.impacts.time < toss.contacts[:, 0].min(initial=np.inf)
    return toss.impacts.angular_velocity_after[free, 2].tolist()


@pytest.mark.parametrize("law", laws_that(lambda law: law.spares_spin))
@pytest.mark.parametrize("thickness", [0.0, 2e-3, 2e-2])
def test_an_ideal_coin_without_spin_about_its_axis_gets_none_by_a_law_that_spares_it(law, thickness):
    rng, spins = np.random.default_rng([16, int(1e3 * thickness)]), []
    for _ in range(20):
        release = draw_release(rng, spin=80.0)
        release["angular_velocity"][2] = 0.0
        spins += spins_of(law, {"thickness": thickness}, release)
    assert len(spins) > 100
    assert not any(spins)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("axis", [0, 1])
def test_nor_does_one_that_moves_in_a_plane_by_any_law(law, axis):
    rng, spins = np.random.default_rng([17, int(law)]), []
    for _ in range(20):
        release = draw_release(rng, spin=80.0)
        e, half = np.zeros(4), rng.uniform(0, np.pi)
        e[0], e[1 + axis] = np.cos(half), np.sin(half)
        release["quaternion"] = e
        release["velocity"][axis] = 0.0
        release["angular_velocity"] = release["angular_velocity"][axis] * np.eye(3)[axis]
        spins += spins_of(law, {}, release)
    assert len(spins) > 100
    assert not any(spins)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("spin", [0.0, 1e-15, -30.0])
def test_the_spin_of_an_ideal_coin_changes_by_the_moment_of_the_impulse(law, spin):
    """One that spins about ζ, however slowly, has the sum of its spin and that moment, to the bit."""
    rng, turned = np.random.default_rng([18, int(law)]), 0
    for _ in range(COUNT):
        case, y = draw_impact(rng, law)
        case, y[12] = case.replace("coin.center_of_mass", (0.0, 0.0, 0.0)), spin
        row, after, _ = struck(case, y)
        R = rotation_matrix(tuple(y[6:10]))
        arm = np.array(R) @ row["point"]
        gained = spin_gained(case.body, R, tuple(arm), tuple(row["impulse"]))
        size = case.coin.radius * np.abs(row["impulse"]).max() * case.body.inertia_inverse[2][2]
        assert after[12] == pytest.approx(spin + gained[2], abs=1e-15 * max(size, abs(spin)))
        turned += abs(gained[2]) > 1e-3 * size
    assert (turned > COUNT / 2) == (not LAWS[law].spares_spin)


def test_the_energy_recorded_is_that_of_the_state_after():
    case, y = draw_impact(np.random.default_rng(13), ContactLaw.SMOOTH)
    row, after, _ = struck(case, y)
    body = case.body
    E = [energy(body, s[2], tuple(s[3:6]), tuple(s[10:13])) for s in (y, after)]
    assert row["energy"] == E[1]
    assert row["energy_change"] == pytest.approx(E[1] - E[0], rel=1e-15)


def test_the_delassus_matrix_is_symmetric_and_positive_definite():
    rng = np.random.default_rng(14)
    for _ in range(COUNT):
        case, y = draw_impact(rng, ContactLaw.SMOOTH)
        K = np.array(delassus(case.body, rotation_matrix(tuple(y[6:10])), tuple(rng.uniform(-0.01, 0.01, 3))))
        assert np.abs(K - K.T).max() < 1e-15 * np.abs(K).max()
        assert np.linalg.eigvalsh(K)[0] > 0


def test_friction_without_coefficient_is_smooth():
    case, y = draw_impact(np.random.default_rng(15), ContactLaw.SLIDING_FRICTION)
    frictionless = case.replace("floor.friction", 0.0)
    smooth = frictionless.replace("floor.contact", "smooth")
    assert struck(frictionless, y)[0]["impulse"] == pytest.approx(struck(smooth, y)[0]["impulse"], rel=1e-15)


@pytest.mark.parametrize("law", list(ContactLaw))
@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flat_coin_bounces_flat_whatever_the_law(law, up):
    case = scenario(
        coin={"center_of_mass": [-1e-3, -1e-3, -2e-4]},
        floor={"restitution": 0.6, "contact": str(law), "friction": 0.2},
    )
    e = [1.0, 0, 0, 0] if up > 0 else [0, 1.0, 0, 0]
    y = np.array([0, 0, 0.001 - up * 2e-4, 0.3, 0.1, -2.0, *e, 0, 0, 4.0])
    row, after, _ = struck(case, y)
    assert after[3:6] == pytest.approx([0.3, 0.1, 1.2], rel=1e-15)
    assert np.array_equal(after[10:13], y[10:13])
    assert row["point"] == pytest.approx([-1e-3, -1e-3, -up * 1e-3], rel=1e-15)
    assert row["impulse"] == pytest.approx([0, 0, 2e-3 * 1.6 * 2.0], rel=1e-15)


def test_painleves_case_has_no_solution_and_says_so():
    K = ((1500.0, 0.0, -900.0), (0.0, 1500.0, 0.0), (-900.0, 0.0, 1000.0))
    against_the_edge = (-1.0, 0.0, -1.0)
    # Along (mu, 0, 1) the velocity gained is 1000 - 900 mu: positive up to mu = 10/9.
    S, possible = sliding_friction.impulse(asked(K, against_the_edge, 0.5, 1.0))
    assert possible
    assert S == pytest.approx([1.5 / 100, 0, 1.5 / 100], rel=1e-12)
    S, possible = sliding_friction.impulse(asked(K, against_the_edge, 0.5, 1.2))
    assert not possible
    assert S == (0.0, 0.0, 0.0)
    # And where friction takes just all of the normal motion.
    K = ((1500.0, 0.0, -800.0), (0.0, 1500.0, 0.0), (-800.0, 0.0, 1000.0))
    assert sliding_friction.impulse(asked(K, against_the_edge, 0.5, 1.25)) == ((0.0, 0.0, 0.0), False)
