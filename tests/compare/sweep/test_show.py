"""`cointoss basin --compare --report` writes the side-by-side report with a section on both maps."""

import base64
import io
import json
import re
import shlex
from html import unescape

import numpy as np
import pytest
from PIL import Image

from cointoss import read_map
from cointoss.coin_mj import MujocoSettings, Realisation
from cointoss.compare.basins.picture_style import PictureStyle
from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import ADVICE
from cointoss.compare.report.comparison import compare, compared
from cointoss.compare.report.contents import require_folder
from cointoss.compare.report.folder import write_report
from cointoss.compare.sweep import job, show
from cointoss.compare.sweep.maps import map_of
from cointoss.compare.sweep.store import opened
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from tests.helpers.basin_runs import SCENARIO, map_asked, map_layout
from tests.helpers.command_line import cointoss, printed, python
from tests.helpers.made_maps import halves

COIN = f"{SCENARIO}[ending]\nmax_impacts = 2\n"
X, Y = "release.angular_velocity.eta=20:60:5", "release.position.z=0.2:0.6:4"


@pytest.fixture
def coin(tmp_path, monkeypatch):
    """A scenario's file; no film is drawn."""
    monkeypatch.setattr(job, "drawing_problem", lambda: ADVICE)
    (tmp_path / "coin.toml").write_text(COIN)
    return tmp_path / "coin.toml"


def section_of(maps, after=None, certain=None):
    ny, nx = maps[0].shape
    axes, made = (X.replace(":5", f":{nx}"), Y.replace(":4", f":{ny}")), []
    for engine, outcomes in zip(Engine, maps, strict=True):
        is_trusted = certain is not None and engine == Engine.ANALYTIC
        asked = map_asked(*axes, COIN, engine=engine, after=after, trust=is_trusted)
        arrays = {"outcome": outcomes, "impacts": outcomes, "outcome_certain": certain}
        made.append(map_of(*asked, arrays, ""))  # pyright: ignore[reportArgumentType]
    return show.section(made, PictureStyle(dpi=20), "cointoss basin")


def shown_of(section, folder):
    """Give the text of the section on a report's page."""
    page = write_report(compared(parse(COIN, "coin"), COIN, "coin"), folder, ADVICE, maps=section)
    html = page.read_text(encoding="utf-8").split(">Basin map</h2>")[1].split("<h2>")[0]
    return " ".join(unescape(re.sub(r"<[^>]+>", " ", html)).split())


@pytest.mark.slow_after_first
@pytest.mark.parametrize("contact", ["spring", "one_step"])
def test_the_report_has_the_numbers_of_both_maps_and_the_command(coin, tmp_path, contact):
    out, report, png = tmp_path / "map.zarr", tmp_path / "new" / "report", tmp_path / "map.png"
    asked = ("--x", X, "--y", Y, "--after", 1, "--trust", "--compare", "--contact", contact, "--out", out)
    drawn = ("--report", report, "--png", png, "--palette", "safe", "--dpi", 60)
    assert printed("basin", coin, *asked, *drawn).endswith(
        f"picture    {png}\nreport     {report}/report.html\n"
    )
    require_folder(report, str(coin))
    found = json.loads((report / "numbers.json").read_text(encoding="utf-8"))
    assert found["map"]["untrusted"] == read_map(out).cointoss.untrusted.mean()
    assert read_map(tmp_path / "map-mujoco.zarr").cointoss.untrusted is None
    # The command goes on with the maps.
    assert cointoss(*shlex.split(found["map"]["command"])[1:]).exit_code == 0

    html = (report / "report.html").read_text(encoding="utf-8")
    assert html.index(">Impacts<") < html.index(">Basin map<") < html.index(">Scenario<")
    shown, *_ = re.findall('src="data:image/png;base64,([^"]+)"', html)
    with Image.open(io.BytesIO(base64.b64decode(shown))) as ours, Image.open(png) as theirs:
        assert ours.size == (900, 270)
        assert np.array_equal(np.asarray(ours), np.asarray(theirs))

    # The report's own toss is by the contact of the maps.
    settings = {"mujoco": MujocoSettings(contact=Realisation(contact))}
    mujoco = compare(parse(COIN, "coin"), settings=settings)["mujoco"].toss
    assert found["tosses"][1]["impacts"][1]["impulse"] == mujoco.impacts.impulse[1].tolist()


def test_the_report_hatches_what_the_analytic_engine_cannot_be_trusted_with(tmp_path):
    maps, hatched = [halves(20, 20)] * 2, np.arange(400).reshape(20, 20) < 100
    plain, shown = section_of(maps), section_of(maps, certain=~hatched)
    assert "untrusted" not in shown_of(plain, tmp_path / "plain")
    said = "untrusted (hatched): the engine’s own errors may have decided 25.000 % –"
    assert said in shown_of(shown, tmp_path / "shown")
    assert shown.picture != plain.picture


def test_the_section_tells_what_is_on_made_maps(tmp_path):
    right = halves(20, 20)
    wrong = right.copy()
    wrong[10, 3], wrong[0, 0] = Outcome.TAILS, Outcome.UNDECIDED
    section = section_of([right, wrong], after=2)
    # Away are 16 rows of two bands of 6 columns: neither at the rim of the map nor at the boundary.
    assert section.numbers["agreement"] == {
        "distance": 2.0,
        "near": {"agreeing": 207, "compared": 207},
        "away": {"agreeing": 191, "compared": 192},
        "undecided": 1,
    }
    text = shown_of(section, tmp_path)
    said = {
        "shows the face at touch 3, or the outcome of a toss that ended before",
        "heads 50.000 % 49.500 % tails 50.000 % 50.250 %",
        "undecided 0.000 % 0.250 %",
        "more than 2 pixels from the boundaries of the analytic map 192 99.479 %",
        "nearer to the boundaries 207 100.000 %",
        "undecided by one or both, not compared 1 –",
        "x spin about η release.angular_velocity.eta 20 rad/s 60 rad/s 20",
        "y height release.position.z 0.2 m 0.6 m 20",
        "tolerance 1e-13",
        "stiffness 1e+11 1/s²",
        "cointoss basin",
    }
    assert {one for one in (*said, "edge") if one in text} == said


def test_a_share_of_no_pixels_is_a_dash(tmp_path):
    text = shown_of(section_of([halves(2, 2), halves(2, 2)]), tmp_path)
    assert "shows the final outcome." in text
    assert "boundaries of the analytic map 0 – nearer to the boundaries 4 100.000 %" in text


def test_a_back_end_for_drawing_is_chosen_before_mujoco_is_imported(coin, tmp_path):
    for engine, name in zip(Engine, ("map.zarr", "map-mujoco.zarr"), strict=True):
        with opened(tmp_path / name, map_layout(X, Y, COIN, engine=engine), overwrite=False):
            pass
    script = (
        "import sys; from cointoss.compare.cli import main; from cointoss.compare.sweep import job\n"
        "job.drawing_problem = lambda: sys.exit(f'imported: {\"mujoco\" in sys.modules}')\n"
        "main()"
    )
    asked = ("--x", X, "--y", Y, "--compare", "--resume", "--out", "map.zarr", "--report", "report")
    done = python("-c", script, "basin", coin, *asked, folder=tmp_path)
    assert done.stderr == "imported: False\n"
