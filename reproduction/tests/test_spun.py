"""The study of spun coins: what it counts."""

import pytest

from cointoss_reproduction.studies.spun.study import spun


@pytest.mark.parametrize(
    ("scatter", "engine", "spins"), [(1.0, "analytic", 2), (10.0, "analytic", 4), (1.0, "mujoco", 1)]
)
def test_a_small_run_spins_every_coin(scatter, engine, spins):
    found = spun(0.4e-3, scatter, 1e-4, 0.3, 120.0, engine, parts=500, by_mujoco=1)
    assert found is not None
    assert found["tosses"] == spins
