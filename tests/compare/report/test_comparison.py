"""A comparison in Python: one record, also of what MuJoCo can't toss; its text, its picture, its numbers."""

import numpy as np
import pytest
from matplotlib.figure import Figure

import cointoss
from cointoss.compare.report.comparison import Comparison, compare
from cointoss.compare.report.verdict import verdict_of
from cointoss.models.reading import load

SHORT = load("fig24a").replace("ending.max_impacts", 3)
KNURLED = load("contact_knurled").replace("ending.max_impacts", 3)
DERIVED = ("both", "differences", "together", "common_prefix", "errors", "horizon", "horizon_time")


@pytest.fixture(scope="module")
def found():
    return cointoss.compare(SHORT)


def test_both_tosses_are_compared(found):
    assert isinstance(found, Comparison)
    assert (found.scenario, found.not_realisable) == (SHORT, None)
    assert [toss.engine for toss in found.tosses] == ["analytic", "mujoco"]
    assert found.tosses == found.both == (found.analytic, found.mujoco)
    assert (found.horizon, found.common_prefix) == (3, 3)
    assert found.horizon_time is None
    assert len(found.errors) == len(found.differences.time) == 3
    with pytest.raises(ValueError, match="read-only"):
        found.errors[0] = 0


def test_what_mujoco_cannot_toss_is_a_comparison_that_says_why():
    alone = compare(KNURLED)
    assert isinstance(alone, Comparison)
    assert (alone.mujoco, alone.tosses) == (None, (alone.analytic,))
    reason = str(alone.not_realisable)
    for name in DERIVED:
        with pytest.raises(cointoss.UnsupportedError, match="knurled"):
            getattr(alone, name)
    assert reason.replace('"', "&quot;") in alone._repr_html_()
    axes = alone.plot(Figure().add_subplot())
    assert axes.get_lines()[0].get_label() == "analytic"
    assert axes.get_title() == "scenario, by analytic"


def test_a_comparison_shows_its_verdict_and_both_tosses(found):
    assert repr(found) == f"<Comparison of scenario: {verdict_of(found).text}>"
    html = found._repr_html_()
    assert html.count("<svg") == 2
    assert all(toss._repr_html_() in html for toss in found.both)


def test_the_name_is_that_of_the_file(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("# My coin\n" + SHORT.replace("ending.max_time", 1e-3).to_toml())
    named = compare(path)
    assert (named.name, named.text) == ("mine", path.read_text())


def test_a_plot_shows_both_paths_and_up_to_where_the_faces_must_agree():
    found = compare("fig24a")
    given = Figure().add_subplot()
    axes = found.plot(given)
    assert axes is given
    lines = {str(line.get_label()): line for line in axes.get_lines()}
    assert found.horizon_time == found.analytic.impacts.time[found.horizon - 1]
    assert lines["up to here the faces must agree"].get_xdata() == [found.horizon_time] * 2
    for toss in found.both:
        assert np.max(lines[toss.engine].get_xdata()) == toss.end_time
    _, legend = axes.get_legend_handles_labels()
    assert len(legend) == len(set(legend)) == 5
