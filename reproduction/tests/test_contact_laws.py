"""The study of the contact laws: its impacts, and its closed forms."""

from functools import cache

import numpy as np
import pytest

from cointoss.analytic.impact.laws import delassus
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.vectors import apply
from cointoss_reproduction.frame.cells import Cells, table_of
from cointoss_reproduction.studies.contact_laws.study import (
    COINS,
    KINEMATIC,
    LAWS,
    ROUGH,
    SHARP,
    SLIDING,
    body_of,
    drawn_impacts,
    impacts,
    kane_onset,
    rules_of,
    sliding_onset,
)
from cointoss_reproduction.studies.contact_laws.thresholds import (
    onset_of_gain,
    onset_without_solution,
    touching_state,
)
from saved import unseen


@cache
def cells():
    return table_of([Cells(impacts, {"law": tuple(LAWS)})], unseen, {"count": 2000, "seed": 5})


def test_the_impacts_drawn_come_down_and_turn():
    for drawn in drawn_impacts(1200, 5).values():
        assert drawn.states.shape == (300, 13)
        assert np.linalg.norm(drawn.states[:, 6:10], axis=1) == pytest.approx(1, abs=1e-15)
        assert np.abs(drawn.states[:, 3:6]).max() == pytest.approx(1, abs=0.05)
        assert np.abs(drawn.states[:, 10:13]).max() == pytest.approx(100, abs=5)


def test_what_the_impacts_of_all_coins_do_is_what_those_of_each_do():
    counts = ["impacts", "gains", "pulls", "leaves", "unsolved"]
    of_coins = cells()[cells().coin.isin(COINS)].groupby(["law", "chi"])[counts].sum()
    of_all = cells()[cells().coin == "all"].groupby(["law", "chi"])[counts].sum()
    assert np.all(of_coins == of_all)


@pytest.mark.parametrize("law", [SHARP, ROUGH])
def test_the_thin_ideal_coin_gains_energy_from_a_third_of_root_five_on(law):
    onset = onset_of_gain(body_of("thin ideal"), rules_of(law), 0.0, 1)
    assert onset == pytest.approx(5**0.5 / 3, abs=1e-10)


@pytest.mark.slow
def test_sliding_friction_loses_its_solution_at_half_of_root_five():
    onset = onset_without_solution(body_of("thin ideal"), rules_of(SLIDING), 1)
    assert onset == pytest.approx(5**0.5 / 2, abs=1e-10)


def test_kanes_onset_is_the_closed_form():
    for mu in (0.25, 0.9):
        onset = onset_of_gain(body_of("thin ideal"), rules_of(KINEMATIC), mu, 1)
        assert onset == pytest.approx(kane_onset(mu), abs=1e-9)
    assert kane_onset(0.9) == pytest.approx(5**0.5 / 3, rel=1e-15)
    assert kane_onset(1e-4) == pytest.approx(1, abs=1e-7)
    assert kane_onset(2 / 3 - 1e-12) == pytest.approx(kane_onset(2 / 3), abs=1e-11)


def test_the_onset_of_sliding_friction_is_the_closed_form():
    # The slip found is 1e-8 of the normal speed, and not none.
    onset = onset_of_gain(body_of("thin ideal"), rules_of(SLIDING), 0.25, 1)
    assert onset == pytest.approx(sliding_onset(0.25), abs=1e-7)
    assert sliding_onset(0.0) == 1
    assert sliding_onset(5**-0.5 - 1e-9) == pytest.approx(0, abs=1e-8)
    assert sliding_onset(0.5) == 0


@pytest.mark.parametrize("tilt", [0.3, np.pi / 4, 1.3])
def test_the_delassus_matrix_of_the_thin_ideal_coin_is_that_of_the_closed_forms(tilt):
    body = body_of("thin ideal")
    R = rotation_matrix(tuple(touching_state(tilt, 0.0)[6:10]))
    point, _ = lowest_point(body, R[2], (0.0, 0.0, 0.0))
    K, t = np.array(delassus(body, R, apply(R, point))), np.tan(tilt)
    expected = np.array([1 + 5 * t**2, 5 + t**2, 4 * t]) / (1 + t**2)
    assert body.mass * np.abs([K[1, 1], K[2, 2], K[1, 2]]) == pytest.approx(expected, rel=1e-12)
    assert body.mass * K[0] == pytest.approx([3, 0, 0], abs=1e-12)
