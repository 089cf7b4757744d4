"""Every landing asks a law of one's own, flat, on the edge or turning; no restitution but its own counts."""

# ruff: noqa: ARG001

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import OwnLaw
from cointoss.models.batch import rows_of
from cointoss.models.certificate import IMPACT_ENERGY, LAW, MOMENTUM
from cointoss.models.laws import EndingTest
from cointoss.models.records import Ending, UnsupportedError
from tests.helpers.draws import THIN, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.own_laws import FREE, REFUSED, of, sharp_edge, smooth, superball

LYING = {"test": "lying", "max_impacts": 5}
OFF = {"center_of_mass": [1e-3, -2e-3, 3e-4]}
EDGEWISE = {**ZLOTY, "thickness": 0.03}
HEADS, TAILS = [1.0, 0.0, 0.0, 0.0], [0.0, 0.6, 0.8, 0.0]


def slower_less(K, v_A, tau, chi, mu):
    """The smooth law with e(v) = 1/(1 + v)."""
    return 0.0, 0.0, -(1 + 1 / (1 - v_A[2])) * v_A[2] / K[2][2]


def drop(coin, e, height, **release):
    return scenario(
        coin=coin,
        release={"position": [0.0, 0.0, height], "quaternion": e, **release},
        ending=LYING,
    )


def rebounds(v, number):
    """v_(n+1) = v_n/(1 + v_n): 1/v_n grows by 1."""
    return 1 / (1 / v + np.arange(1, number + 1))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("e", [HEADS, TAILS, [0.8, 0.0, 0.0, 0.6]])
@pytest.mark.parametrize("coin", [THIN, ZLOTY, {**ZLOTY, **OFF}], ids=["thin", "thick", "unbalanced"])
@pytest.mark.parametrize("chi", [1.0, 0.3])
def test_a_coin_that_lands_flat_rebounds_by_the_law(coin, e, chi):
    offset = coin.get("center_of_mass", [0.0])[-1]
    flat = coin["thickness"] / 2 + (offset if e != TAILS else -offset)
    spin = 0.0 if offset else 3.0
    case = drop(coin, e, flat + 0.3, angular_velocity=[0.0, 0.0, spin]).replace("floor.restitution", chi)
    toss = analytic.toss(case, law=OwnLaw(slower_less))
    before, after = toss.impacts.velocity_before, toss.impacts.velocity_after
    assert toss.ending == Ending.MAX_IMPACTS
    assert before[0, 2] == pytest.approx(-np.sqrt(2 * 9.81 * 0.3), rel=1e-12)
    assert after[:, 2] == pytest.approx(rebounds(-before[0, 2], 5), rel=1e-12)
    assert toss.impacts.angular_velocity_after[:, 2] == pytest.approx(spin, rel=1e-14)
    assert max(of(toss, LAW), of(toss, MOMENTUM)) < 1e-14
    assert toss.trusted_impacts == 5


def test_the_first_law_that_anybody_tries():
    toss = analytic.toss(drop(THIN, HEADS, 2.42206**2 / (2 * 9.81)), law=OwnLaw(slower_less))
    assert toss.impacts.velocity_before[0, 2] == pytest.approx(-2.42206, abs=1e-12)
    assert toss.impacts.velocity_after[:3, 2] == pytest.approx([0.70778, 0.41444, 0.29301], abs=5e-6)


@pytest.mark.parametrize("coin", [ZLOTY, {**ZLOTY, **OFF}], ids=["balanced", "unbalanced"])
def test_a_flat_landing_acts_through_the_mass_centre_in_all_directions(coin):
    """K = I/m: all of the velocity is turned back, none of the spin."""
    case = drop(coin, HEADS, 0.3, velocity=[0.3, -0.2, 0.0])
    toss = analytic.toss(case, law=OwnLaw(superball(0.5, 0.8), may_pull=True, may_add_energy=True))
    change = toss.impacts.velocity_after / toss.impacts.velocity_before
    assert len(toss.impacts) == 5
    assert change == pytest.approx(np.tile([-0.5, -0.5, -0.8], (5, 1)), rel=1e-12)
    assert np.all(toss.impacts.angular_velocity_after == 0)
    assert max(of(toss, name) for name in (LAW, MOMENTUM, IMPACT_ENERGY)) < 1e-12


def test_a_flat_landing_has_no_edge_that_a_turn_of_the_room_would_turn():
    case = drop(ZLOTY, HEADS, 0.3, velocity=[0.3, 0.0, 0.0])
    turned = drop(ZLOTY, [0.8, 0.0, 0.0, 0.6], 0.3, velocity=[0.3 * 0.28, 0.3 * 0.96, 0.0])
    tosses = [analytic.toss(one, law=OwnLaw(sharp_edge, **FREE)) for one in (case, turned)]
    speeds = [np.linalg.norm(toss.impacts.velocity_after, axis=1) for toss in tosses]
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-12)
    # Without an edge all of the slip lies across it.
    assert np.abs(tosses[0].impacts.velocity_after[0, :2]).max() < 1e-15


def test_a_coin_that_lands_on_its_edge_rebounds_by_the_law():
    upright = [np.sqrt(0.5), np.sqrt(0.5), 0.0, 0.0]
    toss = analytic.toss(drop(EDGEWISE, upright, 0.3), law=OwnLaw(slower_less))
    v = toss.impacts.velocity_before[0, 2]
    assert toss.impacts.velocity_after[0, 2] == pytest.approx(-v / (1 - v), rel=1e-12)
    assert toss.impacts.point[0, 2] == 0
    assert of(toss, LAW) < 1e-12


@pytest.mark.slow_after_first
@pytest.mark.parametrize("coin", [THIN, ZLOTY], ids=["thin", "thick"])
@pytest.mark.parametrize("e", [HEADS, TAILS])
def test_a_flat_coin_that_turns_lands_on_the_rim_point_that_comes_down(coin, e):
    """At the touch 5 rad/s about a diameter have turned it by less than rounding."""
    case = drop(coin, e, coin["thickness"] / 2, velocity=[0.0, 0.0, -1.0], angular_velocity=[3.0, 4.0, 0.0])
    toss = analytic.toss(case, law=OwnLaw(slower_less))
    first = toss.impacts.point[0]
    assert np.hypot(first[0], first[1]) == pytest.approx(coin["radius"], rel=1e-12)
    v_A, after = (getattr(toss.impacts, f"contact_velocity_{side}")[0, 2] for side in ("before", "after"))
    assert after == pytest.approx(-v_A / (1 - v_A), rel=1e-12)
    assert of(toss, LAW) < 1e-12


def gains_when_fast_and_flat(K, v_A, tau, chi, mu):
    size = -(1 + chi) * v_A[2] / K[2][2]
    return 0.0, 0.0, 3 * size if tau[0] == tau[1] and v_A[2] < -20 else size


def test_what_a_flat_landing_must_not_do_ends_the_toss():
    toss = analytic.toss(
        drop(ZLOTY, HEADS, 1.0, velocity=[0, 0, -25.0]), law=OwnLaw(gains_when_fast_and_flat)
    )
    assert (toss.ending, len(toss.impacts)) == (Ending.NO_SOLUTION, 0)
    assert of(toss, REFUSED).startswith("adds ")
    assert "K = ((500, 0, 0), (0, 500, 0), (0, 0, 500)) 1/kg" in of(toss, REFUSED)


def fixed(e):
    def law(K, v_A, tau, chi, mu):
        return 0.0, 0.0, -(1 + e) * v_A[2] / K[2][2]

    return law


@pytest.mark.slow
@pytest.mark.parametrize("test", list(EndingTest))
def test_of_the_scenarios_restitution_only_the_law_makes_use(test):
    """Impacts chatter by what the law gives back: a law that is not asked for chi gives one toss for all."""
    rng, endings = np.random.default_rng(5), set()
    for _ in range(2):
        case = scenario(
            coin=draw_coin(rng),
            floor={"restitution": 0.9, "contact": "smooth"},
            release=draw_release(rng),
            ending={"test": str(test), "max_impacts": 3000},
        )
        known = analytic.toss(case, law=OwnLaw(smooth))
        for chi in (0.0, 1.0):
            toss = analytic.toss(case.replace("floor.restitution", chi), law=OwnLaw(fixed(0.9)))
            assert np.array_equal(toss.impacts.time, known.impacts.time)
            assert (toss.outcome, toss.ending, toss.end_time) == (known.outcome, known.ending, known.end_time)
            assert (toss.trusted_impacts, toss.outcome_certain) == (
                known.trusted_impacts,
                known.outcome_certain,
            )
        endings.add(known.ending)
    assert Ending.CHATTER in endings or test != EndingTest.LYING


def test_impacts_that_give_back_more_than_came_do_not_chatter():
    law = OwnLaw(fixed(1.02), may_add_energy=True)
    case = scenario(release={"position": [0, 0, 0.1], "angles": [0, 0.5, 0]}, ending={"max_impacts": 200})
    assert analytic.toss(case, law=law).ending == Ending.MAX_IMPACTS


def errs(K, v_A, tau, chi, mu):
    """As a law that integrates: a part of 1e-9 too much."""
    return 0.0, 0.0, -(1 + 1e-9) * (1 + chi) * v_A[2] / K[2][2]


def test_a_law_says_up_to_which_restitution_it_is_meant():
    with pytest.raises(
        ValueError, match=r"^law errs: adds .*, chi = 1, .* \(max_restitution = 1, tol.*10\)$"
    ):
        OwnLaw(errs)
    case = scenario(release={"position": [0, 0, 0.3], "angles": [0, 0.5, 0], "angular_velocity": [9, 0, 0]})
    law = OwnLaw(errs, max_restitution=0.8)
    assert analytic.toss(case, law=law).ending == Ending.SETTLED
    says = r"^floor.restitution = 0.81: accepted: up to max_restitution, 0.8, of the law errs$"
    with pytest.raises(UnsupportedError, match=says):
        analytic.toss(case.replace("floor.restitution", 0.81), law=law)
    with pytest.raises(UnsupportedError, match=says):
        analytic.toss_rows(rows_of(case, 2, {"floor.restitution": [0.8, 0.81]}), law=law)


def test_a_law_says_to_which_accuracy_it_is_meant_and_then_proves_no_face():
    case = scenario(
        floor={"restitution": 1.0},
        release={"position": [0, 0, 0.3], "angles": [0, 0.5, 0]},
        ending={"max_impacts": 20},
    )
    law = OwnLaw(errs, tolerance=1e-8)
    toss = analytic.toss(case, law=law)
    assert len(toss.impacts) == 20
    energy = toss.impacts.energy_change / (case.coin.mass * case.gravity * case.coin.radius)
    assert of(toss, "impacts: energy that this law adds, in all") == pytest.approx(energy.sum(), rel=1e-6)
    assert energy.sum() > 0
    assert analytic.toss(case.replace("floor.restitution", 0.3), law=law).ending == Ending.PAPER
    with pytest.raises(ValueError, match=r"^law errs: adds .* \(max_restitution = 1, tolerance = 5e-10\)$"):
        OwnLaw(errs, tolerance=5e-10)


@pytest.mark.parametrize(
    ("given", "error", "says"),
    [
        ({"max_restitution": 1.1}, ValueError, r"^max_restitution = 1.1: accepted: a number from 0 to 1$"),
        ({"max_restitution": "1"}, TypeError, r"^max_restitution: of type str, accepted: a number from 0 to"),
        ({"tolerance": 0.0}, ValueError, r"^tolerance = 0.0: accepted: a number from 1e-10 to 0.001$"),
        ({"tolerance": float("nan")}, ValueError, r"^tolerance = nan: accepted: a number from 1e-10 to 0.0"),
        ({"tolerance": True}, TypeError, r"^tolerance: of type bool, accepted: a number from 1e-10 to 0.001"),
    ],
)
def test_how_far_a_law_is_meant_is_a_number_in_its_range(given, error, says):
    with pytest.raises(error, match=says):
        OwnLaw(smooth, **given)
