"""Maps from Python: the same as the command's, and what a notebook, xarray and pandas see of them."""

import ast
import json
import re
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
import xarray
from matplotlib import pyplot
from matplotlib.figure import Figure

import cointoss
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import grid
from cointoss.compare.sweep.layers import NOT_TOSSED
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from tests.helpers.command_line import cointoss as command

X, Y = "release.angular_velocity.eta=20:60:7", "release.position.z=20 cm:60 cm:5"
ASKED = ("basin", "fig24a", "--x", X, "--y", Y)


def tosses_of(found):
    """Yield the row and the column of each pixel of a map of fig24a, and its toss."""
    for row, height in enumerate(found.y):
        for column, spin in enumerate(found.x):
            changed = ("release.angular_velocity.eta", spin, "release.position.z", height)
            yield row, column, cointoss.toss(cointoss.load("fig24a").replace(*changed))


@pytest.fixture(scope="module")
def found():
    return cointoss.basin("fig24a", x=X, y=Y)


@pytest.fixture(scope="module")
def margins():
    return cointoss.basin(
        "fig24a", x="release.angular_velocity.eta=20:60:3", y="release.position.z=0.2:0.6:2", margin="height"
    )


@pytest.fixture(scope="module")
def trusted():
    return cointoss.basin("fig24a", x=X, y=Y, after=8, trust=True)


@pytest.fixture(scope="module")
def certain():
    return cointoss.basin("fig24a", x=X, y=Y, trust=True)


def test_a_map_has_the_tosses_of_its_pixels(found):
    assert (found.x[0], found.x[-1], found.y[0], found.y[-1]) == (20, 60, 0.2, 0.6)
    for row, column, toss in tosses_of(found):
        assert (found.outcome[row, column], found.impacts[row, column]) == (toss.outcome, len(toss.impacts))
    with pytest.raises(ValueError, match="read-only"):
        found.outcome[0, 0] = 0
    assert cointoss.basin("fig24a", x=X, y=Y, after=np.int64(0)).sweep.after == 0  # pyright: ignore


def test_a_map_counts_the_trusted_impacts_of_each_pixel(trusted):
    covered = 0
    for row, column, toss in tosses_of(trusted):
        assert trusted.trusted_impacts[row, column] == min(toss.trusted_impacts, 9)
        is_covered = not trusted.untrusted[row, column]
        assert is_covered == (toss.trusted_impacts >= 9)
        if is_covered:
            assert trusted.outcome[row, column] == toss.impacts.face[8]
        covered += is_covered
    assert 0 < covered < trusted.outcome.size
    assert trusted.to_dataframe()["trusted_impacts"].tolist() == trusted.trusted_impacts.ravel().tolist()
    about = trusted.to_xarray()["trusted_impacts"].attrs["long_name"]
    assert about == "number of leading impacts up to touch 9 that the engine's own errors cannot have changed"


def test_of_a_map_of_a_touch_no_outcome_of_a_toss_that_ended_is_trusted():
    """At restitution 0.1 all impacts of some tosses are trusted; the horizon does not cover what follows."""
    softer = cointoss.load("fig24a").replace("floor.restitution", 0.1)
    found = cointoss.basin(softer, x=X, y=Y, after=8, trust=True)
    ended = found.impacts <= 8
    assert found.untrusted is not None
    assert np.any(ended & (found.trusted_impacts == found.impacts))
    assert np.all(found.untrusted[ended])


def test_a_final_outcome_is_trusted_where_it_is_certain(certain):
    for row, column, toss in tosses_of(certain):
        assert certain.outcome[row, column] == toss.outcome
        assert certain.outcome_certain[row, column] == toss.outcome_certain
    assert np.array_equal(certain.untrusted, certain.outcome_certain == 0)
    assert 0 < certain.untrusted.sum() < certain.untrusted.size
    assert certain.trusted_impacts is None
    kept = certain.to_xarray()["outcome_certain"]
    assert kept.attrs["long_name"] == "whether the engine's own errors cannot change the outcome"
    assert kept.attrs["flag_meanings"] == "not_tossed uncertain certain"


def test_a_map_in_xarray_is_that_on_disk(found, tmp_path):
    path = found.save(tmp_path / "map.zarr")
    with xarray.open_dataset(path, engine="zarr", consolidated=True) as on_disk:
        ours = found.to_xarray()
        for name in ("outcome", "impacts", "release.angular_velocity.eta", "release.position.z"):
            assert ours[name].attrs == on_disk[name].attrs
            assert ours[name].dims == on_disk[name].dims
            assert np.array_equal(ours[name], on_disk[name])
    assert ours.attrs["engine"] == on_disk.attrs["engine"]
    assert parse(ours.attrs["scenario"], "ours") == parse(on_disk.attrs["scenario"], "theirs")


def test_what_a_person_sees_of_a_map(found):
    counts = {str(item): np.count_nonzero(found.outcome == item) for item in Outcome}
    assert {name: round(35 * share) for name, share in found.shares.items()} == {
        name: count for name, count in counts.items() if count
    }
    told = repr(found)
    assert told.startswith(
        "<OutcomeMap map of fig24a by analytic: 7 x 5 over release.angular_velocity.eta and"
    )
    assert f"{counts['heads'] / 35:.1%} heads" in told
    assert len(told) < 200
    html = found._repr_html_()
    assert 'src="data:image/png;base64,' in html
    assert 'alt="map of the outcome: 7 x 5 over spin about η and height"' in html
    frame = found.to_dataframe()
    assert list(frame) == ["release.position.z", "release.angular_velocity.eta", "outcome", "impacts"]
    assert frame["outcome"].tolist().count("heads") == counts["heads"]
    assert frame["release.angular_velocity.eta"].tolist() == np.tile(found.x, 5).tolist()
    assert frame["impacts"].tolist() == found.impacts.ravel().tolist()
    assert frame.attrs["units"] == {"release.position.z": "m", "release.angular_velocity.eta": "rad/s"}


def test_a_plot_shows_the_map_or_its_margins(found, margins):
    panel = found.plot(given := Figure().add_subplot(), boundaries=True)
    assert panel is given
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
    assert panel.get_title() == "fig24a: 2 g, 25 mm"
    assert panel.get_images()[0].get_array().shape[:2] == found.outcome.shape
    hostile = replace(found, sweep=replace(found.sweep, name=r"$\frac$ 硬\n貨"))
    hostile.plot(Figure().add_subplot()).figure.savefig(BytesIO())  # warnings are errors
    legend = [text.get_text() for text in panel.get_legend().get_texts()]
    assert legend == [*found.shares, "boundary"]
    assert margins.to_dataframe().attrs["units"]["margin"] == "mm"
    panel = margins.plot(Figure().add_subplot(), layer="margin")
    assert panel.get_images()[0].get_array().shape[:2] == margins.outcome.shape
    assert (panel.get_xlabel(), panel.get_ylabel()) == tuple(
        f"{axis.word} [{axis.printed_unit}]" for axis in (margins.sweep.x, margins.sweep.y)
    )
    assert panel.figure.axes[1].get_ylabel() == "smallest change of height [mm]"
    own = found.plot(palette="paper").figure
    assert own.number in pyplot.get_fignums()
    pyplot.close(own)


def test_a_plot_hatches_untrusted_pixels(found, trusted):
    panel = trusted.plot(Figure().add_subplot())
    picture, hatch = (image.get_array() for image in panel.get_images())
    share = trusted.untrusted.mean()
    rows, columns = (np.arange(len(hatch)) * count // len(hatch) for count in trusted.outcome.shape)
    assert picture.shape[:2] == trusted.outcome.shape
    assert np.array_equal(hatch[..., 3] > 0, trusted.untrusted[rows][:, columns])
    assert panel.get_images()[0].get_extent() == panel.get_images()[1].get_extent()
    assert panel.get_legend().get_texts()[-1].get_text() == f"untrusted: {100 * share:.3g} %"
    assert len(found.plot(Figure().add_subplot()).get_images()) == 1
    assert trusted._repr_html_().count("<img") == 1
    plain = replace(trusted, sweep=replace(trusted.sweep, trust=False), trusted_impacts=None)
    assert trusted._repr_html_() != plain._repr_html_()


def test_the_command_says_what_is_untrusted(trusted, tmp_path, monkeypatch):
    monkeypatch.setitem(grid.TILE_TOSSES, Engine.ANALYTIC, 10)
    asked = ("--after", 8, "--trust", "--out", tmp_path / "map.zarr")
    answered = command(*ASKED, *asked, "--png", tmp_path / "map.png", "--dpi", 40)
    few, middle = np.quantile(trusted.trusted_impacts, [0.1, 0.5], method="inverted_cdf")
    assert f"trusted    median {middle} impacts, a tenth at most {few}\n" in answered.stdout
    share = 100 * trusted.untrusted.mean()
    said = f"untrusted  {share:.3f} %: impact 9 is not trusted, or the toss ended before\n"
    assert said in answered.stdout
    assert (tmp_path / "map.png").exists()


def test_a_count_that_a_stranger_made_huge_takes_no_room(trusted, tmp_path):
    huge = trusted.trusted_impacts.copy()
    huge[0, 0] = 2_000_000_000
    path = replace(trusted, trusted_impacts=huge).save(tmp_path / "m.zarr")
    answered = command(*ASKED, "--after", 8, "--trust", "--out", path, "--resume")
    assert answered.exit_code == 0
    assert "untrusted  " in answered.stdout


def test_the_command_says_which_outcomes_may_be_decided_by_errors(certain, tmp_path):
    path = tmp_path / "map.zarr"
    answered = command(*ASKED, "--trust", "--out", path)
    share = 100 * certain.untrusted.mean()
    said = f"untrusted  {share:.3f} %: the engine's own errors may have decided the outcome\n"
    assert said in answered.stdout
    read = cointoss.read_map(path)
    assert np.array_equal(read.layers["outcome_certain"], certain.outcome_certain)
    assert read.untrusted is not None
    assert np.array_equal(read.untrusted, certain.untrusted)


def contents(store):
    """Return the files of a map, their bytes by their names, but for the scenario, whose text is its own."""
    files = {part.relative_to(store): part.read_bytes() for part in store.rglob("*") if part.is_file()}
    described = json.loads(files.pop(Path("zarr.json")))
    text = described["attributes"].pop("scenario")
    return files, described, parse(text, "saved")


def test_a_map_is_saved_as_the_command_saves_it(found, margins, trusted, tmp_path):
    for name, made, more in (
        ("plain", found, ()),
        ("margins", margins, ("--margin", "height")),
        ("trusted", trusted, ("--after", 8, "--trust")),
    ):
        path = tmp_path / f"{name}.zarr"
        assert made.save(str(path)) == path
        read = cointoss.read_map(str(path))
        assert read.sweep == made.sweep
        for layer, array in made.layers.items():
            assert np.array_equal(read.layers[layer], array)
        x, y = (
            f"{axis.field}={axis.start}:{axis.stop}:{axis.count}" for axis in (made.sweep.x, made.sweep.y)
        )
        asked = ("basin", "fig24a", "--x", x, "--y", y, *more, "--out")
        theirs = tmp_path / "theirs.zarr"
        command(*asked, theirs, "--overwrite")
        assert contents(path) == contents(theirs)
        with patch("cointoss.compare.sweep.run.toss_pixels") as tossed:
            assert command(*asked, path, "--resume").exit_code == 0
        tossed.assert_not_called()


def test_a_part_of_a_map_is_saved_and_gone_on_with(found, tmp_path):
    outcome, impacts = found.outcome.copy(), found.impacts.copy()
    outcome[:], impacts[:] = NOT_TOSSED, NOT_TOSSED
    part = cointoss.OutcomeMap(name="m", sweep=found.sweep, outcome=outcome, impacts=impacts)
    path = part.save(tmp_path / "m.zarr")
    assert cointoss.read_map(path).shares == {"not tossed": 1}
    command(*ASKED, "--out", path, "--resume")
    assert np.array_equal(cointoss.read_map(path).outcome, found.outcome)


def test_a_pixel_without_its_trusted_impacts_is_tossed_again(trusted, tmp_path):
    lost = trusted.trusted_impacts.copy()
    lost[2, 3] = NOT_TOSSED
    path = replace(trusted, trusted_impacts=lost).save(tmp_path / "m.zarr")
    assert cointoss.read_map(path).shares["not tossed"] == 1 / 35
    asked = (*ASKED, "--after", 8, "--out", path, "--resume")
    assert "another set of arrays (--trust)" in command(*asked).stderr
    assert command(*asked, "--trust").exit_code == 0
    assert np.array_equal(cointoss.read_map(path).layers["trusted_impacts"], trusted.trusted_impacts)


def test_a_map_is_saved_over_no_other_and_only_whole(found, tmp_path):
    path = found.save(tmp_path / "m.zarr")
    with pytest.raises(OSError, match=r"m\.zarr: exists; accepted: a new name"):
        found.save(path)
    found.save(path, overwrite=True)
    with pytest.raises(OSError, match=r"m\.txt: .*; accepted: one that ends in \.zarr"):
        found.save(tmp_path / "m.txt")
    coarse = cointoss.read_map(path, most=12)
    with pytest.raises(
        cointoss.SweepError, match=r"m\.zarr: one pixel of every 2 is here; accepted: a whole"
    ):
        coarse.save(tmp_path / "coarse.zarr")
    assert [entry.name for entry in tmp_path.iterdir()] == ["m.zarr"]


def test_a_map_that_is_not_finished_says_so(found):
    outcome = found.outcome.copy()
    outcome[0, 0] = NOT_TOSSED
    part = cointoss.OutcomeMap(name="m", sweep=found.sweep, outcome=outcome, impacts=found.impacts)
    assert part.shares["not tossed"] == 1 / 35
    assert "not tossed" in part._repr_html_()
    assert part.to_dataframe()["outcome"].tolist()[0] == "not_tossed"
    with pytest.raises(cointoss.SweepError, match="m: 1 of 35 pixels are not tossed; accepted"):
        part.plot()


NO_MAPS = """
engine 'paper' -> engine: 'paper', accepted: analytic, mujoco
engine None -> engine: None, accepted: analytic, mujoco
after -1 -> after: -1, accepted: a whole number from 0
after '2' -> after: '2', accepted: a whole number
after True -> after: True, accepted: a whole number
after 1.5 -> after: 1.5, accepted: a whole number
x None -> x: None, accepted: FIELD=START:STOP:N, such as
y (1, 2) -> y: (1, 2), accepted: FIELD=START:STOP:N, such as
x 'release.position.z=0.1:1:9' -> release.position.z: on both axes; accepted: two fields
margin 3 -> margin: 3, accepted: text
margin 'luck' -> margin luck: accepted: height
trust 1 -> trust: 1, accepted: True or False
"""


@pytest.mark.parametrize("case", NO_MAPS.strip().splitlines())
def test_what_makes_no_map_is_refused(case):
    given, _, named = case.partition(" -> ")
    name, _, value = given.partition(" ")
    with pytest.raises(ValueError, match=re.escape(named)):
        cointoss.basin("fig24a", **{"x": X, "y": Y, name: ast.literal_eval(value)})


def test_only_the_analytic_engine_counts_trusted_impacts():
    with pytest.raises(cointoss.SweepError, match="trust: by mujoco, accepted: only by the analytic engine"):
        cointoss.basin("fig24a", x=X, y=Y, engine="mujoco", trust=True)


def test_two_axes_may_make_no_map_together():
    with pytest.raises(ValueError, match="100000 by 100000 pixels, accepted: at most 1e"):
        cointoss.basin("fig24a", x="release.position.z=0.1:1:100000", y="gravity=1:9:100000")


@pytest.mark.parametrize("wrong", [None, {}, np.zeros(3)], ids=lambda wrong: type(wrong).__name__)
def test_what_is_no_scenario_is_refused(wrong):
    for use in (lambda one: cointoss.basin(one, x=X, y=Y), cointoss.compare, cointoss.toss):
        with pytest.raises(
            cointoss.ScenarioError, match=r"^scenario: of type .*, accepted: a Scenario, the pa"
        ):
            use(wrong)
    with pytest.raises(TypeError, match=r"^text: of type .*, accepted: TOML as text"):
        cointoss.parse(wrong, "wrong")


def test_what_is_no_map_is_refused(found):
    with pytest.raises(ValueError, match="77 is no outcome"):
        cointoss.OutcomeMap(
            name="m", sweep=found.sweep, outcome=np.full((5, 7), 77, np.int8), impacts=found.impacts
        )
    with pytest.raises(cointoss.SweepError, match="palette: 'foo', accepted: safe, paper"):
        found.plot(palette="foo")
    with pytest.raises(cointoss.SweepError, match="layer: 'margin', accepted: outcome"):
        found.plot(layer="margin")
    for most in (0, True, 2.5):
        with pytest.raises(cointoss.SweepError, match=f"most = {most}; accepted: a whole number from 1"):
            cointoss.read_map("map.zarr", most=most)  # pyright: ignore[reportArgumentType]
    mine = found.outcome.copy()
    cointoss.OutcomeMap(name="m", sweep=found.sweep, outcome=mine, impacts=found.impacts)
    mine[0, 0] = 1


def test_shapes_that_are_not_those_of_the_axes_are_refused(found):
    with pytest.raises(ValueError, match=r"OutcomeMap.impacts: shape \(1, 1\), expected \(5, 7\)"):
        cointoss.OutcomeMap(
            name="m", sweep=found.sweep, outcome=found.outcome, impacts=np.zeros((1, 1), np.int32)
        )
