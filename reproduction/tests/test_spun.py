"""The study of spun coins: what it counts, its symmetry, and claims that a coin as is told would change."""

import numpy as np
import pytest

from cointoss import Hand, Outcome, Scenario, analytic
from cointoss.study import rows_from_states
from cointoss_reproduction.frame.cells import read_table
from cointoss_reproduction.setups.general_coins import cent
from cointoss_reproduction.studies.spun.study import spun
from saved import missed, saved


def test_a_coin_turned_over_with_its_mass_centre_shows_the_other_side():
    """A half turn about a diameter swaps the sides; ζ of C changes its sign, and so does the vertical's."""
    one, other = (
        Scenario.model_validate(cent(0.4e-3, offset=zeta, contact="coulomb", friction=0.3))
        for zeta in (1e-4, -1e-4)
    )
    hand = Hand(spun=True, psi_scatter=float(np.radians(10)), up="either")
    start = hand.states(one.body, np.random.default_rng(1), 40)
    e0, e1, e2, e3 = start[:, 6:10].T
    # e times a half turn about ξ of the body.
    attitude = np.column_stack([-e1, e0, e3, -e2])
    over = np.hstack([start[:, :6], attitude, start[:, 10:] * [1, -1, -1]])
    ended, swapped = (
        analytic.toss_rows(rows_from_states(scenario, states)).outcome
        for scenario, states in ((one, start), (other, over))
    )
    sides = {Outcome.HEADS: Outcome.TAILS, Outcome.TAILS: Outcome.HEADS}
    alike = [one == sides.get(Outcome(two), Outcome(two)) for one, two in zip(ended, swapped, strict=True)]
    # Rounding may decide a toss that goes on for long.
    assert np.mean(alike) > 0.8
    assert {Outcome.HEADS, Outcome.TAILS} <= set(ended.tolist())


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
