"""`cointoss basin` draws: one map as asked, or both engines' and their difference, with their agreement."""

import xarray as xr
from PIL import Image

from cointoss.compare.basins.agreement import Agreement, Share
from cointoss.compare.basins.picture import MapAxis, draw_comparison
from cointoss.compare.sweep import describe
from cointoss.models.reading import load, parse
from tests.helpers.basin_runs import SCENARIO, basin
from tests.helpers.made_maps import halves

AXES = ("--x", "release.angular_velocity.eta=20:60:6", "--y", "release.position.z=0.2:0.6:5", "--after", 0)


def test_a_map_is_drawn_in_the_size_and_colours_asked(coin, tmp_path):
    out, png = tmp_path / "map.zarr", tmp_path / "map.png"
    asked = ("--png", png, "--size", "4x3", "--dpi", 50, "--palette", "paper", "--boundaries")
    assert basin(coin, *AXES, "--out", out, *asked).exit_code == 0
    gold, vermilion = (245, 171, 31), (213, 94, 0)

    def colours():
        with Image.open(png) as image:
            assert image.size == (200, 150)
            return {color for _, color in image.convert("RGB").getcolors(1 << 16) or []}

    assert {(0, 0, 0), vermilion} <= colours()
    assert gold not in colours()
    assert basin(coin, *AXES, "--out", out, "--resume", *asked[:6]).exit_code == 0
    assert gold in colours()


def test_a_map_of_a_changed_scenario_keeps_it_and_is_gone_on_with(coin, tmp_path):
    out, other = tmp_path / "map.zarr", ("--set", "restitution=0.5", "--set", "spin=30")
    coin.write_text(SCENARIO + "angular_velocity = [0, 20, 0]\n")
    axes = ("--x", "release.angles.theta=0.1:0.4:3", *AXES[2:])
    assert basin(coin, *axes, *other, "--out", out).exit_code == 0
    changed = load(coin).replace("floor.restitution", 0.5, "release.spin", 30)
    assert parse(xr.open_zarr(out, chunks=None).attrs["scenario"], "map") == changed
    assert basin(coin, *axes, *other, "--out", out, "--resume").exit_code == 0


def test_the_agreement_is_told_near_the_boundaries_and_away_from_them():
    measured = Agreement(near=Share(agreeing=3, compared=4), away=Share(agreeing=0, compared=0), undecided=2)
    said = describe.describe_agreement(measured).splitlines()
    assert said[0].startswith("agreement  none of 0 more than 2 pixels")
    assert said[1].startswith("           75.000 % of 4 nearer")
    assert said[3].startswith("           2 pixels are undecided")


def test_the_difference_bears_the_note():
    axis = MapAxis(name="gravity", unit="", start=0, stop=1)
    figure = draw_comparison(halves(2, 4), halves(2, 4), x=axis, y=axis, note="all\nalike")
    assert figure.axes[2].get_title() == "different: 0 % of the pixels both decide\nall\nalike"
