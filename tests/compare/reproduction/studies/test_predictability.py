"""The study of predictability: its measures on made shares, and that it resumes."""

import numpy as np
import pytest
from scipy.stats import norm

from cointoss.compare.reproduction.setups import uncertain_shares
from cointoss.compare.reproduction.studies import predictability
from cointoss.compare.reproduction.studies.predictability import (
    ACCURACIES,
    CEILING,
    SMOOTH,
    Case,
    accuracy_for,
    compute,
    flat_share,
    mean_shares,
    parting,
    share_at,
    slope_between,
    smooth_from,
)


def made(shares, parted=None, groups=20):
    scatter = np.random.default_rng(1).lognormal(sigma=0.1, size=(groups, len(shares)))
    one = np.ones((groups, len(shares)))
    return Case(
        SMOOTH,
        0.6,
        "height",
        shares=(shares * scatter).tolist(),
        whole=one.tolist(),
        parted=(one * (shares if parted is None else parted)).tolist(),
        energy=one.tolist(),
        boundaries=(2 * one).astype(int).tolist(),
        flat=(one.T * (np.arange(groups) % 2)).T.astype(int).tolist(),
        tosses=0,
        undecided=0,
    )


def test_measures_of_a_share_that_turns_from_a_fractals_to_a_smooth_boundarys():
    turn = 1e-12
    shares = np.where(ACCURACIES > turn, (ACCURACIES / turn) ** 0.4, ACCURACIES / turn) * 1e-4
    one = made(shares)
    assert share_at(one, 1e-6).low < shares[3] < share_at(one, 1e-6).high
    slope = slope_between(one, 1e-6, 1e-9)
    assert slope.low < 0.4 < slope.high < 0.6
    assert slope_between(one, 1e-18, 1e-24).value == pytest.approx(1, abs=0.05)
    assert smooth_from(one) == pytest.approx(turn, rel=0.01)
    # (ε/1e-12)^0.4 1e-4 = 0.01 at 1e-7.
    assert accuracy_for(one, 0.01) == pytest.approx(1e-7, rel=0.5)
    assert np.isinf(accuracy_for(one, 0.9))
    flat = flat_share(one, 1e-9)
    assert flat is not None
    assert flat.value == pytest.approx(0.25)
    assert flat.low < 0.25 < flat.high


def test_a_share_is_within_its_interval_and_below_that_of_independent_tosses():
    one = made(np.full(len(ACCURACIES), 0.8))
    assert (mean_shares(one) <= CEILING).all()
    for accuracy in (1e-3, 1e-16):
        found = share_at(one, accuracy)
        assert found.low <= found.value <= found.high <= CEILING
    # All weight grows as f does: their ratio is f.
    grown = made(np.full(len(ACCURACIES), 0.6))
    grown.whole[:] = (1.2 * np.array(grown.whole)).tolist()
    assert share_at(grown, 1e-9).value == pytest.approx(0.5, rel=0.1)


def test_where_tosses_part_were_it_normal_is_where_the_tail_of_a_normal_distribution_falls_so_fast():
    distribution = norm(10, 1.5)
    one = made(distribution.sf(-np.log10(ACCURACIES)))
    found = parting(one)
    assert (found.mean, found.spread) == pytest.approx((10, 1.5), rel=0.02)
    x = -np.log10(found.smooth_from)
    step = 1e-3
    slope = (distribution.logsf(x) - distribution.logsf(x + step)) / np.log(10) / step
    # The tail falls somewhat faster than by (x - mean)/spread².
    assert 0.9 < slope < 1.15


def test_a_computation_goes_on_where_it_was(tmp_path, monkeypatch):
    monkeypatch.setattr(predictability, "OTHERS", {"spin": predictability.SPIN})
    told = []
    arguments = {"runs": {SMOOTH: 2}, "population": 6, "chis": {SMOOTH: (0.3,)}, "levels": 6}
    first = compute(lambda *done: told.append(done), tmp_path, **arguments)
    assert told == [(n, 4) for n in range(1, 5)]
    monkeypatch.setattr(uncertain_shares, "uncertain_shares", None)
    assert compute(lambda *_: None, tmp_path, **arguments) == first
    assert all(0 < share < 1 for share in mean_shares(first.cases[0])[:2])
    assert 1e-17 < first.quantum_width < 1e-15
