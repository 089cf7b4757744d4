"""`cointoss toss`: what it answers, in which form, and where it stops."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from cointoss import analytic
from cointoss.compare import engines as compare_engines
from cointoss.compare.commands.settings import described
from cointoss.compare.engines import Engine
from cointoss.compare.output import plots
from cointoss.compare.output.answer import as_json
from cointoss.compare.output.plots import picture_bytes
from cointoss.compare.sweep.basin import basin
from cointoss.compare.sweep.toss_many import toss_many
from cointoss.models.errors import ScenarioError
from cointoss.models.reading import load, parse
from cointoss.models.records import Ending, OtherOutcome, Outcome
from cointoss.models.sources import scenario_text
from tests.helpers.command_line import cointoss, in_a_shell, printed
from tests.helpers.draws import scenario


def test_many_tosses_keep_no_impacts_and_may_have_more():
    case = scenario(ending={"max_impacts": 30_000_000, "max_time": 0.5})
    two = {"height": [0.4, 0.5]}
    assert toss_many(case, two).ending.values.tolist() == 2 * [str(Ending.MAX_TIME)]
    for trust in ("impacts", "certain"):
        with pytest.raises(ScenarioError, match=r"max_impacts = 30000000: .*12\.5 GB here"):
            toss_many(case, two, trust=trust)
    with pytest.raises(ScenarioError, match="max_impacts"):
        basin(case, x="gravity=9:10:2", y="coin.mass=1 g:2 g:2", trust=True)


def test_a_scenario_comes_through_a_pipe(tmp_path):
    (tmp_path / "coin.toml").write_text(scenario_text("fig24a"), encoding="utf-8")
    done = in_a_shell("cointoss toss <(cat coin.toml)", tmp_path)
    assert (done.stdout, done.stderr) == (cointoss("toss", "fig24a").stdout, "")


def test_another_outcome_is_told_with_the_impact_after_which_a_change_leads_to_it():
    other = OtherOutcome(outcome=Outcome.EDGE, change=2e-9, impact=12)
    told = as_json(replace(analytic.toss("fig24a"), other_outcome=other))["other_outcome"]
    assert told == {"outcome": "edge", "change": 2e-9, "after_impact": 12}


@pytest.mark.parametrize("engine", Engine)
def test_height_tilt_and_energy_are_drawn_over_time(tmp_path, monkeypatch, engine):
    drawn = []
    monkeypatch.setattr(plots, "picture_bytes", lambda figure: drawn.append(figure) or picture_bytes(figure))
    printed("toss", "table", "--engine", engine, "--png", tmp_path / "toss.png")
    with Image.open(tmp_path / "toss.png") as picture:
        assert np.ptp(np.asarray(picture.convert("L"))) > 200
    ((height, tilt, energy),) = (figure.axes for figure in drawn)
    toss = compare_engines.toss("table", engine)
    impacts = toss.impacts
    times, heights = height.get_lines()[0].get_data()
    assert (times[0], times[-1]) == (0, toss.end_time)
    assert heights == pytest.approx(toss.sample(times).position[:, 2])
    times, tilts = tilt.get_lines()[0].get_data()
    normals = Rotation.from_quat(toss.sample(times).quaternion.copy(), scalar_first=True).apply([0, 0, 1])
    assert np.cos(np.radians(tilts)) == pytest.approx(normals[:, 2], abs=1e-7)
    times, energies = energy.get_lines()[0].get_data()
    # Just before an impact and at it; MuJoCo's path has the energy before it at first touch.
    before = 1e3 * (impacts.energy - impacts.energy_change)
    assert [energies[times < at][-1] for at in impacts.time] == pytest.approx(before, rel=1e-6)
    assert set(impacts.time) <= set(times)
    assert [one.get_ylabel().partition(" [")[0] for one in (height, tilt, energy)] == [
        *("height of the mass centre", "tilt", "energy"),
    ]


@pytest.mark.parametrize(
    ("typed", "field", "value"),
    [
        ("contact=knurled", "floor.contact", "knurled"),
        ('contact = "knurled"', "floor.contact", "knurled"),
        ("angles=[0, 0.3, 0]", "release.angles", [0, 0.3, 0]),
        ('position=[0, 0, "50 cm"]', "release.position", [0, 0, 0.5]),
        ("air={normal = 0.001, exponent = 0}", "air", {"normal": 0.001, "exponent": 0}),
        ("mass=2 g", "coin.mass", 0.002),
        (
            "inertia=[[1e-7,0,0], [0,1e-7,0], [0,0,2e-7]]",
            "coin.inertia",
            np.diag([1e-7, 1e-7, 2e-7]).tolist(),
        ),
    ],
)
def test_a_value_is_one_of_a_scenario_file(typed, field, value):
    found, text = described("fig24a", scenario_text("fig24a"), [typed])
    assert found == load("fig24a").replace(field, value) == parse(text, "changed")
