"""Tiles cover a map once."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.sweep import layout as module
from cointoss.compare.sweep.layout import numbers_in, tile_shape, tiles
from tests.helpers.basin_runs import map_asked


@pytest.mark.parametrize("shape", [(2, 2), (300, 500), (2, 100_000), (100_000, 3), (129, 127)])
@pytest.mark.parametrize("x", ["release.position.z=1:2:{}", "gravity=9:10:{}"])
@pytest.mark.parametrize("y", ["release.velocity.z=1:2:{}", "floor.friction=1:2:{}"])
def test_tiles_cover_the_map_once_and_are_of_the_size_agreed(shape, x, y):
    batch, how = map_asked(x.format(shape[1]), y.format(shape[0]))
    tile = tile_shape(how.engine, batch)
    assert tile[0] * tile[1] <= module.TILE_TOSSES[Engine.ANALYTIC]
    # No smaller than it must be: whole rows and columns that would fit aside, half of what is allowed.
    assert tile[0] * tile[1] >= min(shape[0] * shape[1], module.TILE_TOSSES[Engine.ANALYTIC]) / 2
    covered = np.zeros(shape, dtype=int)
    for part in tiles(shape, tile):
        covered[part] += 1
        assert numbers_in(part, shape).shape == covered[part].shape
    assert np.all(covered == 1)
    assert numbers_in((slice(1, 2), slice(0, 2)), shape).tolist() == [[shape[1], shape[1] + 1]]


def test_a_large_map_has_no_more_tiles_than_a_folder_holds():
    slow, small = (map_asked(f"release.position.z=1:2:{n}", f"air.exponent=1:2:{n}")[0] for n in (1000, 100))
    assert len(list(tiles(slow.shape, tile_shape(Engine.ANALYTIC, slow)))) <= 2 * module.MOST_TILES
    assert np.prod(tile_shape(Engine.ANALYTIC, small)) <= 64
