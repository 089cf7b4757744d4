"""Maps from Python: the same as the command's, and what xarray and pandas see of them."""

import json
from functools import partial
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.figure import Figure

import cointoss
from cointoss.compare.sweep import pieces
from cointoss.compare.sweep.maps import axes_of
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from tests.helpers.command_line import cointoss as command
from tests.helpers.command_line import printed

ETA, Z = "release.angular_velocity.eta", "release.position.z"
X, Y = f"{ETA}=20:60:7", f"{Z}=20 cm:60 cm:5"
ASKED = ("basin", "fig24a", "--x", X, "--y", Y)


def tosses_of(found):
    """Yield each pixel of a map of fig24a, and its toss."""
    for row, height in enumerate(found[Z].values):
        for column, spin in enumerate(found[ETA].values):
            yield (
                found.isel(y=row, x=column),
                cointoss.toss(cointoss.load("fig24a").replace(ETA, spin, Z, height)),
            )


@pytest.fixture(scope="module")
def found():
    return cointoss.basin("fig24a", x=X, y=Y)


@pytest.fixture(scope="module")
def margins():
    return cointoss.basin("fig24a", x=f"{ETA}=20:60:3", y=f"{Z}=0.2:0.6:2", margin="height")


@pytest.fixture(scope="module")
def trusted():
    return cointoss.basin("fig24a", x=X, y=Y, after=8, trust=True)


@pytest.fixture(scope="module")
def certain():
    return cointoss.basin("fig24a", x=X, y=Y, trust=True)


def test_a_map_has_the_tosses_of_its_pixels_in_words(found):
    assert found.outcome.dims == ("y", "x")
    assert found[ETA].values[[0, -1]].tolist() == [20, 60]
    assert found[Z].attrs == {"long_name": "height", "units": "m"}
    for pixel, toss in tosses_of(found):
        assert (pixel.outcome, pixel.impacts) == (str(toss.outcome), len(toss.impacts))
    touch = cointoss.basin("fig24a", x=X, y=Y, after=np.int64(0))  # pyright: ignore[reportArgumentType]
    assert touch.attrs["after"] == 0


def test_a_map_is_two_axes_of_the_verb(found):
    assert cointoss.basin("fig24a", x=(ETA, 20, 60, 7), y={Z: np.linspace(0.2, 0.6, 5)}).equals(found)
    same = cointoss.toss_many("fig24a", {"height": ("20 cm", "60 cm", 5), ETA: "20:60:7"})
    assert np.array_equal(same.outcome.values, found.outcome.values)
    assert np.array_equal(same.impacts.values, found.impacts.values)
    assert axes_of(same) == axes_of(found)


def test_a_map_counts_the_trusted_impacts_of_each_pixel(trusted):
    untrusted, covered = trusted.cointoss.untrusted, 0
    for (pixel, toss), is_open in zip(tosses_of(trusted), untrusted.ravel(), strict=True):
        assert pixel.trusted_impacts == min(toss.trusted_impacts, 9)
        assert is_open == (toss.trusted_impacts < 9)
        if not is_open:
            assert pixel.outcome == {1: "heads", 2: "tails"}[toss.impacts.face[8]]
        covered += not is_open
    assert 0 < covered < untrusted.size
    about = trusted["trusted_impacts"].attrs["long_name"]
    assert about == "number of leading impacts up to touch 9 that the engine's own errors cannot have changed"


def test_of_a_map_of_a_touch_no_outcome_of_a_toss_that_ended_is_trusted():
    """At restitution 0.1 all impacts of some tosses are trusted; the horizon does not cover what follows."""
    softer = cointoss.load("fig24a").replace("floor.restitution", 0.1)
    found = cointoss.basin(softer, x=X, y=Y, after=8, trust=True)
    ended = found.impacts.values <= 8
    assert np.any(ended & (found.trusted_impacts == found.impacts).values)
    assert np.all(found.cointoss.untrusted[ended])


def test_a_final_outcome_is_trusted_where_it_is_certain(certain):
    for pixel, toss in tosses_of(certain):
        assert (pixel.outcome, pixel.outcome_certain) == (str(toss.outcome), toss.outcome_certain)
    assert np.array_equal(certain.cointoss.untrusted, ~certain.outcome_certain)
    assert 0 < certain.cointoss.untrusted.sum() < certain.outcome.size
    assert "trusted_impacts" not in certain


def test_a_plot_shows_the_map_or_its_margins(found, margins):
    panel = found.cointoss.plot(given := Figure().add_subplot(), boundaries=True)
    assert panel is given
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
    assert panel.get_title() == "fig24a: 2 g, 25 mm"
    assert panel.get_images()[0].get_array().shape[:2] == found.outcome.shape
    hostile = found.assign_attrs(name=r"$\frac$ 硬\n貨")
    hostile.cointoss.plot(Figure().add_subplot()).figure.savefig(BytesIO())  # warnings are errors
    legend = [text.get_text() for text in panel.get_legend().get_texts()]
    assert legend == [*found.cointoss.counts, "boundary"]
    assert margins["margin"].attrs["units"] == "mm"
    panel = margins.cointoss.plot(Figure().add_subplot(), layer="margin")
    assert panel.get_images()[0].get_array().shape[:2] == margins.outcome.shape
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
    assert panel.figure.axes[1].get_ylabel() == "smallest change of height [mm]"
    own = found.cointoss.plot(palette="paper").figure
    assert own.number in pyplot.get_fignums()
    pyplot.close(own)


def test_a_plot_hatches_untrusted_pixels(found, trusted):
    panel, untrusted = trusted.cointoss.plot(Figure().add_subplot()), trusted.cointoss.untrusted
    picture, hatch = (image.get_array() for image in panel.get_images())
    rows, columns = (np.arange(len(hatch)) * count // len(hatch) for count in trusted.outcome.shape)
    assert picture.shape[:2] == trusted.outcome.shape
    assert np.array_equal(hatch[..., 3] > 0, untrusted[rows][:, columns])
    assert panel.get_images()[0].get_extent() == panel.get_images()[1].get_extent()
    assert panel.get_legend().get_texts()[-1].get_text() == f"untrusted: {100 * untrusted.mean():.3g} %"
    assert len(found.cointoss.plot(Figure().add_subplot()).get_images()) == 1


def test_a_count_that_a_stranger_made_huge_takes_no_room(trusted, tmp_path):
    huge = trusted.trusted_impacts.copy(deep=True)
    huge[0, 0] = 2_000_000_000
    path = trusted.assign(trusted_impacts=huge).cointoss.save(tmp_path / "m.zarr")
    assert "untrusted  " in printed(*ASKED, "--after", 8, "--trust", "--out", path, "--resume")


def contents(store):
    """Return the files of a map, their bytes by their names, but for the scenario, whose text is its own."""
    files = {part.relative_to(store): part.read_bytes() for part in store.rglob("*") if part.is_file()}
    described = json.loads(files.pop(Path("zarr.json")))
    text = described["attributes"].pop("scenario")
    return files, described, parse(text, "saved")


def test_a_map_is_saved_as_the_command_saves_it(found, margins, trusted, tmp_path, monkeypatch):
    for name, made, more in (
        ("plain", found, ()),
        ("margins", margins, ("--margin", "height")),
        ("trusted", trusted, ("--after", 8, "--trust")),
    ):
        path = tmp_path / f"{name}.zarr"
        assert made.cointoss.save(str(path)) == path
        assert cointoss.read_map(str(path)).equals(made)
        y, x = (f"{axis.field}={axis.start}:{axis.stop}:{axis.count}" for axis in axes_of(made))
        asked = ("basin", "fig24a", "--x", x, "--y", y, *more, "--out")
        theirs = tmp_path / "theirs.zarr"
        command(*asked, theirs, "--overwrite")
        assert contents(path) == contents(theirs)
        with monkeypatch.context() as patched:
            patched.setattr(pieces, "columns_of", None)  # nothing is tossed
            assert command(*asked, path, "--resume").exit_code == 0


def missing_at(dataset, place, name="outcome", value: str | int = "not_tossed"):
    """Return a map in which some pixels are not tossed."""
    made = dataset.copy(deep=True)
    made[name][place] = value
    return made


def test_a_part_of_a_map_is_saved_and_gone_on_with(found, tmp_path):
    path = missing_at(found, ...).cointoss.save(tmp_path / "m.zarr")
    assert cointoss.read_map(path).cointoss.counts == {"not_tossed": 35}
    command(*ASKED, "--out", path, "--resume")
    assert cointoss.read_map(path).equals(found)


def test_a_pixel_without_its_trusted_impacts_is_tossed_again(trusted, tmp_path):
    path = missing_at(trusted, (2, 3), "trusted_impacts", -1).cointoss.save(tmp_path / "m.zarr")
    assert cointoss.read_map(path).cointoss.counts["not_tossed"] == 1
    asked = (*ASKED, "--after", 8, "--out", path, "--resume")
    assert "another set of arrays (--trust)" in command(*asked).stderr
    assert command(*asked, "--trust").exit_code == 0
    assert cointoss.read_map(path).equals(trusted)


def test_a_map_that_is_not_finished_says_so(found):
    part = missing_at(found, (0, 0))
    assert part.cointoss.table()["outcome"].tolist()[0] == "not_tossed"
    with pytest.raises(cointoss.SweepError, match="1 of 35 pixels are not tossed; accepted"):
        part.cointoss.plot()


def test_what_is_no_map_is_refused(found):
    made = found.assign(outcome=(found.outcome.dims, np.full((5, 7), 77, np.int8)))
    for asked in (made.cointoss.page, made.cointoss.plot, partial(made.cointoss.save, "never.zarr")):
        with pytest.raises(ValueError, match="77 is no outcome"):
            asked()


def test_outcomes_without_two_fields_are_bars(found):
    row = found.isel(y=0)
    axes = row.cointoss.plot(Figure().add_subplot())
    heights = {
        str(label.get_text()): bar.get_height()
        for label, bar in zip(axes.get_xticklabels(), axes.patches, strict=True)
    }
    assert heights == row.cointoss.counts
    assert set(row.cointoss.counts) <= {str(one) for one in Outcome}
    shares = found.isel(y=[0]).cointoss.plot(Figure().add_subplot())
    assert shares.get_xlabel().startswith("spin about")
