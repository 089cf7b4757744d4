"""Tiles cover a map once."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.sweep import layout as module
from cointoss.compare.sweep.layout import holds_tosses, is_untrusted, numbers_in, tile_shape, tiles
from cointoss.compare.sweep.maps import axes_of, map_of, stride_of, thinned
from tests.helpers.basin_runs import map_asked


@pytest.mark.parametrize("shape", [(2, 2), (300, 500), (2, 100_000), (100_000, 3), (129, 127)])
@pytest.mark.parametrize("x", ["release.position.z=1:2:{}", "gravity=9:10:{}"])
@pytest.mark.parametrize("y", ["release.velocity.z=1:2:{}", "floor.friction=1:2:{}"])
def test_tiles_cover_the_map_once_and_are_of_the_size_agreed(shape, x, y):
    batch, how = map_asked(x.format(shape[1]), y.format(shape[0]))
    tile, most = tile_shape(how.engine, batch), module.TILE_TOSSES[Engine.ANALYTIC]
    # No smaller than it must be: whole rows and columns that would fit aside, half of what is allowed.
    assert min(shape[0] * shape[1], most) / 2 <= tile[0] * tile[1] <= most
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


@pytest.mark.parametrize(
    ("after", "trust", "untrusted"),
    [
        (None, [-1, 0, 1], [False, True, False]),  # not tossed, uncertain, certain
        (0, [-1, 0, 1], [False, True, False]),
        (2, [-1, 0, 2, 3], [False, True, True, False]),
    ],
)
def test_a_face_is_trusted_where_its_touch_and_all_before_are(after, trust, untrusted):
    assert is_untrusted(after, np.array(trust)).tolist() == untrusted


@pytest.mark.parametrize(
    ("name", "values", "holds"),
    [
        ("outcome", [-2, -1, 0, 5, 6], [True, False, True, True, False]),  # refused, not tossed
        ("outcome_certain", [-2, -1, 0, 1, 7], [True, False, True, True, False]),
        ("impacts", [-2, -1, 0, 99], [True, False, True, True]),
        ("margin", [np.nan, np.inf, 0.0], [False, True, True]),
        ("end_time", [np.nan, 0.5], [True, True]),
    ],
)
def test_a_number_that_means_nothing_is_no_toss(name, values, holds):
    assert holds_tosses(name, np.array(values)).tolist() == holds


@pytest.mark.parametrize(("most", "stride"), [(35, 1), (34, 2), (12, 2), (11, 3), (6, 3), (5, 4), (1, 7)])
def test_a_map_is_thinned_to_at_most_so_many_pixels_of_the_same_axes(most, stride):
    codes = np.arange(35).reshape(5, 7) % 3
    batch, how = map_asked("release.position.z=0.2:0.6:7", "gravity=10:9:5")
    whole = map_of(batch, how, {"outcome": codes, "impacts": codes}, "")
    found = thinned(whole, most)
    assert stride_of((5, 7), most) == found.attrs["stride"] == stride
    assert found.outcome.values.tolist() == codes[::stride, ::stride].tolist()
    if stride < 4:
        assert axes_of(found) == axes_of(whole) == axes_of(thinned(thinned(whole, 34), most))
        part = found.isel(x=slice(1, 3))
        assert axes_of(part)[1].values.tolist() == part["release.position.z"].values.tolist()
