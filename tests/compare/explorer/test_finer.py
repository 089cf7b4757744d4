"""Finer tiles of a map, where the explorer is zoomed in."""

import numpy as np
import pytest

from cointoss import analytic, read_map, toss_many
from cointoss.compare.explorer import static
from cointoss.compare.explorer.finer import SIDE, toss_tile
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.devices import Device
from cointoss.models.reading import parse
from tests.helpers.cards import with_card
from tests.helpers.explored import FIELDS, SCENARIO


def test_a_finer_tile_has_the_outcomes_of_its_points(map_path):
    made = read_map(map_path)
    assert np.array_equal(toss_tile(made, 0, 0, 0)[:18, :24], read_map(map_path).cointoss.codes)
    tile = toss_tile(made, 2, 1, 1)
    assert tile.shape == (SIDE, SIDE)
    assert {1, 2} <= set(tile.ravel())
    scenario = parse(SCENARIO, "here").replace("ending.max_impacts", 2)
    for row, column in ((0, 0), (5, 20), (31, 31)):
        u, v = ((SIDE + place + 0.5) / 4 - 0.5 for place in (column, row))
        values = FIELDS[0], 20 + u * 40 / 23, FIELDS[1], 0.2 + v * 0.4 / 17
        assert tile[row, column] == analytic.toss(scenario.replace(*values)).impacts.face[1]
    first = toss_tile(made, 1, 0, 0)
    assert (first[0] == -1).all()  # below the map's first row
    assert (first[:, 0] == -1).all()
    assert (first[1:, 1:] > 0).all()
    with pytest.raises(SweepError):
        toss_tile(made, 1, 2, 0)


@pytest.mark.parametrize(("device", "levels"), [(Device.CUDA, (0, 2)), (Device.AUTO, (2,))])
def test_a_tile_is_tossed_on_a_card_where_the_whole_finer_map_pays(map_path, monkeypatch, device, levels):
    made = read_map(map_path)
    due, card = {level: toss_tile(made, level, 0, 0) for level in (0, 2)}, with_card(monkeypatch)
    for level, tile in due.items():
        card.given.clear()
        assert np.array_equal(toss_tile(made, level, 0, 0, device), tile)
        assert card.given == ([np.sum(tile != -1)] if level in levels else [])


def test_a_page_tosses_no_map_over_a_field_that_it_does_not_know(monkeypatch):
    """A spin stands for components of the angular velocity; the page's engine knows these."""
    monkeypatch.setattr(static, "engine_data", lambda _: {"wasm": "", "scenario": {}})
    known, derived = (
        toss_many("fig24a", {name: "20:60:2", "height": "0.2:0.3:2"})
        for name in ("release.angular_velocity.eta", "spin")
    )
    assert static._engine(known) is not None
    assert static._engine(derived) is None
