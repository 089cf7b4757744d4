"""How far two sequences agree, and must."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss import analytic
from cointoss.compare.metrics.sequences import agreement_horizon, common_prefix
from tests.helpers.draws import AIR, scenario

TOSS = analytic.toss(
    scenario(
        release={"angles": [0.0, 0.122, 0.0], "angular_velocity": [0.0, 40.15, 0.0]},
        air=AIR,
    )
)
COUNT = len(TOSS.impacts)


@pytest.mark.parametrize(
    ("first", "second", "shared"),
    [("HHTH", "HHTT", 3), ("HH", "HHTT", 2), ("T", "H", 0), ("", "H", 0)],
)
def test_sequences_share_their_leading_symbols(first, second, shared):
    assert common_prefix(first, second) == common_prefix(second, first) == shared


def test_the_horizon_shrinks_with_the_error():
    horizons = [agreement_horizon(TOSS, np.full(COUNT, error)) for error in (1e-15, 1e-6, 1e-3, 0.3)]
    assert horizons[0] == COUNT
    assert horizons == sorted(horizons, reverse=True)
    assert horizons[-1] < COUNT / 2


@pytest.fixture
def tried(monkeypatch):
    """The scenarios that are tossed to find a horizon."""
    cases, toss = [], analytic.toss
    monkeypatch.setattr(analytic, "toss", lambda case: cases.append(case) or toss(case))
    return cases


@pytest.mark.parametrize("wrong", [0.5, 0.7, np.inf])
def test_no_face_must_be_shared_after_an_impulse_that_is_as_wrong_as_none(tried, wrong):
    assert agreement_horizon(TOSS, np.array([1e-15, 1e-15, wrong, 0.0, 0.0])) == 3
    assert len(tried) == 4, "nothing is tossed after it"


def test_impulses_are_tried_with_twice_the_largest_error_so_far_to_both_sides(tried):
    errors, impacts = np.array([1e-8, 3e-8, 2e-8]), TOSS.impacts
    assert agreement_horizon(TOSS, errors) == 3
    assert [case.rules.max_impacts for case in tried] == [2, 2, 1, 1, 1, 1]
    for i, case in enumerate(tried):
        at, most = i // 2, (1 - i % 2 * 2) * 2 * [1e-8, 3e-8, 3e-8][i // 2]
        for name in ("velocity", "angular_velocity"):
            before, after = (getattr(impacts, f"{name}_{when}")[at] for when in ("before", "after"))
            assert getattr(case.release, name) - after == pytest.approx(
                most * (after - before), rel=1e-5, abs=1e-14
            )


def test_touches_are_tried_as_much_earlier_and_later_as_they_may_be(tried):
    """The coin has turned about its ω by then, and touches at once: its rim is below C."""
    late, impacts, coin = np.array([2e-6, 1e-6, 1e-6]), TOSS.impacts, TOSS.scenario.coin
    assert agreement_horizon(TOSS, np.full(3, 1e-13), late) == 3
    assert [case.rules.max_impacts for case in tried] == [2, 2, 3, 3, 1, 1, 2, 2, 1, 1, 1, 1]
    for at, first in ((0, 2), (1, 6), (2, 10)):
        for sign, case in zip((1, -1), tried[first : first + 2], strict=True):
            turned = Rotation.from_rotvec(sign * 2e-6 * impacts.angular_velocity_before[at])
            due = Rotation.from_quat(impacts.quaternion[at], scalar_first=True) * turned
            found = Rotation.from_quat(case.release.attitude, scalar_first=True)
            assert (found.inv() * due).magnitude() < 1e-12
            cosine = due.as_matrix()[2, 2]
            rim = coin.radius * np.sqrt(1 - cosine**2) + coin.thickness / 2 * abs(cosine)
            assert case.release.position[2] - rim == pytest.approx(1e-9 * coin.radius, abs=1e-15)
            assert case.release.velocity == tuple(impacts.velocity_before[at])
    assert agreement_horizon(TOSS, np.full(9, 1e-15), np.full(9, 1e-15)) == 9, "over the first tails, too"
