"""docs/SPEED.md shows the times of commits that docs/benchmarks.csv has, as `make pages` draws them."""

import sys
from importlib import import_module
from pathlib import Path

from tests.benchmarks.keeping import COLUMNS, TABLE

DOCS = Path(__file__).parents[1] / "docs"
sys.path.append(str(DOCS / "extensions"))
benchmarks = import_module("benchmarks")
ROWS = benchmarks.read(DOCS)


def test_each_row_has_the_ratio_of_its_times():
    assert TABLE == DOCS / benchmarks.TABLE
    assert tuple(ROWS) == COLUMNS
    assert (abs(ROWS.seconds / ROWS.reference / ROWS.ratio - 1) < 2e-3).all()
    assert not ROWS.duplicated(["commit", "machine", "benchmark"]).any()


def test_the_page_shows_the_picture():
    assert (DOCS / "SPEED.md").read_text(encoding="utf-8").count(f"]({benchmarks.PICTURE})") == 1


def test_the_picture_has_a_panel_for_each_benchmark_and_a_point_for_each_row():
    panels = benchmarks.drawn(ROWS).axes
    for panel, name in zip(panels, benchmarks.SHOWN, strict=True):
        points = [y for lines in panel.containers for y in lines[0].get_ydata()]
        assert sorted(points) == sorted(ROWS.ratio[ROWS.benchmark == name])
        assert points


def test_the_picture_is_that_of_the_table():
    assert benchmarks.mark(DOCS) in (DOCS / benchmarks.PICTURE).read_text(encoding="utf-8")
