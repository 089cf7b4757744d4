"""The study of predictability: its page, its measures on made shares, and that it resumes."""

import numpy as np
import pytest

from cointoss.compare.reproduction.setups import uncertain_shares
from cointoss.compare.reproduction.studies import predictability
from cointoss.compare.reproduction.studies.predictability import (
    ACCURACIES,
    SMOOTH,
    Case,
    accuracy_for,
    compute,
    share_at,
    slope_from,
    smooth_from,
)


def made(shares):
    scatter = np.random.default_rng(1).lognormal(sigma=0.1, size=(8, len(shares)))
    return Case(SMOOTH, 0.6, "height", (shares * scatter).tolist(), 0.0, 0, 0)


def test_measures_of_a_share_that_turns_from_a_fractals_to_a_smooth_boundarys():
    turn = 1e-12
    shares = np.where(ACCURACIES > turn, (ACCURACIES / turn) ** 0.4, ACCURACIES / turn) * 1e-4
    one = made(shares)
    assert share_at(one, 1e-6).low < shares[3] < share_at(one, 1e-6).high
    assert slope_from(one, 1e-6).low < 0.4 < slope_from(one, 1e-6).high < 0.6
    assert slope_from(one, 1e-18).value == pytest.approx(1, abs=0.05)
    assert smooth_from(one) == pytest.approx(turn, rel=0.01)
    # (ε/1e-12)^0.4 1e-4 = 0.01 at 1e-7.
    assert accuracy_for(one, 0.01) == pytest.approx(1e-7, rel=0.5)
    assert np.isinf(accuracy_for(one, 0.9))


def test_a_computation_goes_on_where_it_was(tmp_path, monkeypatch):
    monkeypatch.setattr(predictability, "OTHERS", {"spin": predictability.SPIN})
    told = []
    arguments = {"runs": {SMOOTH: 2}, "population": 6, "chis": {SMOOTH: (0.3,)}, "levels": 6}
    first = compute(lambda *done: told.append(done), tmp_path, **arguments)
    assert told == [(n, 4) for n in range(1, 5)]
    monkeypatch.setattr(uncertain_shares, "uncertain_shares", None)
    assert compute(lambda *_: None, tmp_path, **arguments) == first
    assert all(0 < share < 1 for run in first.cases[0].shares for share in run[:2])
    assert 1e-17 < first.quantum_width < 1e-15
