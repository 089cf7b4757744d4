"""The study of spun coins: what it counts, its symmetry, and claims that a coin as is told would change."""

import pytest

from cointoss_reproduction.frame.cells import read_table
from cointoss_reproduction.studies.spun.study import spun
from saved import missed, saved


@pytest.mark.parametrize(
    ("scatter", "engine", "spins"), [(1.0, "analytic", 2), (10.0, "analytic", 4), (1.0, "mujoco", 1)]
)
def test_a_small_run_spins_every_coin(scatter, engine, spins):
    found = spun(0.4e-3, scatter, 1e-4, 0.3, 120.0, engine, parts=500, by_mujoco=1)
    assert found is not None
    assert found["tosses"] == spins


@pytest.mark.parametrize(
    ("tails", "first"), [(0.8, "a spun cent whose mass centre"), (0.5, "where friction stops the slip")]
)
def test_coins_that_show_tails_otherwise_would_be_seen(tails, first):
    """As is told, and without any preference."""
    cells = read_table(saved("spun") / "cells.csv")
    shown = (tails * cells.faces).astype(int)
    assert missed("spun", cells.assign(tails=shown, heads=cells.faces - shown))[0].startswith(first)
