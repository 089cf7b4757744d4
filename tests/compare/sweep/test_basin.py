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
from cointoss.compare.sweep.maps import as_map, axes_of
from cointoss.compare.sweep.words import in_words
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from tests.helpers.command_line import cointoss as command

ETA, Z = "release.angular_velocity.eta", "release.position.z"
X, Y = f"{ETA}=20:60:7", f"{Z}=20 cm:60 cm:5"
ASKED = ("basin", "fig24a", "--x", X, "--y", Y)


@pytest.fixture(scope="module")
def found():
    return cointoss.basin("fig24a", x=X, y=Y)


@pytest.fixture(scope="module")
def margins():
    return cointoss.basin("fig24a", x=f"{ETA}=20:60:3", y=f"{Z}=0.2:0.6:2", margin="height")


@pytest.fixture(scope="module")
def trusted():
    return cointoss.basin("fig24a", x=X, y=Y, after=8, trust=True)


@pytest.mark.parametrize("chi", [0.8, 0.1])
@pytest.mark.parametrize(
    ("trust", "after", "layer"),
    [(None, None, "impacts"), ("certain", None, "outcome_certain"), ("impacts", 8, "trusted_impacts")],
)
def test_a_map_is_two_axes_of_the_verb(trust, after, layer, chi):
    """At restitution 0.1 some tosses end in trusted impacts; the horizon does not cover what follows."""
    case = cointoss.load("fig24a").replace("floor.restitution", chi)
    x, y = (ETA, 20, 60, 7), {Z: np.linspace(0.2, 0.6, 5)}
    found = cointoss.basin(case, x=x, y=y, after=after, trust=bool(trust))
    short = case if after is None else case.replace("ending.max_impacts", after + 1)
    due = cointoss.toss_many(short, {"height": ("20 cm", "60 cm", 5), ETA: "20:60:7"}, trust=trust)
    assert np.array_equal(found[layer].values, due[layer].values)
    assert axes_of(due) == axes_of(found)
    if after is None:
        assert in_words(as_map(due)).equals(found)
    if trust == "certain":
        assert np.array_equal(found.cointoss.untrusted, ~due.outcome_certain.values)


def test_a_plot_shows_the_map_or_its_margins(found, margins):
    panel = found.cointoss.plot(given := Figure().add_subplot(), boundaries=True)
    assert panel is given
    assert panel.get_title() == "fig24a: 2 g, 25 mm"
    legend = [text.get_text() for text in panel.get_legend().get_texts()]
    assert legend == [*found.cointoss.counts, "boundary"]
    hostile = found.assign_attrs(name=r"$\frac$ 硬\n貨")
    hostile.cointoss.plot(Figure().add_subplot()).figure.savefig(BytesIO())  # warnings are errors
    sizes = margins.cointoss.plot(Figure().add_subplot(), layer="margin")
    assert sizes.figure.axes[1].get_ylabel() == "smallest change of height [mm]"
    for axes, made in ((panel, found), (sizes, margins)):
        assert axes.get_images()[0].get_array().shape[:2] == made.outcome.shape
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("spin about η [rad/s]", "height [m]")
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
        assert not list(tmp_path.glob(".cointoss-*"))
        with monkeypatch.context() as patched:
            patched.setattr(pieces, "columns_of", None)  # nothing is tossed
            assert command(*asked, path, "--resume").exit_code == 0


def missing_at(dataset, place, name="outcome", value: str | int = "not_tossed"):
    """Return a map in which some pixels are not tossed."""
    made = dataset.copy(deep=True)
    made[name][place] = value
    return made


@pytest.mark.parametrize(
    ("place", "name", "value", "left"),
    [(..., "outcome", "not_tossed", 35), ((2, 3), "trusted_impacts", -1, 1)],
)
def test_what_of_a_map_is_not_tossed_is_saved_and_gone_on_with(trusted, tmp_path, place, name, value, left):
    path = missing_at(trusted, place, name, value).cointoss.save(tmp_path / "m.zarr")
    assert cointoss.read_map(path).cointoss.counts["not_tossed"] == left
    asked = (*ASKED, "--after", 8, "--out", path, "--resume")
    assert "another set of arrays (--trust)" in command(*asked).stderr
    assert command(*asked, "--trust").exit_code == 0
    assert cointoss.read_map(path).equals(trusted)


def test_what_is_no_map_or_not_finished_is_refused(found):
    part, made = missing_at(found, (0, 0)), found.assign(outcome=(found.outcome.dims, np.full((5, 7), 77)))
    for asked, said in (
        (part.cointoss.plot, "1 of 35 pixels are not tossed; accepted"),
        (made.cointoss.plot, "77 is no outcome"),
        (made.cointoss.page, "77 is no outcome"),
        (partial(made.cointoss.save, "never.zarr"), "77 is no outcome"),
    ):
        with pytest.raises(ValueError, match=said):
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
