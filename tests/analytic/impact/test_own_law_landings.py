"""Every landing asks a law of one's own, flat, on the edge or turning; no restitution but its own counts."""

# ruff: noqa: ARG001

from functools import cache
from operator import attrgetter

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import OwnLaw, solve
from cointoss.models.certificate import IMPACT_ENERGY, LAW, MOMENTUM
from cointoss.models.laws import EndingTest
from cointoss.models.records import Ending
from tests.helpers.draws import THIN, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.own_laws import FREE, of, smooth, superball

OFF = {**ZLOTY, "center_of_mass": [1e-3, -2e-3, 3e-4]}
EDGEWISE = {**ZLOTY, "thickness": 0.03}
HEADS, TAILS, UPRIGHT = [1, 0, 0, 0], [0, 0.6, 0.8, 0], [0.5**0.5, 0.5**0.5, 0, 0]
TURNED = [0.8, 0, 0, 0.6]

made, superball = cache(OwnLaw), cache(superball)


def pushes_along_the_edge(K, v_A, tau, chi, mu):
    """v_Az' = -v_Az/(1 - v_Az), and A gains 1 mm/s for each m/s of its approach, to one side of the edge."""
    along = 1e-3 * v_A[2]
    return solve(K, (along * tau[0], along * tau[1], -(1 + 1 / (1 - v_A[2])) * v_A[2]))


FLAT = (
    (OFF, HEADS, [0, 0, 0], 5e-6**0.5),
    (OFF, TAILS, [0, 0, 0], 5e-6**0.5),
    *((coin, e, [0, 0, 3], 0.0) for coin in (THIN, ZLOTY) for e in (HEADS, TAILS, TURNED)),
)
EDGE = (
    (EDGEWISE, UPRIGHT, [0, 0, 0], 0.0125),
    *((coin, e, [3, 4, 0], 0.0125) for coin in (THIN, ZLOTY) for e in (HEADS, TAILS)),
)


@pytest.mark.parametrize(("coin", "quaternion", "spin", "distance"), [*FLAT, *EDGE])
def test_a_coin_rebounds_by_the_law_however_it_lands(coin, quaternion, spin, distance):
    """On a point so far from the axis; flat, without an edge. What turns touches at once, before it tilts."""
    release = {"velocity": [0, 0, -2], "quaternion": quaternion, "angular_velocity": spin}
    release["position"] = [0, 0, coin["thickness"] / 2 if spin[0] else 0.3]
    case = scenario(coin=coin, release=release, ending={"test": "lying", "max_impacts": 5})
    toss = analytic.toss(case, law=made(pushes_along_the_edge, **FREE))
    before, after = toss.impacts.contact_velocity_before, toss.impacts.contact_velocity_after
    has_edge, bound = (True, 1e-12) if distance == 0.0125 else (False, 1e-14)
    pushed = np.linalg.norm((after - before)[0, :2])
    assert np.linalg.norm(toss.impacts.point[0, :2]) == pytest.approx(distance, rel=1e-12)
    assert after[:, 2] == pytest.approx(before[:, 2] / (before[:, 2] - 1), rel=1e-12)
    assert pushed == pytest.approx(-1e-3 * before[0, 2] * has_edge, rel=1e-9)
    assert max(of(toss, LAW), of(toss, MOMENTUM)) < bound
    assert has_edge or toss.trusted_impacts == len(before) == 5


RELEASE = draw_release(np.random.default_rng(7))
SLIDING = {"position": [0, 0, 0.3], "velocity": [0.3, -0.2, 0]}
WHEEL = {
    "coin": THIN,
    "release": {"velocity": [0.3, 0, 0], "quaternion": UPRIGHT, "angular_velocity": [0, 0, 70]},
}
"""A thin coin upright that turns about its normal as it falls: below C touches A, and K is diagonal."""


@pytest.mark.parametrize(
    ("along", "up", "parts"),
    [
        *((along, up, WHEEL) for along, up in ((0.76, 0.9), (0.0, 0.9), (-1.0, 0.8), (1.0, 0.5))),
        (0.5, 0.8, {"coin": ZLOTY, "release": SLIDING}),
        (0.5, 0.8, {"coin": OFF, "release": SLIDING}),
        *((chi, chi, {"coin": coin, "release": RELEASE}) for coin in (THIN, OFF) for chi in (1.0, 0.6)),
    ],
)
def test_a_superball_gives_back_parts_of_slip_and_approach_and_no_energy_but_the_work(along, up, parts):
    """None of one part of all: its work is -(1 - chi^2)/2 v_A . K^-1 v_A."""
    allowed = {"may_pull": True, "may_add_energy": along != up}
    case = scenario(**parts, ending={"test": "lying", "max_impacts": 12})
    toss = analytic.toss(case, law=made(superball(along, up), **allowed))
    before, after = toss.impacts.contact_velocity_before, toss.impacts.contact_velocity_after
    assert len(before) >= 3
    assert after == pytest.approx(before * [-along, -along, -up], rel=1e-12, abs=1e-12)
    assert max(of(toss, name) for name in (LAW, MOMENTUM, IMPACT_ENERGY)) < 1e-12


END = attrgetter("outcome", "ending", "end_time", "trusted_impacts", "outcome_certain")


def gives_back_eight_tenths(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -1.8 * v_A[2] / K[2][2]


@pytest.mark.parametrize("test", list(EndingTest))
@pytest.mark.parametrize("seed", [5, 6])
def test_of_the_scenarios_restitution_only_the_law_makes_use(test, seed):
    """Impacts chatter by what the law gives back: a law that is not asked for chi gives one toss for all."""
    rng = np.random.default_rng(seed)
    parts = {"coin": draw_coin(rng), "release": draw_release(rng)}
    case = scenario(**parts, floor={"restitution": 0.8}, ending={"test": str(test), "max_impacts": 3000})
    known = analytic.toss(case, law=made(smooth))
    for chi in (0.0, 1.0):
        toss = analytic.toss(case.replace("floor.restitution", chi), law=made(gives_back_eight_tenths))
        assert np.array_equal(toss.impacts.time, known.impacts.time)
        assert END(toss) == END(known)
    assert known.ending == Ending.CHATTER or test != EndingTest.LYING
