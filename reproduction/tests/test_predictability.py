"""The study of predictability: its measures on made shares, and that it resumes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm

from cointoss_reproduction.precision.branching import Branches
from cointoss_reproduction.setups import uncertain_shares
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES, CEILING, flat_share, joined, share_at
from cointoss_reproduction.studies.predictability import study as predictability
from cointoss_reproduction.studies.predictability.record import SMOOTH, accuracy_for, parting, smooth_from
from cointoss_reproduction.studies.predictability.study import case_of, compute


def groups_of(shares, parted=None, groups=20):
    scatter = np.random.default_rng(1).lognormal(sigma=0.1, size=(groups, len(shares)))
    one = np.ones((groups, len(shares)))
    return Branches(
        shares=shares * scatter,
        whole=one,
        parted=one * (shares if parted is None else parted),
        energy=one,
        boundaries=(2 * one).astype(int),
        flat=(one.T * (np.arange(groups) % 2)).T.astype(int),
        tosses=0,
        undecided=0,
    )


def made(shares):
    return case_of(SMOOTH, 0.6, "height", [groups_of(shares)])


def test_measures_of_a_share_that_turns_from_a_fractals_to_a_smooth_boundarys():
    turn = 1e-12
    shares = np.where(ACCURACIES > turn, (ACCURACIES / turn) ** 0.4, ACCURACIES / turn) * 1e-4
    one = made(shares)
    assert one.known[1e-6].low < shares[3] < one.known[1e-6].high
    assert one.slopes[1].low < 0.4 < one.slopes[1].high < 0.6
    assert one.slopes[-1].value == pytest.approx(1, abs=0.05)
    assert smooth_from(one) == pytest.approx(turn, rel=0.01)
    # (ε/1e-12)^0.4 1e-4 = 0.01 at 1e-7.
    assert accuracy_for(one, 0.01) == pytest.approx(1e-7, rel=0.5)
    assert np.isinf(accuracy_for(one, 0.9))
    flat = one.flat[1e-9]
    assert flat.value == pytest.approx(0.25)
    assert flat.low < 0.25 < flat.high


def test_a_share_is_within_its_interval_and_below_that_of_independent_tosses():
    one = made(np.full(len(ACCURACIES), 0.8))
    assert max(one.shares) <= CEILING
    for accuracy in (1e-3, 1e-16):
        found = one.known[accuracy]
        assert found.low <= found.value <= found.high <= CEILING
    # All weight grows as f does: their ratio is f.
    grown = groups_of(np.full(len(ACCURACIES), 0.6))
    grown = replace(grown, whole=1.2 * grown.whole)
    assert share_at(grown, 1e-9).value == pytest.approx(0.5, rel=0.1)


def test_runs_are_joined_by_their_groups():
    one, other = groups_of(np.full(len(ACCURACIES), 0.2), groups=5), groups_of(np.full(len(ACCURACIES), 0.4))
    both = joined([replace(one, tosses=3), replace(other, tosses=4)])
    assert both.shares.shape == (25, len(ACCURACIES))
    assert (both.shares[:5] == one.shares).all()
    assert both.tosses == 7
    assert flat_share(both, 1e-9) is not None
    few = np.where(np.arange(25)[:, None] < 4, both.boundaries, 0)
    assert flat_share(replace(both, boundaries=few, flat=few), 1e-9) is None


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
    assert all(0 < share < 1 for share in first.cases[0].shares[:2])
    assert 1e-17 < first.quantum_width < 1e-15
