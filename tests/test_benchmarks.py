"""docs/SPEED.md shows the times of commits that docs/benchmarks.csv has, as `make pages` writes them."""

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
    assert tuple(ROWS[0]) == COLUMNS
    for row in ROWS:
        ratio = float(row["seconds"]) / float(row["reference"])
        assert abs(ratio / float(row["ratio"]) - 1) < 2e-3
    assert len({(row["commit"], row["machine"], row["benchmark"]) for row in ROWS}) == len(ROWS)


def test_the_page_shows_the_picture_and_the_newest_times():
    page = (DOCS / benchmarks.PAGE).read_text(encoding="utf-8")
    block = f"<!-- written by: make pages, benchmarks -->\n\n{benchmarks.newest(ROWS)}\n\n<!-- end -->\n"
    assert page.count(block) == page.count(f"]({benchmarks.PICTURE})") == 1


def test_the_picture_has_a_panel_for_each_benchmark_and_a_point_for_each_row():
    panels = benchmarks.drawn(ROWS).axes
    for panel, name in zip(panels, benchmarks.SHOWN, strict=True):
        points = [y for lines in panel.containers for y in lines[0].get_ydata()]
        assert sorted(points) == sorted(float(row["ratio"]) for row in ROWS if row["benchmark"] == name)
        assert points


def test_the_picture_is_that_of_the_table():
    assert benchmarks.mark(DOCS) in (DOCS / benchmarks.PICTURE).read_text(encoding="utf-8")
