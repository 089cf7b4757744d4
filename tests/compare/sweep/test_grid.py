"""Tiles cover a map once, and are cut into parts that cover them once."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.sweep import grid
from cointoss.compare.sweep.grid import Tile, cut, gaps, tile_shape, tiles
from tests.helpers.basin_runs import sweep_of


@pytest.mark.parametrize("shape", [(2, 2), (300, 500), (2, 100_000), (100_000, 3), (129, 127)])
@pytest.mark.parametrize("x", ["release.position.z=1:2:{}", "gravity=9:10:{}"])
@pytest.mark.parametrize("y", ["release.velocity.z=1:2:{}", "floor.friction=1:2:{}"])
def test_tiles_cover_the_map_once_and_are_of_the_size_agreed(shape, x, y):
    sweep = sweep_of(x.format(shape[1]), y.format(shape[0]))
    tile = tile_shape(sweep)
    assert tile[0] * tile[1] <= grid.TILE_TOSSES[Engine.ANALYTIC]
    # No smaller than it must be: whole rows and columns that would fit aside, half of what is allowed.
    assert tile[0] * tile[1] >= min(shape[0] * shape[1], grid.TILE_TOSSES[Engine.ANALYTIC]) / 2
    covered = np.zeros(shape, dtype=int)
    for rows, columns in tiles(shape, tile):
        covered[rows, columns] += 1
    assert np.all(covered == 1)


def test_a_large_map_has_no_more_tiles_than_a_folder_holds():
    slow = sweep_of("release.position.z=1:2:1000", "air.exponent=1:2:1000")
    assert len(list(tiles(slow.shape, tile_shape(slow)))) <= 2 * grid.MOST_TILES
    assert np.prod(tile_shape(sweep_of("release.position.z=1:2:100", "air.exponent=1:2:100"))) <= 64


@pytest.mark.parametrize("along_x", [True, False])
@pytest.mark.parametrize("pixels", [1, 2, 3, 5, 7, 14, 1000])
def test_a_tile_is_cut_into_parts_that_cover_it_once(pixels, along_x):
    left, covered, order = [Tile(slice(2, 6), slice(1, 6))], np.zeros((7, 7), dtype=int), []
    while left:
        part, rest = cut(left[0], pixels, along_x=along_x)
        assert 1 <= covered[part].size <= pixels
        covered[part] += 1
        order.append(part)
        left = rest + left[1:]
    assert np.all(covered[2:6, 1:6] == 1)
    assert covered.sum() == 20
    if pixels == 3:
        first = (slice(2, 3), slice(1, 4)) if along_x else (slice(2, 5), slice(1, 2))
        assert order[0] == Tile(*first)


def test_the_gaps_of_a_tile_hold_what_is_not_tossed_whatever_was_tossed_first():
    tile, tossed = Tile(slice(10, 14), slice(20, 25)), np.zeros((4, 5), dtype=bool)
    assert gaps(tile, tossed) == [tile]
    tossed[0], tossed[1, :2] = True, True
    assert gaps(tile, tossed) == [
        Tile(slice(11, 12), slice(22, 25)),
        Tile(slice(12, 14), slice(20, 25)),
    ]
    tossed[:, :2] = True
    assert gaps(tile, tossed) == [Tile(slice(11, 14), slice(22, 25))]
    tossed[:] = True
    assert gaps(tile, tossed) == []
    tossed[3, 1] = tossed[3, 3] = False
    assert gaps(tile, tossed) == [Tile(slice(13, 14), slice(21, 24))]


def test_a_tile_is_long_along_the_release_where_the_coin_varies_across():
    across = sweep_of("gravity=9:10:500", "release.position.z=1:2:20000")
    assert tile_shape(across) == (1 << 14, 1)
    along = sweep_of("release.position.z=1:2:20000", "gravity=9:10:500")
    assert tile_shape(along) == (1, 1 << 14)
