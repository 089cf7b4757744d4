"""The study of margins: its page, its measures on made margins, and that it resumes."""

import numpy as np
import pytest

from cointoss.compare.metrics.estimates import quantile
from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.studies.margins import study as margins
from cointoss_reproduction.studies.margins.study import Margins, below, compute
from saved import saved

SAVED = read_numbers(saved("margins"), Margins)


def test_fewer_tosses_are_uncertain_within_an_accuracy_than_have_a_smaller_margin():
    for accuracy, flags in SAVED.uncertain.items():
        # A change by ε is one of those that are tried.
        assert np.mean(flags) <= below(SAVED.planar, float(accuracy)).value


def test_the_interval_of_a_quantile_contains_it_as_often_as_it_says():
    rng, part = np.random.default_rng(3), 0.1
    found = [quantile(rng.uniform(size=120), part) for _ in range(2000)]
    assert np.mean([one.low <= part <= one.high for one in found]) > 0.985
    assert np.mean([one.high - one.low for one in found]) < 0.17
    few = quantile([1.0, 2.0, np.inf], 0.5)
    assert (few.low, few.value, few.high) == (-np.inf, 2.0, np.inf)


def test_a_margin_is_at_most_what_is_found_and_at_least_what_is_proved():
    parts = margins.parts_proved(SAVED)
    assert len(parts) == margins.PROOFS
    assert ((parts >= 0) & (parts <= 1)).all()
    for accuracy in margins.ACCURACIES:
        known = below(SAVED.planar[: margins.PROOFS], accuracy)
        assert known.value <= margins.not_proved_above(SAVED.proved, accuracy).value


def test_a_toss_without_a_margin_is_below_none():
    assert below([0.5, -1.0, 2.0, 0.1], 1.0).value == 0.5


def test_a_computation_goes_on_where_it_was(tmp_path, monkeypatch):
    monkeypatch.setattr(margins, "QUANTITIES", margins.QUANTITIES[:1])
    told = []
    first = compute(lambda *done: told.append(done), tmp_path, count=1, planar=20, proofs=2)
    assert told == [(1, 3), (2, 3), (3, 3)]
    monkeypatch.setattr(margins, "found_margins", None)
    assert compute(lambda *_: None, tmp_path, count=1, planar=20, proofs=2) == first
    assert 0 < np.median(first.planar) < 10
    assert 0 < first.proved[0] < first.planar[0]
    with pytest.raises(TypeError):
        compute(lambda *_: None, tmp_path, count=2, planar=20, proofs=2)
