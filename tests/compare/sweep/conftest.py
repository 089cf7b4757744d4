"""A map that tests damage."""

import shutil

import numpy as np
import pytest

from cointoss.compare.sweep.layout import layout_of_map
from cointoss.compare.sweep.store import opened
from tests.helpers.basin_runs import SCENARIO, sweep_of
from tests.helpers.strange_maps import AXES


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A map in one tile, filled without a toss."""
    path, sweep = tmp_path_factory.mktemp("made") / "map.zarr", sweep_of(*AXES, margin="height")
    with opened(path, layout_of_map(sweep, SCENARIO), overwrite=False) as map_:
        numbers = np.arange(120)
        outcome = (numbers % 3).astype(np.int8)
        layers = {"outcome": outcome, "impacts": outcome.astype(np.int32), "margin": outcome.astype(float)}
        map_.write(numbers, layers)
    return path


@pytest.fixture
def path(made, tmp_path):
    """A copy of the map, with the scenario's file beside it."""
    (tmp_path / "coin.toml").write_text(SCENARIO)
    return shutil.copytree(made, tmp_path / "map.zarr")
