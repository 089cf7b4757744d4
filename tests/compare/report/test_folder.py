"""The report's folder: a self-contained page, numbers, paths, and a film that plays."""

import json
import re
import shutil
from unittest.mock import patch

import pytest

from cointoss.compare.film import encodings
from cointoss.compare.film.back_end import ADVICE, drawing_problem
from cointoss.compare.film.drawing import Camera
from cointoss.compare.film.encodings import SMALL
from cointoss.compare.film.video import frames
from cointoss.compare.output.files import UnwritableError
from cointoss.compare.report.comparison import compare, compared
from cointoss.compare.report.contents import FILES, require_folder
from cointoss.compare.report.folder import BEING_DRAWN, write_report
from cointoss.compare.report.page import versions
from cointoss.models.reading import parse
from cointoss.models.sources import scenario_text
from tests.helpers.films import film_written
from tests.helpers.off import Off

SHORT = scenario_text("zloty").replace("0.40001", "0.05") + "\n[ending]\nmax_impacts = 2\n"


@pytest.fixture(scope="module")
def found():
    return compared(parse(SHORT, "short"), SHORT, "short")


@pytest.fixture(scope="module")
def folder(found, tmp_path_factory):
    target = tmp_path_factory.mktemp("report")
    assert drawing_problem() is None, ADVICE
    write_report(found, target, None)
    return target


def test_the_numbers_are_those_of_the_tosses(found, folder):
    numbers = json.loads((folder / "numbers.json").read_text(encoding="utf-8"))
    assert [toss["engine"] for toss in numbers["tosses"]] == ["analytic", "mujoco"]
    pair, written = found["mujoco"], numbers["comparisons"]["mujoco"]
    assert numbers["tosses"][0]["impacts"][1]["time"] == found.measure.impacts.time[1]
    due = {
        "impulse_difference": pair.differences.impulse.tolist(),
        "time_difference": pair.differences.time.tolist(),
        "impulse_error": pair.errors.tolist(),
        "common_horizon": pair.common_horizon,
    }
    assert written == written | due
    assert numbers["absent"] == {}


@pytest.mark.parametrize("name", ["zloty", "contact_knurled"])
def test_the_page_stands_before_the_film_is_drawn_and_after_it_was_interrupted(tmp_path, name):
    """It says which command draws the film, of the engines that toss the coin."""
    said, text = [], scenario_text(name).replace("max_impacts = 100", "max_impacts = 1")
    text = SHORT if name == "zloty" else text

    def interrupt(*_):
        said.append((tmp_path / "report.html").read_text(encoding="utf-8"))
        raise KeyboardInterrupt

    with patch("cointoss.compare.film.video.write_video", interrupt), pytest.raises(KeyboardInterrupt):
        write_report(compared(parse(text, name), text, name), tmp_path, None)
    assert said == [(tmp_path / "report.html").read_text(encoding="utf-8")]
    engines, missing = ("both", []) if name == "zloty" else ("analytic", ["path-mujoco.csv"])
    assert BEING_DRAWN.format(engines=engines) in said[0]
    assert {path.name for path in tmp_path.iterdir()} == set(FILES) - {"toss.mp4", *missing}


def test_a_comparison_in_python_writes_the_report_and_the_film_of_the_commands(tmp_path, monkeypatch):
    stamp = SMALL._replace(width=96, height=54, frames_per_second=4)
    monkeypatch.setattr(encodings, "SMALL", stamp)
    monkeypatch.setitem(encodings.ENCODINGS, ".mp4", encodings.ENCODINGS[".mp4"]._replace(form=stamp))
    source = tmp_path / "mine.toml"
    source.write_text(SHORT.replace("max_impacts = 2", "max_impacts = 1"))
    found = compare(source)
    html = found.report(tmp_path / "report").read_text(encoding="utf-8")
    assert "mine: do two engines toss this coin alike?" in html
    assert source.read_text().strip().splitlines()[-1] in html
    assert all(name in html and version in html for name, version in versions().items())
    assert {path.name for path in (tmp_path / "report").iterdir()} == set(FILES)
    assert found.film(str(tmp_path / "mine.mp4")) == tmp_path / "mine.mp4"
    drawn = frames(found.filmed, Camera.CLOSE_UP, stamp)
    assert film_written(tmp_path / "mine.mp4").frames == len(list(drawn))
    assert (tmp_path / "mine.mp4").read_bytes() == (tmp_path / "report" / "toss.mp4").read_bytes()


def test_a_report_replaces_an_earlier_one_as_a_whole_and_nothing_else(folder, tmp_path):
    earlier = tmp_path / "report"
    shutil.copytree(folder, earlier)
    (earlier / "notes.txt").write_text("mine")
    require_folder(earlier, "fig24a")
    before = {path.name: path.read_bytes() for path in earlier.iterdir()}
    text = scenario_text("contact_knurled").replace("max_impacts = 100", "max_impacts = 2")
    case = parse(text, "knurled")
    interrupted = patch("cointoss.compare.report.folder.render", side_effect=KeyboardInterrupt)
    with interrupted, pytest.raises(KeyboardInterrupt):
        write_report(compared(case, text, "knurled"), earlier, None)
    assert {path.name: path.read_bytes() for path in earlier.iterdir()} == before
    write_report(compared(case, text, "knurled"), earlier, ADVICE)
    kept = {"report.html", "numbers.json", "path-analytic.csv", "notes.txt"}
    assert {path.name for path in earlier.iterdir()} == kept


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("numbers", [None, "{}", "[1]", "my own", '{"versions": 3}'])
def test_a_folder_with_files_of_the_user_is_refused(tmp_path, name, numbers):
    if numbers is not None:
        (tmp_path / "numbers.json").write_text(numbers)
    if not (tmp_path / name).exists():
        (tmp_path / name).write_text("mine")
    with pytest.raises(UnwritableError, match=rf"^{re.escape(str(tmp_path))}: .* is in the way .*accepted: "):
        require_folder(tmp_path, "fig24a")


def test_a_report_owns_the_paths_of_its_engines_alone(tmp_path):
    """An earlier report's path of another engine goes with it; a user's file of such a name is in the way."""
    case, path = parse(SHORT, "short"), tmp_path / "path-off-2-0.csv"
    path.write_text("mine")
    with pytest.raises(UnwritableError, match=r"path-off-2-0\.csv is in the way"):
        require_folder(tmp_path, "short", ["Off 2.0"])
    path.unlink()
    write_report(compared(case, SHORT, "short", [Off("Off 2.0"), Off("gone", 0)]), tmp_path, ADVICE)
    paths = {"path-analytic.csv", path.name}
    assert {each.name for each in tmp_path.iterdir()} == {"report.html", "numbers.json", *paths}
    numbers = json.loads((tmp_path / "numbers.json").read_text(encoding="utf-8"))
    assert numbers["comparisons"].keys() == {"Off 2.0"}
    assert numbers["absent"] == {"gone": "gone tosses nothing"}
    (tmp_path / "path-mine.csv").write_text("mine")
    require_folder(tmp_path, "short", ["Off 2.0"])
    write_report(compared(case, SHORT, "short", ["analytic"]), tmp_path, ADVICE)
    kept = {"report.html", "numbers.json", "path-analytic.csv", "path-mine.csv"}
    assert {each.name for each in tmp_path.iterdir()} == kept
