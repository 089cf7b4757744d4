"""What is said of a map: the numbers of made ones."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from cointoss.compare.basins.agreement import Share, agreement
from cointoss.compare.metrics.margin import quantity_of
from cointoss.compare.sweep import describe, room
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.store import opened
from tests.helpers.basin_runs import map_layout

LAYOUT = map_layout("gravity=9:10:5", "release.position.z=0.2:0.6:4")
MARGINS = np.array([[1e-3, -0.02, 0.3, np.inf, -4.0], [-5.0, 6.0, 7.0, 8.0, 9.0]])


@pytest.mark.parametrize(
    ("after", "counts", "said"),
    [
        (None, [1, 3], ["untrusted  25.000 %: the engine's own errors may have decided the outcome"]),
        # Of 20 tosses two have no trusted impact, nine at most one; the face at touch 3 needs three.
        (
            2,
            [2, 7, 5, 6],
            ["trusted    median 2 impacts, a tenth at most 0", "untrusted  70.000 %"],
        ),
        (0, [1, 19], ["trusted    median 1 impacts, a tenth at most 1", "untrusted  5.000 %: impact 1 "]),
    ],
)
def test_trust_is_told_as_the_share_of_what_cannot_be_trusted(after, counts, said):
    told = describe.describe_trust(after, np.array(counts))
    assert told.splitlines()[0].startswith(said[0])
    assert told.splitlines()[-1].startswith(said[-1])


def test_margins_are_told_by_their_lower_quantiles_and_the_share_of_none():
    told = describe.describe_margins(quantity_of("height"), MARGINS).splitlines()
    assert told[0].endswith("along height: median 5 mm, a tenth below 0.001 mm")
    assert told[2].strip() == "10.000 % without one up to 1000 mm"


def test_shares_are_of_all_tosses():
    told = describe.describe_map(Path("a.zarr"), LAYOUT, np.array([0, 8, 10, 2, 0, 0])).splitlines()
    assert told[2] == "tosses     5 by 4: final outcome"
    assert [line.split() for line in told[4:]] == [
        ["heads", "40.000", "%"],
        ["tails", "50.000", "%"],
        ["edge", "10.000", "%"],
    ]


@pytest.mark.parametrize(("agreeing", "compared", "said"), [(0, 0, "none of 0"), (1, 3, "33.333 % of 3")])
def test_the_share_that_agrees_is_of_those_compared(agreeing, compared, said):
    assert describe.percent(Share(agreeing=agreeing, compared=compared)) == said


def test_two_maps_agree_away_from_the_boundaries_beyond_two_pixels():
    first = np.full((9, 9), 1, np.int8)
    first[:, 0], second = 2, np.full((9, 9), 1, np.int8)
    second[4, 2:4] = 2  # within two pixels of the column of tails, and farther
    found = agreement(first, second, distance=describe.AWAY)
    # Farther than two pixels from the column and from what is outside: five rows of four.
    assert (found.away.agreeing, found.away.compared) == (19, 20)


def test_numbers_are_counted_over_tiles_and_what_is_beyond_the_last_is_the_last(tmp_path):
    with opened(tmp_path / "map.zarr", LAYOUT, overwrite=False) as kept:
        numbers = np.arange(20)
        kept.write(
            numbers, {"outcome": (numbers % 3).astype(np.int8), "impacts": (numbers % 7).astype(np.int32)}
        )
        assert kept.counts("outcome", 6).tolist() == [7, 7, 6, 0, 0, 0]
        assert kept.counts("impacts", 4).tolist() == [3, 3, 3, 11]


@pytest.mark.parametrize(
    ("given", "maps", "drawn", "disk", "memory"),
    [
        ({}, 1, False, 20 * 5, 0),
        ({}, 2, False, 2 * 20 * 5, 0),
        ({"margin": "height"}, 1, False, 20 * 13, 0),
        ({"trust": True}, 1, False, 20 * 6, 0),
        # 80 bytes for each pixel of each panel.
        ({}, 1, True, 20 * 5, 80 * 20),
        ({"margin": "height"}, 1, True, 20 * 13, 2 * 80 * 20),
    ],
)
def test_a_map_and_its_picture_need_the_bytes_of_their_numbers(
    tmp_path, monkeypatch, given, maps, drawn, disk, memory
):
    layout = map_layout("gravity=9:10:5", "release.position.z=0.2:0.6:4", **given)
    monkeypatch.setattr(room.shutil, "disk_usage", lambda _: SimpleNamespace(free=disk))
    monkeypatch.setattr(room, "_memory", lambda: memory)
    room.require_room(layout, tmp_path, maps=maps, drawn=drawn)
    disk, memory = (disk, memory - 1) if drawn else (disk - 1, memory)
    with pytest.raises((room.UnwritableError, SweepError), match="of memory" if drawn else "of disk"):
        room.require_room(layout, tmp_path, maps=maps, drawn=drawn)
