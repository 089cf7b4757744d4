"""The margin of a toss: its change changes the outcome, and a smaller one does not."""

import json

import numpy as np
import pytest
import xarray as xr

from cointoss import analytic
from cointoss.compare.basins.picture import MapAxis, MapMargins, draw_map
from cointoss.compare.metrics.margin import (
    FINE,
    MANY,
    QUANTITIES,
    Margin,
    changes_both_ways,
    margins,
    quantity_of,
    smallest_changes,
)
from cointoss.models.batch import PLACE, refused, rows_of
from cointoss.models.reading import load
from tests.helpers.command_line import cointoss, printed

pytestmark = pytest.mark.usefixtures("without_horizon")


def by_name(scenario):
    return {margin.quantity.name: margin for margin in margins(scenario)}


def test_every_quantity_has_a_margin_and_what_changes_nothing_has_none():
    found = by_name(load("fig29").replace("floor.restitution", 0.0))
    assert list(found) == [quantity.name for quantity in QUANTITIES]
    assert found["velocity x"].finite is None
    assert 0 < abs(found["height"].change) < 200
    assert 0 < abs(found["spin about ξ"].change) < 20


@pytest.mark.parametrize(
    ("name", "field", "start"),
    [
        ("height", "release.position.z", 0.4),
        ("spin about ξ", "release.angular_velocity.xi", 40.0),
        ("attitude about ξ", "release.angles.theta", 0.0),
    ],
)
def test_a_change_of_the_margin_changes_the_outcome_and_half_of_it_does_not(name, field, start):
    scenario = load("fig29").replace("floor.restitution", 0.3)
    margin = by_name(scenario)[name]
    values = start + np.array([0.0, 0.5, 0.999, 1.001]) * margin.change / margin.quantity.factor
    faces = [analytic.toss(scenario.replace(field, value)).outcome for value in values]
    assert faces[0] == faces[1] == faces[2] != faces[3]


def test_a_boundary_that_was_passed_lies_behind():
    scenario = load("fig29").replace("floor.restitution", 0.3)
    ahead = by_name(scenario)["height"].change
    height = 0.4 + 1.1 * ahead / 1e3
    behind = by_name(scenario.replace("release.position.z", height))["height"].change
    assert behind == pytest.approx(-0.1 * ahead, rel=1e-6)


def test_the_command_gives_margins_as_json():
    told = json.loads(cointoss("toss", "fig29", "--margin", "--json").stdout)["margin"]
    assert (told["velocity x"]["change"], told["height"]["unit"]) == (None, "mm")
    assert np.isfinite(told["height"]["change"])


SIDES = ("--x", "release.angular_velocity.xi=20:60:8", "--y", "release.position.z=0.2:0.6:6")


def margins_in(path):
    with xr.open_dataset(path, engine="zarr") as found:
        assert found["margin"].attrs["units"] == "rad/s"
        assert "spin about ξ" in found["margin"].attrs["long_name"]
        return found["outcome"].to_numpy(), found["margin"].to_numpy()


def test_a_map_of_margins_is_that_of_its_pixels(tmp_path):
    out = tmp_path / "map.zarr"
    command = ("basin", "fig29", *SIDES, "--margin", "spin about xi", "--out", out)
    assert "margin     along spin about ξ: median " in printed(*command)
    outcome, margin = margins_in(out)
    scenario, spins, heights = load("fig29"), np.linspace(20, 60, 8), np.linspace(0.2, 0.6, 6)
    z, w = (part.ravel() for part in np.meshgrid(heights, spins, indexing="ij"))
    found = np.isfinite(margin.ravel())
    assert found.mean() > 0.8
    for part, differs in ((0.0, False), (0.97, False), (1.0, True)):
        spin = w[found] + part * margin.ravel()[found]
        changed = {"release.position.z": z[found], "release.angular_velocity.xi": spin}
        tossed = analytic.toss_rows(rows_of(scenario, len(spin), changed))
        there = np.mean(tossed.outcome != outcome.ravel()[found])
        assert (there == 1) if differs else (there < 0.1)


def test_margins_of_a_map_after_impacts_are_of_the_face_there(tmp_path):
    out = tmp_path / "map.zarr"
    printed("basin", "fig29", *SIDES, "--margin", "spin about ξ", "--after", "0", "--out", out)
    face, margin = margins_in(out)
    # Half a turn at the first touch, which comes about at the time of a fall.
    assert 0.5 < np.median(np.abs(margin[np.isfinite(margin)])) <= 1
    assert np.isinf(margin).any()
    assert set(np.unique(face)) == {1, 2}


def test_margins_are_drawn_in_colours_of_their_size(tmp_path):
    sizes = np.array([[1e-6, -1e-3, 1.0], [np.inf, 1e-6, -1e-3]])
    axis = MapAxis(name="a", unit="m", start=0.0, stop=1.0)
    found = MapMargins(sizes, quantity="height", unit="mm", most=1e3)
    figure = draw_map(np.array([[1, 2, 1], [2, 1, 2]]), x=axis, y=axis, margins=found)
    drawn = np.asarray(figure.axes[1].images[0].get_array())
    assert np.array_equal(drawn[0, 1], drawn[1, 2])
    assert drawn[0, 0].sum() < drawn[0, 1].sum() < drawn[0, 2].sum()
    assert drawn[1, 0].tolist() == [217, 222, 229]
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "heads",
        "tails",
        "none found up to 1000 mm",
    ]
    assert figure.axes[2].get_ylabel() == "smallest change of height [mm]"
    none = found._replace(changes=np.full((2, 2), np.inf))
    draw_map(np.ones((2, 2), dtype=int), x=axis, y=axis, margins=none).savefig(tmp_path / "none.png")


def test_a_change_that_a_scenario_would_refuse_ends_the_search():
    """A coin 1 mm above the floor, flat, cannot be let go lower, nor 1000 mm deeper."""
    z, height = PLACE["release.position.z"], quantity_of("height")
    both = rows_of(load("fig29"), 2, {"release.position.z": [1e-3, 0.4], "release.angular_velocity.xi": 0.0})
    lower = height.change(both, np.array([-2e-3, -2e-3]))
    assert refused(lower, height.fields).tolist() == [True, False]
    tried = []

    def outcomes(rows):
        tried.append(rows[:, z])
        return analytic.toss_rows(rows).outcome

    assert np.isinf(smallest_changes(both, height, outcomes=outcomes, search=MANY)).all()
    assert min(heights.min() for heights in tried) >= 0


@pytest.mark.parametrize("search", [FINE, MANY])
@pytest.mark.parametrize("nearest", [False, True])
def test_a_change_is_found_where_the_first_difference_is(search, nearest):
    """Of some rows changes from half to twice a number are not accepted, and all beyond are out of reach."""
    rng, n = np.random.default_rng(3), 1500
    first, refused_at = 10.0 ** rng.uniform(-9, -0.1, (2, n)), rng.choice([0.01, 0.2, np.inf], n)

    def differ(rows, by):
        side, size = np.where(by > 0, 0, 1), np.abs(by)
        kept = (size < refused_at[rows][:, None] / 2) | (size > 2 * refused_at[rows][:, None])
        return size >= first[side, rows[:, None]], kept

    found = changes_both_ways(n, differ, search, nearest=nearest)
    due = np.where(first < refused_at, first, np.inf)
    clear = (first < refused_at / 10) | (first > 2 * refused_at)
    if nearest:
        found, due, clear = found.min(axis=0), due.min(axis=0), clear.all(axis=0)
    finite = clear & np.isfinite(due)
    gap = due[finite] * (10 ** (1 / search.per_decade) - 1)
    assert np.isinf(found[clear & ~finite]).all()
    assert (found[finite] >= due[finite]).all()
    assert (found[finite] - due[finite] <= gap / 8**search.bisections * (1 + 1e-6)).all()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (12.31, "height              +12.4 mm"),
        (-12.31, "height              -12.4 mm"),
        (np.inf, "height              none found up to 1000 mm"),
    ],
)
def test_a_margin_is_rounded_away_from_the_toss(change, said):
    assert Margin(quantity_of("height"), change).line.endswith(said)
