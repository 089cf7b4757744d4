"""The study of predictability: its measures on made shares, and its cell."""

from collections import ChainMap
from dataclasses import replace

import numpy as np
import pytest

from cointoss_reproduction.frame.cells import Cells, table_of
from cointoss_reproduction.frame.declared import filled, said_by
from cointoss_reproduction.precision.branching import GROUPS, Branches
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES, CEILING, flat_share, share_at
from cointoss_reproduction.studies.predictability import study as predictability
from cointoss_reproduction.studies.predictability.picture import quantum_width
from cointoss_reproduction.studies.predictability.study import (
    SMOOTH,
    accuracy_for,
    of_each,
    uncertain,
)
from saved import unseen

FEW_CHIS = {SMOOTH: (0.0, 0.6), "smooth, air": (0.6,), "rough, vacuum": (0.6,)}
X = -np.log10(ACCURACIES)


def groups_of(shares, parted=None):
    scatter = np.random.default_rng(1).lognormal(sigma=0.1, size=(GROUPS, len(shares)))
    one = np.ones((GROUPS, len(shares)))
    return Branches(
        shares=shares * scatter,
        whole=one,
        parted=one * (shares if parted is None else parted),
        energy=one,
        boundaries=(2 * one).astype(int),
        flat=(one.T * (np.arange(GROUPS) % 2)).T.astype(int),
        tosses=7,
        undecided=0,
    )


def test_measures_of_a_share_that_turns_from_a_fractals_to_a_smooth_boundarys():
    turn, accuracies = 1e-12, np.array(ACCURACIES)
    shares = np.where(accuracies > turn, (accuracies / turn) ** 0.4, accuracies / turn) * 1e-4
    rows = list(of_each(groups_of(shares)))
    f = [row["share"].value for row in rows]
    assert rows[3]["share"].low < shares[3] < rows[3]["share"].high
    assert rows[3]["window"] == "1e-06 to 1e-09"
    assert rows[3]["alpha"].low < 0.4 < rows[3]["alpha"].high < 0.6
    (*_, last) = [row["alpha"] for row in rows if row["alpha"]]
    assert last.value == pytest.approx(1, abs=0.05)
    # (ε/1e-12)^0.4 1e-4 = 0.01 at 1e-7.
    assert accuracy_for(X, f, 0.01) == pytest.approx(1e-7, rel=0.5)
    assert np.isinf(accuracy_for(X, f, 0.9))
    assert np.isnan(accuracy_for(X, f, 1e-30))
    flat = rows[6]["flat"]
    assert flat.value == pytest.approx(0.25)
    assert flat.low < 0.25 < flat.high


def test_a_share_is_within_its_interval_and_below_that_of_independent_tosses():
    rows = list(of_each(groups_of(np.full(len(ACCURACIES), 0.8))))
    for row in rows:
        assert row["share"].low <= row["share"].value <= row["share"].high <= CEILING
    # All weight grows as f does: their ratio is f.
    grown = groups_of(np.full(len(ACCURACIES), 0.6))
    grown = replace(grown, whole=1.2 * grown.whole)
    assert share_at(grown.shares, grown.whole, 6).value == pytest.approx(0.5, rel=0.1)


def test_of_a_share_that_no_ancestor_met_nothing_is_known():
    rows = list(of_each(groups_of(np.where(np.arange(len(ACCURACIES)) < 5, 0.1, 0.0))))
    assert (rows[6]["share"].low, rows[6]["share"].high) == (0, CEILING)
    assert rows[3]["alpha"].low < -1e9
    assert rows[3]["alpha"].high > 1e9


def test_boundaries_of_few_groups_are_no_share():
    found = groups_of(np.full(len(ACCURACIES), 0.2))
    assert flat_share(found, 6) is not None
    few = np.where(np.arange(GROUPS)[:, None] < 4, found.boundaries, 0)
    assert flat_share(replace(found, boundaries=few, flat=few), 6) is None
    seventh = np.where(np.arange(len(ACCURACIES)) == 7, found.boundaries, 0)
    alone = [flat_share(replace(found, boundaries=seventh), level) is None for level in range(5, 10)]
    assert alone == [True, False, False, False, True], "those of the neighbours count too"


def test_spin_and_tilt_vary_where_the_papers_coin_bounces_on_a_smooth_floor(monkeypatch):
    asked = []

    def shares(_scenario, _rng, **sizes):
        asked.append(sizes)
        return groups_of(np.full(len(ACCURACIES), 0.2))

    monkeypatch.setattr(predictability, "uncertain_shares", shares)
    assert uncertain(SMOOTH, 0.3, "spin") is None
    assert uncertain("smooth, air", 0.2, "height") is None
    found = uncertain(SMOOTH, 0.6, "spin", parts=10)
    assert found is not None
    assert [row["accuracy"] for row in found] == list(ACCURACIES)
    assert found[-1]["tosses"] == 7
    assert asked == [{"quantity": "spin", "levels": 22, "population": 120, "followed": 0}]
    uncertain(SMOOTH, 0.9, "height")
    assert asked[-1] == {"quantity": "height", "levels": 22, "population": 300, "followed": 24}
    assert 1e-17 < quantum_width() < 1e-15


def test_claims_are_of_the_windows_that_a_run_has(monkeypatch):
    monkeypatch.setattr(
        predictability,
        "uncertain_shares",
        lambda _scenario, _rng, *, levels, **_: groups_of(10.0 ** -np.arange(1, levels + 1)),
    )
    for sizes, last, bouncy in (({}, 1e-18, 1), ({"levels": 14, "chis": FEW_CHIS}, 1e-9, 0)):
        cells = table_of([Cells(uncertain, predictability.AXES)], unseen, sizes)
        found = predictability.found(cells)
        assert (found["last"], len(found["bouncy"])) == (last, bouncy)
        names = ChainMap(found, dict(vars(predictability)))
        claims = list(filled(said_by(predictability.__name__)["claim"], names))
        assert len(claims) == 5 + bouncy
        # f falls as ε.
        assert claims[0].holds
        assert len(predictability.draw(cells).axes) == 4
