"""Plain counting: the exact share, tosses counted apart, and pieces."""

from types import SimpleNamespace

import numpy as np
import pytest

from cointoss import analytic
from cointoss_reproduction.frame.cells import read_table
from cointoss_reproduction.setups.edge_classes import DIAMETRAL
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows
from cointoss_reproduction.setups.uncertain_shares import SMOOTH
from cointoss_reproduction.studies.plain_counting import study as plain_counting
from cointoss_reproduction.studies.plain_counting.study import (
    COINS,
    FINEST,
    SEED,
    caught,
    exact_share,
    on_edge,
    turned_over,
    uncertain,
)
from saved import DOCS, saved

THICK = COINS[f"h/D = 0.6, {DIAMETRAL}"]


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_the_exact_share_is_that_of_the_faces_on_a_grid(accuracy):
    caught_at, gravity = 0.1, 9.81
    z, spin = np.meshgrid(np.linspace(*HEIGHTS, 4001), np.linspace(*SPINS, 1001))
    lower, middle, upper = (
        np.cos(spin * np.sqrt(2 * (z + step - caught_at) / gravity)) > 0 for step in (-accuracy, 0, accuracy)
    )
    on_grid = np.mean((lower != middle) | (upper != middle))
    assert exact_share(caught_at, accuracy, gravity) == pytest.approx(on_grid, rel=5e-3)


def test_counted_shares_hold_the_exact_ones_and_not_those_of_twice_the_change():
    first, *_, last = rows = list(caught(0.1, tosses=6_000))
    assert [row["left_out"] for row in rows] == [0] * len(rows)
    twice = exact_share(0.1, 2 * first["accuracy"], 9.81)
    assert not first["share"].low <= twice <= first["share"].high
    # It goes on until the count runs dry.
    assert (last["changed"], last["share"].value) == (0, 0.0)


def test_a_toss_is_counted_where_it_ends_otherwise_lower_or_higher():
    scenario, tosses = case(air=False), 500
    rng = np.random.default_rng(SEED)
    z, spin = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    found = {row["accuracy"]: row["changed"] for row in turned_over(scenario, tosses)}
    for accuracy in (1e-3, 1e-6):
        lower, middle, upper = (
            analytic.toss_rows(planar_rows(scenario, z + step, spin)).outcome
            for step in (-accuracy, 0.0, accuracy)
        )
        assert found[accuracy] == np.sum((lower != middle) | (upper != middle)) > 0


def test_counts_stand_beside_what_other_studies_have_kept(tmp_path):
    rows = {row["accuracy"]: row for row in uncertain(SMOOTH, 0.6, tosses=400, out=DOCS)}
    row = rows[1e-6]
    assert row["over_branching"].value == row["share"].value / row["branching"].value
    assert row["over_chain"].value == row["share"].value / row["chain"].value
    assert rows[1e-5]["over_branching"] is None, "kept without an interval"
    (alone, *_) = uncertain(SMOOTH, 0.6, tosses=100, out=tmp_path)
    assert (alone["branching"], alone["over_chain"]) == (None, None)


def test_coins_on_edge_are_counted_in_pieces_beside_those_before(monkeypatch):
    monkeypatch.setattr(plain_counting, "PIECE", 60)
    row = on_edge(THICK, tosses=1500, out=DOCS)
    assert (row["coins"], row["on_edge"].count) == (150, 150)
    assert 0 < row["edges"] < 60
    assert row["before"].count == 4000
    assert 1e-4 < row["chance"] < 1
    assert on_edge(THICK, tosses=10)["chance"] is None


def test_all_tosses_are_made_whatever_the_pieces(monkeypatch):
    asked = []

    def toss_many(_scenario, vary, **_):
        count = len(vary["release.position.z"])
        asked.append(count)
        return SimpleNamespace(outcome=SimpleNamespace(to_numpy=lambda: np.full(count, "heads")))

    monkeypatch.setattr(plain_counting, "toss_many", toss_many)
    monkeypatch.setattr(plain_counting, "PIECE", 40)
    (row,) = turned_over(case(air=False), 100)
    assert (row["changed"], row["tosses"]) == (0, 100)
    levels = round(np.log10(1e-3 / FINEST)) + 1
    assert sum(asked) == 100 * (1 + 2 * levels)
    assert max(asked) == 40


def test_an_interrupted_batch_is_not_counted(monkeypatch):
    ended = SimpleNamespace(outcome=SimpleNamespace(to_numpy=lambda: np.array(["heads", "not_tossed"])))
    monkeypatch.setattr(plain_counting, "toss_many", lambda *_, **__: ended)
    with pytest.raises(KeyboardInterrupt):
        list(turned_over(case(air=False), 2))


def test_without_the_other_studies_the_comparison_is_open():
    cells = read_table(saved("plain-counting") / "cells.csv")
    named = ("branching", "chain", "over_branching", "over_chain", "before", "chance")
    found = plain_counting.found(cells.drop(columns=[*named]))
    assert found["uncounted"] == plain_counting.UNCOUNTED
    assert found["over_chain"] == {}
