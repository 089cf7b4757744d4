"""The study of spun coins: what it counts, its symmetry, and claims that a coin as is told would change."""

import numpy as np
import pandas as pd
import pytest

from cointoss import Hand, Outcome, Scenario, analytic
from cointoss.study import rows_from_states
from cointoss_reproduction.frame.cells import Cells, table_of
from cointoss_reproduction.setups.ends import counted
from cointoss_reproduction.studies.spun.study import AXES, COIN, spun
from saved import missed, unseen

FAR = AXES["offset"][-1]


def told(tails: int, narrow: int) -> pd.DataFrame:
    """Return a table of 1,000 spins of each coin: so many tails, and so many of a narrow edge far off."""

    def cell(edge: float, scatter: float, offset: float, engine: str) -> dict[str, int] | None:
        part = narrow if (edge, offset) == (0.4e-3, FAR) else tails
        is_made = engine == "analytic" or (scatter, offset) == (1.0, FAR)
        return counted([0, 1000 - part, part, 0, 0, 0]) if is_made else None

    return table_of([Cells(cell, AXES)], unseen, {})


def test_a_coin_turned_over_with_its_mass_centre_shows_the_other_side():
    """A half turn about a diameter swaps the sides; ζ of C changes its sign, and so does the vertical's."""
    coin = {**COIN["coin"], "thickness": 0.4e-3}
    one, other = (
        Scenario.model_validate({**COIN, "coin": {**coin, "center_of_mass": [0.0, 0.0, zeta]}})
        for zeta in (FAR, -FAR)
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
    found = spun(0.4e-3, scatter, FAR, engine, parts=500, by_mujoco=1)
    assert found is not None
    assert found["tosses"] == spins


def test_a_coin_as_is_told_would_be_seen():
    folklore, narrow, *_ = missed("spun", told(800, 500))
    assert "shows tails in 80% of the spins" in folklore
    assert narrow.startswith("spun with care on a narrow edge")
