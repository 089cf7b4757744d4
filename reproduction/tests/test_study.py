"""A study: its cells make one long table, and measures, tables and pictures select from it."""

import numpy as np
import pandas as pd
import pytest

from cointoss.compare.metrics.estimates import share_of
from cointoss_reproduction.frame.cells import Cells, column, read_table, table_of
from cointoss_reproduction.frame.selection import measured, picture_of, tables_of
from saved import unseen

AXES = {"floor": {"smooth": 0.0, "rough": 0.5}, "chi": (0.3, 0.6)}


def counted(floor: float, chi: float, tosses: int = 100) -> dict[str, object] | None:
    if (floor, chi) == (0.5, 0.6):
        return None
    heads = int(tosses * (floor + chi) / 2)
    return {"heads": heads, "tosses": tosses, "width": chi**2, "part": share_of(heads, tosses, "coins")}


ROUGH = {"where": "floor == 'rough'"}
CELLS = table_of([Cells(counted, AXES)], unseen, {"tosses": 1000})


def test_a_table_has_a_row_for_each_cell_that_answers_with_the_names_on_its_axes():
    assert CELLS[["floor", "chi", "heads"]].to_numpy().tolist() == [
        ["smooth", 0.3, 150],
        ["smooth", 0.6, 300],
        ["rough", 0.3, 400],
    ]


def test_a_table_is_read_as_it_was_written(tmp_path):
    CELLS.to_csv(tmp_path / "cells.csv", index=False)
    pd.testing.assert_frame_equal(read_table(tmp_path / "cells.csv"), CELLS)


def test_a_column_is_that_of_the_rows_that_have_it():
    cells = table_of([Cells(counted, AXES), Cells(lambda: {"width": 2.0}, {})], unseen, {})
    assert column(cells, "heads").tolist() == [15, 30, 40]
    assert column(cells, "width", "floor.isna()").tolist() == [2.0]


def test_an_axis_and_a_column_of_one_name_are_refused():
    with pytest.raises(ValueError, match=r"^floor: an axis and a column; accepted: one of them$"):
        table_of([Cells(lambda floor: {"floor": floor}, {"floor": (1,)})], unseen, {})


@pytest.mark.parametrize(
    ("said", "found"),
    [
        ({"value": "1e3 * width", "where": "floor == 'rough'"}, 90),
        ({"value": "width", "key": ["floor"], "where": "chi == 0.3"}, {"smooth": 0.09, "rough": 0.09}),
        ({"value": "width", "take": "max", "less": 0.06}, 0.3),
        ({"value": "heads", "take": "sum"}, 850),
        ({"value": "width - 1", "take": "farthest"}, 0.91),
        ({"value": "heads", "take": "max", "key": ["floor"]}, {"smooth": 300, "rough": 400}),
        ({**ROUGH, "share": ["heads", "tosses"], "less": 0.5}, share_of(400, 1000) - 0.5),
        ({**ROUGH, "value": "part"}, share_of(400, 1000, "coins")),
        ({"share": ["heads", "tosses"], "take": "sum"}, share_of(850, 3000)),
        # Where rows are the same they are added up.
        (
            {"per": ["floor"], "share": ["heads", "tosses"], "key": ["floor"]},
            {"smooth": share_of(450, 2000), "rough": share_of(400, 1000)},
        ),
    ],
)
def test_a_measure_selects_numbers_and_shares_with_their_intervals(said, found):
    assert measured(CELLS, said) == pytest.approx(found)


def test_a_row_without_a_value_is_not_selected_but_an_estimate_of_nothing_is():
    other = table_of([Cells(lambda: {"heads": 5, "whole": share_of(0, 0)}, {})], unseen, {})
    both = pd.concat([CELLS, other])
    assert measured(both, {"value": "width", "take": "max"}) == measured(
        CELLS, {"value": "width", "take": "max"}
    )
    assert np.isnan(measured(both, {"value": "whole"}).value)


@pytest.mark.parametrize(
    ("said", "refusal"),
    [
        ({"where": "chi > 1", "value": "width"}, "selects no row"),
        ({"value": "width"}, "selects 3 rows, and has no key"),
    ],
)
def test_a_measure_that_selects_nothing_or_too_much_is_refused(said, refusal):
    with pytest.raises(ValueError, match=refusal):
        measured(CELLS, said)


@pytest.mark.parametrize(
    ("said", "lines"),
    [
        (
            {"columns": [["floor", "floor"], ["heads", ["heads", "tosses"]]], "across": "chi"},
            [
                "| floor | 0.3 | 0.6 |",
                "| --- | ---: | ---: |",
                "| smooth | 15.0 % [12.3, 18.1] | 30.0 % [26.4, 33.9] |",
                "| rough | 40.0 % [36.1, 44.0] |  |",
            ],
        ),
        (
            {"where": "chi == 0.3", "columns": [["of", "{heads:,d} of {tosses} ({floor})"]]},
            ["| of |", "| --- |", "| 150 of 1000 (smooth) |", "| 400 of 1000 (rough) |"],
        ),
    ],
    ids=["one axis across", "words with columns in them"],
)
def test_tables_show_columns_and_shares(said, lines):
    assert tables_of(CELLS, [{"says": "Heads:", **said}]).splitlines() == ["Heads:", "", *lines]


def test_a_picture_has_a_line_for_each_name_and_a_panel_for_each_of_another_axis():
    said = {"x": "chi", "y": ["heads", "tosses"], "lines": ["floor"], "levels": [0.5], "ylim": [0, 1]}
    (axes,) = picture_of(CELLS, said).axes
    assert axes.get_legend_handles_labels()[1] == ["smooth", "rough"]
    assert axes.get_ylim() == (0, 1)
    assert np.allclose(axes.lines[0].get_xydata(), [[0.3, 0.15], [0.6, 0.3]])
    assert len(picture_of(CELLS, {**said, "panels": "floor"}).axes) == 2


def test_a_picture_may_name_its_rows_and_have_parts():
    named = {"names": ["floor", "chi"], "y": ["heads", "tosses"], "lines": ["floor"], "style": "o"}
    sides, widths = picture_of(CELLS, [named, {"x": "chi", "y": "width", "lines": ["floor"]}]).axes
    assert [label.get_text() for label in sides.get_yticklabels()] == [
        "smooth, 0.3",
        "smooth, 0.6",
        "rough, 0.3",
    ]
    assert np.asarray(sides.lines[0].get_xdata()).tolist() == [0.15, 0.3]
    # A number without an interval has no bar.
    assert [len(axes.collections) for axes in (sides, widths)] == [2, 0]


def test_kinds_of_a_line_share_its_colour_and_its_place_in_the_legend():
    said = {"x": "chi", "y": "width", "lines": ["floor"], "kinds": "chi", "style": {0.3: "-", 0.6: "."}}
    (axes,) = picture_of(CELLS, said).axes
    first, second, _ = axes.get_lines()
    assert (first.get_color(), first.get_linestyle(), first.get_marker()) == (second.get_color(), "-", "None")
    assert second.get_marker() == "."
    assert axes.get_legend_handles_labels()[1] == ["smooth", "rough"]
    corners = [axes.get_position().y0 for axes in picture_of(CELLS, 4 * [said]).axes]
    assert corners[0] == corners[1] > corners[2] == corners[3]


def test_a_cell_may_answer_a_table_or_tables_among_its_rows():
    alone = Cells(lambda n: pd.DataFrame({"t": np.arange(n), "z": "so"}), {"n": (1, 2)})
    among = Cells(lambda n: [{"t": n, "z": "one"}, pd.DataFrame({"t": [n, n + 1], "z": "so"})], {"n": (7,)})
    found = table_of([alone, among], unseen, {})
    assert found["n"].tolist() == [1, 2, 2, 7, 7, 7]
    assert found["t"].tolist() == [0, 0, 1, 7, 7, 8]
    assert found["z"].tolist() == ["so", "so", "so", "one", "so", "so"]
