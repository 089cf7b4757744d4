"""A map that tests damage."""

import shutil

import numpy as np
import pytest

from cointoss.compare.sweep.store import opened
from tests.helpers.basin_runs import SCENARIO, map_layout
from tests.helpers.strange_maps import AXES


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A map in one tile, filled without a toss."""
    path = tmp_path_factory.mktemp("made") / "map.zarr"
    with opened(path, map_layout(*AXES, margin="height"), overwrite=False) as map_:
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
