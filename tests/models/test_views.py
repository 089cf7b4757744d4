"""What Python and a notebook show of a toss: short texts, HTML, labelled arrays, plots."""

import xml.etree.ElementTree as ET

import pytest
from matplotlib import pyplot
from matplotlib.figure import Figure

from cointoss import analytic
from cointoss.models.notebook import shortened, with_bar
from cointoss.models.reading import load
from cointoss.models.records import Ending


@pytest.fixture(scope="module")
def tossed():
    return analytic.toss("fig24a")


def test_a_name_or_a_path_is_tossed_as_its_scenario(tossed, tmp_path):
    assert tossed.scenario == load("fig24a")
    path = tmp_path / "mine.toml"
    path.write_text(
        '[coin]\nmass = 1\nradius = 1\nthickness = 0\n[floor]\nrestitution = 0\ncontact = "smooth"\n'
        "[release]\nposition = [0, 0, 2]\n"
    )
    assert analytic.toss(path).scenario == load(path)


def test_one_line_says_how_it_ended(tossed):
    assert repr(tossed) == (
        f"<Toss by analytic: heads, settled at {tossed.end_time:.6g} s; "
        f"{len(tossed.impacts)} impacts: {with_bar(tossed.sequence, tossed.trusted_impacts)}>"
    )
    assert repr(tossed.impacts) == f"<Impacts: {len(tossed.impacts)}, {tossed.sequence}>"
    assert repr(tossed.sample([0, 0.25])) == "<States: 2 from 0 to 0.25 s>"


def test_sequences_are_shortened_and_have_their_bar():
    assert with_bar("HHT", 2) == "HH|T"
    assert with_bar("HHT", 3) == "HHT"
    assert shortened("HHTT", 3) == "HHT ... and 1 more"
    assert shortened("HHT", 3) == "HHT"


def test_a_notebook_shows_the_path_with_its_touches_and_the_ending(tossed):
    page = ET.fromstring(tossed._repr_html_().replace("<br>", ""))
    (picture,) = page.iter("svg")
    assert picture.attrib["aria-label"] == "height of the mass centre over time"
    marks = list(picture.iter("circle"))
    assert len(marks) == len(tossed.impacts)
    assert "".join((mark.findtext("title") or "")[0].upper() for mark in marks) == tossed.sequence
    facts = {row.findtext("th"): row.findtext("td") for row in page.iter("tr")}
    assert facts["sequence"] == with_bar(tossed.sequence, tossed.trusted_impacts)
    assert facts["ending"] == f"settled: {Ending.SETTLED.sentence}"
    assert "heads" in (page.findtext("strong") or "")


def test_impacts_become_labelled_arrays(tossed):
    found = tossed.to_xarray()
    impacts = tossed.impacts
    assert found.sizes["impact"] == len(impacts)
    assert (found.impulse.sel(axis="z") == impacts.impulse[:, 2]).all()
    assert (found.point.sel(body_axis="eta") == impacts.point[:, 1]).all()
    assert (found.impulse.attrs, found.time.attrs["units"]) == ({"long_name": "impulse", "units": "N s"}, "s")
    assert (found.face.attrs["flag_values"], found.face.attrs["flag_meanings"]) == ([1, 2], "heads tails")
    assert (found.attrs["outcome"], found.attrs["sequence"]) == ("heads", tossed.sequence)
    path = tossed.sample([0.0, 0.1]).to_xarray()
    assert path.position.sel(axis="z").values[0] == 0.40001
    assert path.indexes["time"].tolist() == [0.0, 0.1]


def test_impacts_become_a_table(tossed):
    found = tossed.to_dataframe()
    assert found.index.tolist() == list(range(1, len(tossed.impacts) + 1))
    assert (found["impulse_z"] == tossed.impacts.impulse[:, 2]).all()
    assert "".join(face[0].upper() for face in found["face"]) == tossed.sequence
    path = tossed.sample([0, 0.1]).to_dataframe()
    assert path.loc[0.0, "position_z"] == 0.40001
    arrays = tossed.to_xarray()
    assert found.attrs["units"]["impulse_z"] == arrays.impulse.attrs["units"] == "N s"
    assert set(found) - set(found.attrs["units"]) == {"face", *(f"quaternion_e{i}" for i in range(4))}
    assert path.attrs["units"]["time"] == "s"


def test_plots_are_labelled(tossed):
    given = Figure().add_subplot()
    axes = tossed.plot(given, color="red")
    assert axes is given
    assert axes.get_lines()[0].get_color() == "red"
    assert axes.get_ylabel() == "height of the mass centre [m]"
    assert axes.get_xlabel() == "time [s]"
    assert sum(len(line.get_xdata()) for line in axes.get_lines()[1:]) == len(tossed.impacts)


def test_a_plot_without_axes_is_a_figure_of_its_own(tossed):
    figures = [tossed.plot().figure for _ in range(2)]
    assert figures[0] is not figures[1]
    assert {figure.number for figure in figures} <= set(pyplot.get_fignums())
    for figure in figures:
        pyplot.close(figure)
