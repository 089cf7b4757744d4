"""A comparison in Python: one record of any engines, also of what one can't toss; its text and picture."""

import re

import numpy as np
import pytest
from matplotlib.figure import Figure

import cointoss
from cointoss import coin_mj
from cointoss.compare.engines import label_of
from cointoss.compare.output.style import looks_of
from cointoss.compare.report.comparison import BOTH, compare
from cointoss.compare.report.verdict import VerdictKind, verdicts_of
from cointoss.models.reading import load
from cointoss.models.records import Face, UnusableEngineError
from tests.helpers.off import Off

SHORT = load("fig24a").replace("ending.max_impacts", 3)
KNURLED = load("contact_knurled").replace("ending.max_impacts", 3)


@pytest.fixture(scope="module")
def found():
    return cointoss.compare(SHORT)


def test_both_tosses_are_compared(found):
    assert (found.scenario, found.absent) == (SHORT, {})
    assert [toss.engine for toss in found.tosses] == ["analytic", "mujoco"]
    pair = found["mujoco"]
    assert (found.against, found.tosses) == ((pair,), (found.measure, pair.toss))
    assert (pair.common_horizon, pair.common_prefix, pair.common_horizon_time) == (3, 3, None)
    assert len(pair.errors) == len(pair.differences.time) == 3
    for array in (pair.errors, pair.differences.time, pair.together.time):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    with pytest.raises(KeyError, match="off; accepted: mujoco"):
        found["off"]


def test_settings_are_those_of_their_engine_on_the_film_too():
    low = load("fig24a").replace("release.position", (0, 0, 0.02))
    found = compare(low, settings={"mujoco": coin_mj.MujocoSettings(stiffness=1e13)})
    (measured, tossed) = ([(each.name, each.value) for each in toss.certificate] for toss in found.tosses)
    filmed = [(each.name, each.value) for each in found.filmed[1].motion.certificate]
    assert found.filmed[1].motion.end_time > found.tosses[1].end_time
    assert [("contact stiffness", 1e13) in one for one in (measured, tossed, filmed)] == [False, True, True]


def test_a_comparison_shows_its_verdict_and_both_tosses(found):
    assert repr(found) == f"<Comparison of scenario: {verdicts_of(found)[0].text}>"
    html = found._repr_html_()
    assert all(toss._repr_html_() in html for toss in found.tosses)


@pytest.mark.parametrize(
    ("engines", "title", "label"),
    [
        (BOTH, "fig24a, by analytic and mujoco", "up to here the faces must agree"),
        (
            [Off(), "mujoco", "analytic"],
            "fig24a, by analytic, off and mujoco",
            "up to here the faces of {} must agree",
        ),
    ],
    ids=["two", "three"],
)
def test_a_plot_shows_both_paths_and_up_to_where_the_faces_must_agree(engines, title, label):
    found = compare("fig24a", engines)
    axes = found.plot(given := Figure().add_subplot())
    assert (axes, axes.get_title()) == (given, title)
    lines = {str(line.get_label()): line for line in axes.get_lines()}
    for pair in found.against:
        assert pair.common_horizon_time == found.measure.impacts.time[pair.common_horizon - 1]
        horizon = lines[label.format(label_of(pair.toss.engine))]
        assert horizon.get_xdata() == [pair.common_horizon_time] * 2
        assert (horizon.get_color() == lines[pair.toss.engine].get_color()) == ("{}" in label)
    for toss in found.tosses:
        assert np.max(lines[toss.engine].get_xdata()) == toss.end_time
        assert np.asarray(lines[toss.engine].get_ydata())[0] == SHORT.release.position[2]
    names = [toss.engine for toss in found.tosses]
    assert [lines[name].get_color() for name in names] == [look.color for look in looks_of(names)]
    up = found.measure.impacts.face == Face.HEADS
    dots = lines["heads up at the touch"].get_ydata()
    assert np.array_equal(dots, found.measure.impacts.position[up, 2])
    _, legend = axes.get_legend_handles_labels()
    assert len(legend) == len(set(legend)) == 2 * len(found.tosses) + 1


def test_another_engine_is_held_against_what_was_asked():
    """It tosses on a softer floor: its impulses are off the law of the scenario, each by as much."""
    found = compare(SHORT, [Off(), "mujoco", "analytic"])
    assert [toss.engine for toss in found.tosses] == ["analytic", "off", "mujoco"]
    assert all(toss.scenario == SHORT for toss in found.tosses)
    restitution = SHORT.floor.restitution
    assert found["off"].errors == pytest.approx(restitution / 2 / (1 + restitution), rel=1e-6)
    assert found["mujoco"].errors.max() < 1e-3


def test_engines_that_toss_nothing_are_absent():
    found = compare(KNURLED, ["mujoco", Off(factor=0.0), Off("less", 0.9)])
    assert found.absent.keys() == {"mujoco", "off"}
    with pytest.raises(cointoss.UnsupportedError, match="knurled"):
        found["mujoco"]
    assert found.absent["mujoco"].replace('"', "&quot;") in found._repr_html_()
    assert found["less"].toss is found.tosses[1]
    told = [(verdict.engine, verdict.kind) for verdict in verdicts_of(found)]
    assert told[1:] == [("mujoco", VerdictKind.ALONE), ("off", VerdictKind.ALONE)]
    assert repr(found).endswith(
        "off can't toss this coin on this floor. " + found.absent["mujoco"] + ". off tosses nothing.>"
    )


@pytest.mark.parametrize(
    ("engines", "settings", "says"),
    [
        (["newton"], None, "engine: newton, accepted: analytic, mujoco, or package.module:name"),
        (["mujoco", "mujoco"], None, "engines: analytic, mujoco, mujoco, accepted: names that differ"),
        ([Off("A b"), Off("a-B")], None, "engines: analytic, A b, a-B, accepted: names that differ"),
        ([Off("!")], None, "engines: analytic, !, accepted: names that differ"),
        (["analytic"], {"mujoco": coin_mj.FINE}, "settings: of mujoco, accepted: of analytic"),
        ([3], None, "int: has no function simulate(scenario, times)"),
    ],
)
def test_engines_that_are_none_or_cannot_be_told_apart_are_refused(engines, settings, says):
    with pytest.raises((ValueError, TypeError, UnusableEngineError), match=re.escape(says)):
        compare(SHORT, engines, settings=settings)
