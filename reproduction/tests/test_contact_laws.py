"""The study of the contact laws: its page, its numbers, its closed forms, and that its check can fail."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from cointoss.analytic.impact.laws import delassus
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.vectors import apply
from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.studies.contact_laws import impacts as contact_study
from cointoss_reproduction.studies.contact_laws.impacts import (
    COINS,
    COUNT,
    LAWS,
    RESTITUTIONS,
    SEED,
    ContactRecord,
    Drawn,
    body_of,
    record_of,
    rules_of,
)
from cointoss_reproduction.studies.contact_laws.random_impacts import draw_states
from cointoss_reproduction.studies.contact_laws.study import kane_onset, sliding_onset
from cointoss_reproduction.studies.contact_laws.thresholds import (
    onset_of_gain,
    onset_without_solution,
    touching_state,
)
from saved import missed, saved

SAVED = read_numbers(saved("contact-laws"), ContactRecord)


def test_the_saved_numbers_are_of_the_full_size():
    assert (SAVED.count, SAVED.seed) == (COUNT, SEED)


def drawn_impacts(count):
    rng = np.random.default_rng(5)
    drawn = []
    for coin in COINS:
        body = body_of(coin)
        states = draw_states(body, rules_of("smooth"), count, rng)
        drawn.append(Drawn(body, states, rng.uniform(0, 1, count)))
    return drawn


@pytest.fixture(scope="module")
def few():
    return drawn_impacts(500)


@pytest.mark.parametrize("law", LAWS)
def test_fewer_impacts_of_another_seed_give_the_saved_shares(few, law):
    record, saved = record_of(rules_of(law), few), SAVED.laws[law]
    for name in ("gains", "pulls", "leaves_cone", "without_solution"):
        ours, theirs = np.array(getattr(record, name)), np.array(getattr(saved, name))
        # Five standard deviations of a share of 2000; at least four impacts where it is small.
        spread = 5 * np.sqrt(theirs * (1 - theirs) / 2000) + 4 / 2000
        assert np.all(np.abs(ours - theirs) < spread), name
    assert len(record.gains) == len(RESTITUTIONS)


def test_the_impacts_drawn_come_down_and_turn():
    for drawn in drawn_impacts(300):
        assert drawn.states.shape == (300, 13)
        assert np.linalg.norm(drawn.states[:, 6:10], axis=1) == pytest.approx(1, abs=1e-15)
        assert np.abs(drawn.states[:, 3:6]).max() == pytest.approx(1, abs=0.05)
        assert np.abs(drawn.states[:, 10:13]).max() == pytest.approx(100, abs=5)


@pytest.mark.parametrize("law", ["sharp_edge", "perfectly_rough"])
def test_the_thin_ideal_coin_gains_energy_from_a_third_of_root_five_on(law):
    onset = onset_of_gain(body_of("thin ideal"), rules_of(law), 0.0, 1)
    assert onset == pytest.approx(5**0.5 / 3, abs=1e-10)


def test_sliding_friction_loses_its_solution_at_half_of_root_five():
    onset = onset_without_solution(body_of("thin ideal"), rules_of("sliding_friction"), 1)
    assert onset == pytest.approx(5**0.5 / 2, abs=1e-10)


def test_kanes_onset_is_the_closed_form():
    for mu in (0.25, 0.9):
        onset = onset_of_gain(body_of("thin ideal"), rules_of("coulomb, kinematic"), mu, 1)
        assert onset == pytest.approx(kane_onset(mu), abs=1e-9)
    assert kane_onset(0.9) == pytest.approx(5**0.5 / 3, rel=1e-15)
    assert kane_onset(1e-4) == pytest.approx(1, abs=1e-7)
    assert kane_onset(2 / 3 - 1e-12) == pytest.approx(kane_onset(2 / 3), abs=1e-11)


def test_the_onset_of_sliding_friction_is_the_closed_form():
    # The slip found is 1e-8 of the normal speed, and not none.
    onset = onset_of_gain(body_of("thin ideal"), rules_of("sliding_friction"), 0.25, 1)
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


def changed(law, **columns):
    return replace(SAVED, laws={**SAVED.laws, law: replace(SAVED.laws[law], **columns)})


def test_a_number_that_contradicts_a_claim_fails_it():
    assert len(missed("contact-laws", changed("smooth", largest_change=[1e-9] * 10))) == 1
    assert len(missed("contact-laws", changed("knurled", gains=[0.0] * 10))) == 1
    assert len(missed("contact-laws", changed("perfectly_rough", gains_by_coin=[[1e-3] * 10] * 4))) == 1
    assert len(missed("contact-laws", changed("smooth", pulls=[0.1] * 10))) == 1
    assert len(missed("contact-laws", changed("sharp_edge", leaves_cone=[0.0] * 10))) == 1
    onsets = asdict(SAVED.onsets)
    for name, wrong in (
        ("perfectly_rough", {**onsets["perfectly_rough"], "thin ideal": 0.74}),
        ("without_solution", {**onsets["without_solution"], "thin ideal": 1.11}),
        ("coulomb", [1.0] * len(onsets["coulomb"])),
    ):
        damaged = replace(SAVED, onsets=replace(SAVED.onsets, **{name: wrong}))
        assert len(missed("contact-laws", damaged)) == 1


@pytest.mark.slow
def test_the_saved_numbers_are_those_of_a_new_run():
    shown = []
    again = contact_study.compute(lambda done, parts: shown.append((done, parts)))
    assert shown[-1][0] == shown[-1][1] == len(shown)
    for law, record in asdict(again)["laws"].items():
        for name, values in record.items():
            saved = getattr(SAVED.laws[law], name)
            if name in ("median_gain", "largest_change", "friction_for_half", "friction_for_most"):
                # Of one impact or two; other rounding may choose a neighbour.
                expected = np.array(saved, dtype=float)
                assert np.array(values, float) == pytest.approx(expected, rel=1e-3, abs=1e-12, nan_ok=True)
            else:  # shares: two impacts of 5000 of one coin may fall on the other side
                assert np.array(values) == pytest.approx(np.array(saved), abs=4e-4)
    for name, values in asdict(again)["onsets"].items():
        assert values == pytest.approx(getattr(SAVED.onsets, name), abs=1e-7)
