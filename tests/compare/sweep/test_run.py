"""A tile is tossed in parts of a second."""

from types import SimpleNamespace

import numpy as np
import pytest

from cointoss.compare.sweep import run
from cointoss.compare.sweep.grid import Tile
from cointoss.compare.sweep.pixels import Pixels
from tests.helpers.basin_runs import sweep_of


@pytest.mark.parametrize(("cost", "most"), [(1e-5, 1 << 14), (4e-3, 250), (3.0, 8)])
def test_a_tile_is_tossed_in_parts_of_a_second(monkeypatch, cost, most):
    sweep, now, sizes = sweep_of("release.position.z=1:2:128", "release.velocity.z=1:2:128"), [0.0], []

    def toss(_, part):
        size = (part.rows.stop - part.rows.start) * (part.columns.stop - part.columns.start)
        now[0] += cost * size
        sizes.append(size)
        return Pixels(np.zeros(size, np.int8), np.zeros(size, np.int32), None)

    monkeypatch.setattr(run, "toss_pixels", toss)
    monkeypatch.setattr(run, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    whole = Tile(slice(0, 128), slice(0, 128 if cost < 1 else 2))
    tossed = list(run.toss_here(sweep, [whole]))
    assert sum(sizes) == 128 * (whole.columns.stop)
    assert len(tossed) == len(sizes)
    assert max(sizes) <= most
    # None takes much longer than a second, once the cost is known; and a cheap map has few parts.
    assert all(size * cost <= run.SECOND * 1.01 or size == 1 for size in sizes[1:])
    assert cost > 1e-4 or len(sizes) <= 6
