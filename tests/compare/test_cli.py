"""The command line: answers, messages, exit statuses, and files that are whole or not there."""

import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from importlib.metadata import version
from unittest.mock import patch

import imageio_ffmpeg
import numpy as np
import pytest
from click.testing import CliRunner

from cointoss import analytic
from cointoss.compare.cli import main
from cointoss.compare.film.back_end import drawing_problem
from cointoss.compare.film.drawing import Drawer
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.output.answer import as_lines, contact_line
from cointoss.compare.output.files import UnwritableError, require_file, write_text
from cointoss.compare.report.contents import FILES
from cointoss.models.reading import load, named_scenarios, scenario_text
from cointoss.models.scenario import Scenario
from tests.helpers.command_line import HERE, cointoss, refused
from tests.helpers.films import film_written
from tests.helpers.processes import started

WRONG = {
    "syntax": "gravity = = 3",
    "empty": "",
    "restitution": scenario_text("fig24a").replace("restitution = 0.8", "restitution = 1.5"),
}


def test_json_has_the_agreed_form():
    answered = cointoss("toss", "fig24a", "--json", "--max-impacts", 3)
    assert answered.exit_code == 0
    toss = json.loads(answered.stdout)
    of_toss = [
        "engine",
        "sequence",
        "outcome",
        "ending",
        "end_time",
        "trusted_impacts",
        "impacts",
        "contacts",
    ]
    assert list(toss) == [*of_toss, "scenario", "settings", "versions"]
    limited = load("fig24a").replace("ending.max_impacts", 3)
    assert Scenario.model_validate(toss["scenario"]) == limited
    assert toss["scenario"]["floor"]["restitution_kind"] == "kinematic"
    assert toss["end_time"] == toss["impacts"][-1]["time"]
    assert toss["settings"] == analytic.FINE.as_dict()
    assert toss["versions"]["cointoss"] == version("cointoss")
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


@pytest.mark.parametrize("engine", ["analytic", "mujoco"])
def test_a_number_of_contact_steps_ends_a_toss_that_rolls_on(tmp_path, engine):
    source = tmp_path / "rolls.toml"
    source.write_text(
        '[coin]\nmass = "2 g"\nradius = "1.25 cm"\nthickness = 0\n'
        '[floor]\ncontact = "coulomb"\nfriction = 0.9\nrestitution = 0.1\n'
        "[release]\nposition = [0, 0, 0.013]\nangles = [0, 1.5, 0]\nangular_velocity = [0, 0, 60]\n"
    )
    answered = cointoss("toss", source, "--engine", engine, "--contact-steps", 7)
    assert answered.exit_code == 0
    assert "outcome   undecided" in answered.stdout
    assert "--contact-steps N" in answered.stdout


def test_a_number_of_flight_steps_ends_a_toss_in_mujoco_that_flies_on():
    answered = cointoss("toss", "fig24a", "--engine", "mujoco", "--flight-steps", 7)
    assert answered.exit_code == 0
    assert "outcome   undecided" in answered.stdout
    assert "--flight-steps N" in answered.stdout


def test_text_shows_sequence_outcome_and_horizon():
    text = cointoss("toss", "fig24a").stdout
    assert "outcome   heads" in text
    assert "settled: The coin can no longer turn over" in text
    assert "|" in text.split("sequence")[1].splitlines()[0]


def test_text_shows_what_the_toss_measured_of_itself():
    shown = cointoss("toss", "contact_coulomb", "--max-impacts", 2).stdout
    number = r"-?\de[-+]\d\d"
    pattern = rf"^checked   contact law {number}, energy {number} m g r, \|e\| {number}, gap {number} r$"
    found = re.search(pattern, shown, re.MULTILINE)
    assert found
    numbers = [float(part) for part in re.findall(number, found[0])]
    assert max(abs(part) for part in numbers) < 1e-10
    assert numbers[0] > 0
    in_the_air = analytic.toss(load("fig24a").replace("ending.max_time", 0.01))
    assert "checked" not in as_lines(in_the_air)


ROW = re.compile(r"^ *(\d+) +\d+\.\d+ +[HT]", re.MULTILINE)


def test_text_shows_the_first_of_thousands_of_impacts():
    text = cointoss("toss", "zloty").stdout
    assert len(text.splitlines()) < 40
    assert re.search(r"^sequence  [HT|]{60} \.\.\. and 1251 more$", text, re.MULTILINE)
    assert ROW.findall(text) == [str(number) for number in range(1, 21)]
    assert text.endswith("\n... and 1290 more; --all prints all 1310\n")


def test_all_impacts_and_contacts_are_printed_where_they_are_asked_for():
    toss = analytic.toss(load("zloty"))
    text = as_lines(toss, whole=True)
    assert ROW.findall(text) == [str(number) for number in range(1, len(toss.impacts) + 1)]
    assert " more" not in text
    spells = re.findall(r"^contact   from (\S+) s to (\S+) s$", text, re.MULTILINE)
    assert [[float(start), float(end)] for start, end in spells] == toss.contacts.round(6).tolist()
    assert cointoss("toss", "zloty", "--all").stdout == f"{text}\n"


def test_contacts_are_summed_in_one_line():
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 1))
    spells = np.array([(0.1, 0.15), (0.2, toss.end_time)])
    assert contact_line(toss) == ""
    assert contact_line(replace(toss, contacts=spells[:1])) == "from 0.100000 s to 0.150000 s"
    end = f"{toss.end_time - 0.15:.6f} s in all, the last from 0.200000 s to the end"
    assert contact_line(replace(toss, contacts=spells)) == f"2 times, {end}"
    assert f"\ncontact   2 times, {end}\n\n" in as_lines(replace(toss, contacts=spells))


def test_what_rounds_to_zero_has_no_sign():
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 1))
    tiny = replace(toss.impacts, impulse=np.array([[-1e-12, 1e-12, 0.01]]))
    assert "   0.00000     0.00000    10.00000" in as_lines(replace(toss, impacts=tiny))


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
    said = refused(command, source, *([] if command == "toss" else ["--out", out]))
    assert said.startswith(f"cointoss: {source}: ")
    assert not out.exists()


def test_what_an_engine_cannot_do_is_exit_status_2(tmp_path):
    source = tmp_path / "rough.toml"
    source.write_text(scenario_text("fig24a").replace('"smooth"', '"knurled"'))
    said = refused("toss", source, "--engine", "mujoco")
    assert said.startswith(f'cointoss: {source}: floor.contact = "knurled": accepted by the')


def test_a_floor_that_mujoco_comes_near_to_is_told_in_one_line(tmp_path):
    source = tmp_path / "rough.toml"
    source.write_text(scenario_text("fig24a").replace('"smooth"', '"perfectly_rough"'))
    answered = cointoss("toss", source, "--engine", "mujoco", "--max-impacts", 1)
    assert answered.exit_code == 0
    assert len(answered.stderr.splitlines()) == 1
    assert answered.stderr.startswith(f'cointoss: {source}: floor.contact = "perfectly_rough": MuJoCo tosses')
    assert cointoss("toss", source, "--max-impacts", 1).stderr == ""


def test_a_field_that_nothing_uses_is_named_in_one_line_by_every_command(tmp_path):
    source = tmp_path / "slippery.toml"
    source.write_text(scenario_text("fig24a").replace('"smooth"', '"smooth"\nfriction = 0.3'))
    axes = ("--x", "release.position.z=0.4:0.5:2", "--y", "gravity=9:10:2")
    for arguments in (
        ("toss", source, "--max-impacts", 1),
        ("compare", source, "--out", source),
        ("video", source, "--out", source),
        ("hands", source, "--tosses", 1),
        ("basin", source, *axes, "--after", 0, "--out", tmp_path / "map.zarr"),
    ):
        told = [line for line in cointoss(*arguments).stderr.splitlines() if "floor.friction" in line]
        assert len(told) == 1
        assert told[0].startswith(f"cointoss: {source}: floor.friction = 0.3: not used with contact = ")


def test_a_contact_may_take_one_step(tmp_path):
    source = tmp_path / "dead.toml"
    source.write_text(scenario_text("fig24a").replace("restitution = 0.8", "restitution = 0"))
    dead = ("toss", source, "--engine", "mujoco", "--max-impacts", 1)
    assert "floor.restitution = 0" in cointoss(*dead).stderr
    answered = cointoss(*dead, "--contact", "one_step", "--json")
    assert len(json.loads(answered.stdout)["impacts"]) == 1


def test_without_a_command_it_prints_its_help():
    bare, helped = cointoss(), cointoss("--help")
    assert (bare.exit_code, bare.stdout, bare.stderr) == (0, helped.stdout, "")
    assert "Commands:" in bare.stdout


def test_the_scenarios_that_come_along_are_listed_with_what_they_are():
    lines = cointoss("scenarios").stdout.splitlines()
    assert [line.split()[0] for line in lines] == named_scenarios()
    titles = [line[26:] for line in lines]
    assert "Fig. 24(c): released from 0.40003 m, 0.02 mm above fig24a" in titles
    assert len(set(titles)) == len(titles)
    assert all(
        20 < len(title) <= 90 and "Strzalko" not in title and title[-1] not in ",." for title in titles
    )
    assert max(map(len, lines)) <= 120


def test_settings_for_a_bounce_are_printed_with_their_error():
    shown = cointoss("solref", "--restitution", 0.8, "--dt", 0.002).stdout
    assert '<option timestep="0.002" integrator="implicitfast"><flag diagexact="enable"/></option>' in shown
    assert 'solref="0 -900.0" solimp="0.9999 0.9999 0.001 0.5 2" priority="1"' in shown
    assert re.search(r"^error +\de-1\d at worst.*\n +\de-0\d with weight, at 2 m/s", shown, re.MULTILINE)
    spring = cointoss("solref", "--restitution", 0.8, "--dt", 0.002, "--spring", "--json")
    found = json.loads(spring.stdout)
    assert (found["integrator"], found["solref"][0]) == ("RK4", pytest.approx(-((math.pi / 0.08) ** 2)))
    assert 1e-4 < found["error"] < 1e-2
    whole = cointoss("solref", "--restitution", 0.5, "--dt", 0.001, "--model").stdout
    assert whole.startswith("<mujoco>")
    assert whole.endswith("</mujoco>\n")


def completed(line, number):
    """Return what bash is told where it completes a word of a line."""
    asking = {"_COINTOSS_COMPLETE": "bash_complete", "COMP_WORDS": line, "COMP_CWORD": str(number)}
    return CliRunner().invoke(main, [], env=asking, prog_name="cointoss").stdout.split()


@pytest.mark.parametrize(
    ("line", "number", "names"),
    [
        ("cointoss sc", 1, ["scenarios"]),
        ("cointoss toss fig18", 2, [f"fig18_{n}d_{kind}" for n in (2, 3) for kind in ("ideal", "imperfect")]),
        ("cointoss basin fig29 --x release.po", 4, [f"release.position.{axis}=" for axis in "xyz"]),
        ("cointoss reproduce mujoco-l", 2, ["mujoco-laws", "mujoco-limit"]),
        ("cointoss throw fig", 2, []),
    ],
)
def test_a_shell_completes_names(line, number, names):
    assert [item for item in completed(line, number) if not item.startswith("file,")] == [
        f"plain,{name}" for name in names
    ]
    assert ("file,fig18" in completed(line, number)) == ("toss fig18" in line)


def test_a_failed_write_leaves_what_was_there(tmp_path):
    target = tmp_path / "kept.txt"
    write_text(target, "first")
    with pytest.raises(UnicodeEncodeError):
        write_text(target, "second, up to what can't be encoded: \ud800")
    assert target.read_text() == "first"
    assert [path.name for path in tmp_path.iterdir()] == ["kept.txt"]


def test_what_would_split_the_message_is_shown_escaped(tmp_path):
    source = tmp_path / "two\nlines.toml"
    source.write_text('gravity = "a\\nb"\n"c\\td" = 1')
    said = refused("toss", source)
    assert "two\\nlines.toml" in said
    assert "c\\td" in said


def test_an_output_is_never_the_scenario(tmp_path):
    text = scenario_text("fig24a")
    for name in ("coin.csv", "coin.mp4"):
        (tmp_path / name).write_text(text)
        (tmp_path / f"link-{name}").symlink_to(tmp_path / name)
    for command, source, target in (
        (["toss", "--trajectory"], "coin.csv", "coin.csv"),
        (["toss", "--trajectory"], "coin.csv", "link-coin.csv"),
        (["video", "--out"], "coin.mp4", "coin.mp4"),
    ):
        said = refused(*command, tmp_path / target, tmp_path / source)
        assert "is the scenario; accepted: another file" in said
    assert (tmp_path / "coin.csv").read_text() == (tmp_path / "coin.mp4").read_text() == text


def test_only_files_that_may_be_replaced_are_accepted(tmp_path):
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "kept.csv").write_text("mine")
    (tmp_path / "kept.csv").chmod(0o444)
    os.mkfifo(tmp_path / "pipe.csv")
    for name, reason in (
        ("folder.csv", "is a folder; accepted: a new name"),
        ("kept.csv", "read-only"),
        ("pipe.csv", "a device"),
        ("coin.toml", r"ends in \.csv"),
        (300 * "a" + ".csv", "name too long"),
        ("nowhere/path.csv", "no folder .*nowhere; accepted: a file in a folder that exists"),
    ):
        with pytest.raises(UnwritableError, match=reason):
            require_file(tmp_path / name, ".csv", "fig24a")
    require_file(tmp_path / "NEW.CSV", ".csv", "fig24a")
    require_file(tmp_path / (251 * "a" + ".csv"), ".csv", "fig24a")
    assert (tmp_path / "kept.csv").read_text() == "mine"


def test_a_replaced_file_keeps_its_mode_and_a_link_its_place(tmp_path):
    (tmp_path / "path.csv").write_text("old")
    (tmp_path / "path.csv").chmod(0o640)
    (tmp_path / "link.csv").symlink_to("path.csv")
    write_text(tmp_path / "link.csv", "new")
    assert (tmp_path / "link.csv").is_symlink()
    assert (tmp_path / "path.csv").read_text() == "new"
    assert (tmp_path / "path.csv").stat().st_mode & 0o777 == 0o640


def in_a_shell(command, folder):
    """Run a shell's line in a folder, `cointoss` being the command."""
    line = f'cointoss() {{ "{sys.executable}" -m cointoss "$@"; }}; {command}'
    return subprocess.run(
        ["bash", "-c", line],
        cwd=folder,
        capture_output=True,
        text=True,
        env=HERE,
    )


def test_a_stream_is_written_to_directly(tmp_path):
    # By links, or a fault here would replace the system's own devices.
    toss = "cointoss toss fig24a --max-impacts 1 --trajectory"
    done = in_a_shell(f"ln -s /dev/stdout out; {toss} out > both.txt; {toss} out | cat", tmp_path)
    both = (tmp_path / "both.txt").read_text()
    assert both == done.stdout
    assert both.startswith("t [s],x [m]")
    assert "sequence  H" in both
    done = in_a_shell(f"mkfifo pipe; cat pipe > copy & {toss} pipe; wait; stat -c %F pipe", tmp_path)
    assert done.stdout.endswith("fifo\n")
    assert (tmp_path / "copy").read_text().startswith("t [s],x [m]")


@pytest.mark.parametrize(
    ("command", "status", "named"),
    [
        ("cointoss toss fig24a --max-impacts 1 > /dev/full", 1, "standard output"),
        ("cointoss --help > /dev/full", 1, "standard output"),
        ("ln -s /dev/full full; cointoss toss fig24a --max-impacts 1 --trajectory full", 2, "full"),
        (
            "ulimit -f 1; cointoss toss fig24a --max-impacts 1 --trajectory path.csv",
            2,
            "path.csv",
        ),
    ],
)
def test_what_cannot_be_written_is_one_line(tmp_path, command, status, named):
    done = in_a_shell(f"{command}; echo $?", tmp_path)
    assert done.stdout.endswith(f"{status}\n")
    assert done.stderr.startswith(f"cointoss: {named}: can't be written (")
    assert len(done.stderr.splitlines()) == 1
    assert {path.name for path in tmp_path.iterdir()} <= {"full"}


def test_what_is_lost_without_an_error_of_the_system_is_said_as_it_is(monkeypatch):
    def lost():
        raise OSError("the connection was lost")

    monkeypatch.setattr("cointoss.models.reading.named_scenarios", lost)
    answered = cointoss("scenarios")
    assert (answered.exit_code, answered.stderr) == (1, "cointoss: the connection was lost\n")


def test_a_closed_pipe_ends_quietly_with_exit_status_1(tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-c", "from cointoss.compare.cli import main; main()", "--help"]
    done = subprocess.run(command, cwd=tmp_path, env=HERE, stdout=writing, stderr=subprocess.PIPE)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.fixture
def small_films(monkeypatch):
    """Films of the size of a stamp, of two frames a second."""
    monkeypatch.setitem(ENCODINGS, ".mp4", ENCODINGS[".mp4"]._replace(form=Format(64, 48, 2)))


@pytest.fixture
def short(tmp_path):
    """A scenario that ends at its first impact."""
    source = tmp_path / "short.toml"
    source.write_text(scenario_text("fig24a") + "\n[ending]\nmax_impacts = 1\n")
    return source


def test_where_a_film_is_interrupted_the_report_stands_without_it(tmp_path, short):
    # Frames that take their time, so that the film is met unfinished.
    script = (
        "import time\nfrom cointoss.compare.film import drawing\n"
        "draw = drawing.Drawer.draw\n"
        "drawing.Drawer.draw = lambda *frame: time.sleep(0.2) or draw(*frame)\n"
        "from cointoss.compare.cli import main; main()"
    )
    command = ("compare", short, "--out", "new/report")
    how = {"cwd": tmp_path, "stderr": subprocess.PIPE, "start_new_session": True}
    with started("-c", script, *command, **how) as filming:
        deadline = time.monotonic() + 120
        while not list(tmp_path.glob("new/report/.cointoss-*/toss.mp4")) and time.monotonic() < deadline:
            time.sleep(0.05)
        os.killpg(filming.pid, signal.SIGINT)  # the encoder is stopped too, as by Ctrl-C
        _, told = filming.communicate(timeout=60)
    assert (filming.returncode, told) == (130, "cointoss: interrupted by SIGINT\n")
    assert {path.name for path in (tmp_path / "new/report").iterdir()} == set(FILES) - {"toss.mp4"}


@pytest.mark.parametrize(
    ("engine", "camera"), [("analytic", "overview"), ("mujoco", "top"), ("both", "close-up")]
)
@pytest.mark.usefixtures("small_films")
def test_a_film_has_one_panel_for_each_toss(tmp_path, short, engine, camera):
    film = tmp_path / "film.mp4"
    with patch("cointoss.compare.film.video.Drawer", side_effect=Drawer) as drawers:
        answered = cointoss("video", short, "--engine", engine, "--camera", camera, "--out", film)
    assert answered.exit_code == 0
    assert answered.stdout == f"{film}\n"
    engines = ["analytic", "mujoco"] if engine == "both" else [engine]
    assert [call.args[0].toss.engine for call in drawers.call_args_list] == engines
    assert {call.args[1] for call in drawers.call_args_list} == {camera}
    assert {call.kwargs["width"] for call in drawers.call_args_list} == {64 // len(engines)}
    assert film_written(film).frames >= 2
    assert {path.name for path in tmp_path.iterdir()} == {"short.toml", "film.mp4"}


@pytest.mark.usefixtures("small_films")
def test_an_interrupted_film_leaves_what_was_there(tmp_path, short):
    film = tmp_path / "film.mp4"
    film.write_text("an earlier film")
    with patch("cointoss.compare.film.video.written", side_effect=KeyboardInterrupt):
        answered = cointoss("video", short, "--out", film)
    assert answered.exit_code == 130
    assert answered.stderr.strip() == "cointoss: interrupted"
    assert film.read_text() == "an earlier film"
    assert {path.name for path in tmp_path.iterdir()} == {"short.toml", "film.mp4"}


@pytest.mark.usefixtures("small_films")
def test_a_law_that_mujoco_lacks_is_filmed_by_the_analytic_engine_only(tmp_path):
    film = tmp_path / "film.mp4"
    for engine in ("mujoco", "both"):
        said = refused("video", "contact_knurled", "--engine", engine, "--out", film)
        assert 'floor.contact = "knurled": accepted by the MuJoCo engine' in said
        assert not film.exists()
    source = tmp_path / "knurled.toml"
    source.write_text(scenario_text("contact_knurled").replace("max_impacts = 100", "max_impacts = 1"))
    assert cointoss("video", source, "--engine", "analytic", "--out", film).exit_code == 0
    assert film.exists()


@pytest.mark.parametrize(
    "command",
    [
        "toss fig24a --engine mujoco",
        "video fig24a --out film.mp4",
        "reproduce endings --out out",
        "basin fig24a --x gravity=9:10:2 --y coin.mass=1:2:2 --compare --out map.zarr",
    ],
)
def test_a_back_end_that_is_none_is_one_line_and_exit_status_2(tmp_path, command):
    done = in_a_shell(f"export MUJOCO_GL=nonsense; cointoss {command}; echo $?", tmp_path)
    assert done.stdout == "2\n"
    assert len(done.stderr.splitlines()) == 1
    assert "accepted as MUJOCO_GL: egl" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_cannot_be_written_is_one_line(tmp_path, short):
    small = (
        "from cointoss.compare.film.encodings import ENCODINGS as e, Format; "
        "e['.mp4'] = e['.mp4']._replace(form=Format(64, 48, 4)); from cointoss.__main__ import main; main()"
    )
    command = f'"{sys.executable}" -c "{small}" video short.toml --out film.mp4'
    done = in_a_shell(f"ulimit -c 0 -f 1; {command}; echo $?", tmp_path)
    assert done.stdout == "2\n"
    assert done.stderr.startswith("cointoss: film.mp4: can't be written (ffmpeg: ")
    assert len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [short]


@pytest.mark.usefixtures("small_films")
def test_what_an_encoder_says_that_no_longer_reads_is_waited_for(tmp_path, short, monkeypatch):
    encoder = tmp_path / "encoder"
    encoder.write_text("#!/bin/sh\nexec 0<&-\nsleep 1\necho 'no such codec' >&2\nexit 1\n")
    encoder.chmod(0o755)
    monkeypatch.setattr(imageio_ffmpeg, "get_ffmpeg_exe", lambda: str(encoder))
    answered = cointoss("video", short, "--out", tmp_path / "film.mp4")
    assert answered.exit_code == 2
    assert answered.stderr.endswith("film.mp4: can't be written (ffmpeg: no such codec)\n")
    assert set(tmp_path.iterdir()) == {encoder, short}


def test_a_path_of_too_many_rows_is_refused(tmp_path):
    source = tmp_path / "long.toml"
    text = scenario_text("fig24a").replace("0.40001", "1e8")
    source.write_text(text + "\n[ending]\nmax_time = 2000\n")
    said = refused("toss", source, "--trajectory", tmp_path / "path.csv")
    assert said.startswith(f"cointoss: {source}: ending.max_time = 2000: accepted")
    assert not (tmp_path / "path.csv").exists()


def test_foreign_modules_in_the_current_folder_are_not_run(tmp_path, monkeypatch):
    (tmp_path / "random.py").write_text("raise RuntimeError('foreign')")
    monkeypatch.chdir(tmp_path)
    assert drawing_problem() is None


HEAVY = {
    "numba",
    "mujoco",
    "numpy",
    "scipy",
    "pint",
    "pydantic",
    "matplotlib",
    "xarray",
    "zarr",
    "distributed",
}


@pytest.mark.parametrize(
    ("words", "needed"),
    [
        ("--help", set()),
        ("--version", set()),
        ("toss --help", set()),
        # SciPy is numba's wish, of which it takes the linear algebra alone.
        ("toss fig24a", {"numba", "numpy", "pydantic", "scipy"}),
        (
            "basin fig24a --x release.position.z=0.2:1:2 --y floor.restitution=0:1:2 --out {}/map.zarr",
            {"numba", "numpy", "pydantic", "scipy", "zarr"},
        ),
    ],
)
def test_a_command_imports_no_more_than_it_needs(words, needed, tmp_path):
    script = (
        "import sys\nfrom click.testing import CliRunner\nfrom cointoss.compare.cli import main\n"
        f"assert CliRunner().invoke(main, {words.format(tmp_path).split()}).exit_code == 0\n"
        "print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    imported = set(done.stdout.split())
    assert HEAVY & imported <= needed
    assert not {"scipy.integrate", "scipy.optimize", "scipy.special", "scipy.stats"} & imported
