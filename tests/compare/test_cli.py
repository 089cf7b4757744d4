"""The command line: answers, messages, exit statuses, and files that are whole or not there."""

import csv
import json
import os
import subprocess
import sys

import pytest
from click.testing import CliRunner

from compare.cli import main
from compare.files import UnwritableError, require_file, require_folder, write_text
from models.reading import scenario_text

WRONG = {
    "syntax": "gravity = = 3",
    "empty": "",
    "restitution": scenario_text("fig24a").replace("restitution = 0.8", "restitution = 1.5"),
}


def cointoss(*arguments):
    return CliRunner().invoke(main, [str(part) for part in arguments], catch_exceptions=False)


def test_json_has_the_agreed_form():
    answered = cointoss("toss", "fig24a", "--json", "--max-impacts", 3)
    assert answered.exit_code == 0
    toss = json.loads(answered.stdout)
    assert list(toss) == ["engine", "sequence", "outcome", "ending", "trusted_impacts", "impacts", "contacts"]
    assert (toss["engine"], toss["sequence"], toss["ending"]) == ("analytic", "HHH", "max_impacts")
    assert len(toss["impacts"]) == 3
    sizes = {name: len(value) for name, value in toss["impacts"][0].items() if isinstance(value, list)}
    assert sizes == {
        "impulse": 3,
        "point": 3,
        "position": 3,
        "quaternion": 4,
        "velocity_before": 3,
        "velocity_after": 3,
        "angular_velocity_before": 3,
        "angular_velocity_after": 3,
        "contact_velocity_before": 3,
        "contact_velocity_after": 3,
        "flags": 0,
    }
    assert {"time", "face", "energy"} == set(toss["impacts"][0]) - set(sizes)
    assert toss["impacts"][0]["face"] == "H"


def test_both_engines_answer_in_the_same_form():
    a, b = (
        json.loads(cointoss("toss", "fig24a", "--json", "--max-impacts", 2, "--engine", engine).stdout)
        for engine in ("analytic", "mujoco")
    )
    assert a["impacts"][0].keys() == b["impacts"][0].keys()
    assert a["impacts"][0]["impulse"] == pytest.approx(b["impacts"][0]["impulse"], abs=1e-3 * 0.01)


def test_text_shows_sequence_outcome_and_horizon():
    text = cointoss("toss", "fig24a").stdout
    assert "outcome   heads" in text
    assert "settled: The energy is below the pass" in text
    assert "|" in text.split("sequence")[1].splitlines()[0]


def test_the_trajectory_is_written_as_csv(tmp_path):
    target = tmp_path / "path.csv"
    assert cointoss("toss", "fig24a", "--max-impacts", 1, "--trajectory", target).exit_code == 0
    rows = list(csv.reader(target.read_text().splitlines()))
    assert rows[0][:4] == ["t [s]", "x [m]", "y [m]", "z [m]"]
    assert [float(number) for number in rows[1][:4]] == [0, 0, 0, 0.40001]
    assert float(rows[-1][0]) == pytest.approx(0.283275791, abs=1e-8)
    assert [path.name for path in tmp_path.iterdir()] == ["path.csv"]


@pytest.mark.parametrize("text", WRONG.values(), ids=WRONG.keys())
@pytest.mark.parametrize("command", ["toss", "compare", "video"])
def test_a_wrong_scenario_is_exit_status_2_and_one_line(tmp_path, command, text):
    source = tmp_path / "wrong.toml"
    source.write_text(text)
    out = tmp_path / ("film.mp4" if command == "video" else "folder")
    answered = cointoss(command, source, *([] if command == "toss" else ["--out", out]))
    assert answered.exit_code == 2
    assert answered.stdout == ""
    assert answered.stderr.startswith(f"cointoss: {source}: ")
    assert len(answered.stderr.splitlines()) == 1
    assert not out.exists()


def test_what_an_engine_cannot_do_is_exit_status_2(tmp_path):
    source = tmp_path / "rough.toml"
    source.write_text(scenario_text("fig24a").replace('"smooth"', '"coulomb"'))
    answered = cointoss("toss", source, "--engine", "mujoco")
    assert answered.exit_code == 2
    assert answered.stderr.startswith(f'cointoss: {source}: floor.contact = "coulomb": accepted by the')


@pytest.mark.parametrize(
    "arguments",
    [
        ["toss", "fig24a", "--engine", "bullet"],
        ["toss", "fig24a", "--max-impacts", "0"],
        ["toss", "fig24a", "--max-impacts", "many"],
        ["toss"],
        ["compare", "fig24a"],
        ["throw", "fig24a"],
        ["toss", "no_such_scenario"],
        ["video", "fig24a", "--out", "film.gif"],
    ],
)
def test_wrong_arguments_are_exit_status_2(arguments):
    answered = cointoss(*arguments)
    assert answered.exit_code == 2
    assert answered.stdout == ""
    assert "Traceback" not in answered.stderr


def test_places_that_cannot_be_written_are_refused_before_the_work(tmp_path):
    (tmp_path / "file").write_text("mine")
    for command, target in (
        (["compare", "fig24a", "--out"], tmp_path / "file"),
        (["compare", "fig24a", "--out"], tmp_path / "file" / "below"),
        (["video", "fig24a", "--out"], tmp_path / "nowhere" / "film.mp4"),
        (["toss", "fig24a", "--trajectory"], tmp_path),
        (["toss", "fig24a", "--trajectory"], tmp_path / "nowhere" / "path.csv"),
    ):
        answered = cointoss(*command, target)
        assert answered.exit_code == 2
        assert str(target) in answered.stderr
        assert "accepted:" in answered.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_text() == "mine"


def test_a_failed_write_leaves_what_was_there(tmp_path):
    target = tmp_path / "kept.txt"
    write_text(target, "first")
    with pytest.raises(UnicodeEncodeError):
        write_text(target, "second, up to what can't be encoded: \ud800")
    assert target.read_text() == "first"
    assert [path.name for path in tmp_path.iterdir()] == ["kept.txt"]


def test_places_are_checked(tmp_path):
    require_folder(tmp_path / "new" / "deep")
    assert (tmp_path / "new" / "deep").is_dir()
    require_file(tmp_path / "new" / "file.csv")
    with pytest.raises(UnwritableError, match="this is a folder"):
        require_file(tmp_path / "new")


def test_the_command_works_beside_a_foreign_models_folder(tmp_path):
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "__init__.py").write_text("raise RuntimeError('foreign')")
    command = os.path.join(os.path.dirname(sys.executable), "cointoss")  # noqa: PTH118, PTH120
    done = subprocess.run(
        [command, "toss", "fig24a", "--max-impacts", "1", "--json"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["sequence"] == "H"


def test_help_and_version_bring_no_heavy_imports():
    script = (
        "import sys\nfrom click.testing import CliRunner\nfrom compare.cli import main\n"
        "for words in (['--help'], ['--version'], ['toss', '--help']):\n"
        "    assert CliRunner().invoke(main, words).exit_code == 0\n"
        "print(sorted({'numba', 'mujoco', 'numpy', 'pint', 'pydantic', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
