"""`cointoss fit` prints what explains a table, writes it as a scenario, and draws it."""

import json

import pytest

from cointoss import __version__, load
from tests.helpers.command_line import cointoss, python, refused

COIN = """[coin]\nmass = "5 g"\nradius = "12.5 mm"\nthickness = "2 mm"
[floor]\nrestitution = 0.8\ncontact = "smooth"\n[release]\nposition = [0, 0, 0.3]\n"""
HEARD = "t (s)\n1.200\n1.550\n1.812\n2.010\n"
CALL = ("fit", "heard.csv", "coin.toml", "--vary", "floor.restitution=0.4:0.95")
FREE = ("--vary", "release.position.z=0.1:1", "--vary", "clock=0:1200 ms", "--starts", 64)


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "coin.toml").write_text(COIN)
    (tmp_path / "heard.csv").write_text(HEARD)


def test_values_a_verdict_and_files(tmp_path):
    answered = cointoss(*CALL, *FREE, "--sd-time", "1 ms", "--out", "found.toml", "--png", "fit.png")
    lines = answered.stdout.splitlines()
    assert lines[0].startswith("floor.restitution                  0.75")
    assert "99 % [" in lines[1]
    assert lines[4].startswith("verdict     this model can do what was seen: chi-square ")
    assert lines[5] == "seen        4 touches; 3 values fitted"
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(cointoss(*CALL, *FREE, "--sd-time", "1 ms", "--json").stdout)
    assert found["versions"]["cointoss"] == __version__
    assert load("found.toml").floor.restitution == found["values"]["floor.restitution"]["value"]
    assert found["scenario"] == load("found.toml").as_tables()
    assert found["possible"]
    assert len(found["residuals"]) == len(found["touch_times"]) == 4
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "coin.toml",
        "fit.png",
        "found.toml",
        "heard.csv",
    ]


@pytest.mark.parametrize(
    ("more", "named"),
    [
        ((), "heard.csv: no standard deviation of time; accepted: a column sd_t, or --sd-time"),
        (("--sd-time", "1 mm"), "--sd-time 1 mm: accepted: a standard deviation from 1e-12 to 1e+09 s"),
        (("--sd-time", "0"), "--sd-time 0: accepted: a standard deviation from 1e-12 to 1e+09 s"),
        (("--sd-time", "1e-300"), "--sd-time 1e-300: accepted: a standard deviation from 1e-12 to"),
        (
            ("--sd-time", "1 ms", "--vary", "clock=1e300:2e300"),
            "clock = 1e300: accepted: a finite number within",
        ),
        (
            ("--sd-time", "1 ms", "--vary", "floor.friction=-2:-1"),
            "floor.friction=-2:-1: floor.friction = -2.0",
        ),
        (("--sd-time", "1 ms", "--vary", "floor.bounce=0:1"), "floor.bounce: no numeric field"),
        (("--sd-time", "1 ms", "--vary", "clock=1"), 'clock = "1": accepted: its first and last value'),
        (
            ("--sd-time", "1 ms", "--vary", "floor.restitution=0:1"),
            "--vary floor.restitution=0:1: accepted: FIELD=START:STOP, each field once",
        ),
        (
            ("--sd-time", "1 ms", "--vary", "ending.max_time=1:2"),
            "ending.max_time: no field that may vary here",
        ),
        (("--sd-time", "1 ms", "--out", "found.json"), "found.json: another kind of file"),
        (("--sd-time", "1 ms", "--out", "coin.toml"), "coin.toml: is the scenario; accepted: another file"),
        (("--sd-time", "1 ms", "--starts", "0"), "'--starts': 0; accepted: an integer >= 1"),
    ],
)
def test_bad_input_is_answered_in_one_line(tmp_path, more, named):
    assert named in refused(*CALL, *more)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["coin.toml", "heard.csv"]
    assert (tmp_path / "coin.toml").read_text() == COIN


def test_a_column_that_is_not_used_is_named_with_its_file(tmp_path):
    (tmp_path / "heard.csv").write_text("t (s),loudness\n1.2,3\n1.55,2\n1.812,2\n2.01,1\n")
    answered = cointoss(*CALL, *FREE, "--sd-time", "1 ms")
    assert "cointoss: heard.csv: column loudness: not used" in answered.stderr
    assert "coin.toml" not in answered.stderr


def test_a_model_that_cannot_do_it_ends_with_status_1(tmp_path):
    (tmp_path / "heard.csv").write_text("t\n1.0\n1.2\n1.45\n1.75\n")
    answered = cointoss(*CALL, *FREE, "--sd-time", "1 ms")
    assert answered.exit_code == 1
    assert "this model cannot do" in answered.stdout
    assert "99 %" not in answered.stdout, "no value of a model that is wrong is the true one"
    found = json.loads(cointoss(*CALL, *FREE, "--sd-time", "1 ms", "--json").stdout)
    assert [(each["interval"], each["sd"]) for each in found["values"].values()] == [(None, None)] * 3
    assert found["covariance"] is None


def test_a_missing_table_is_refused_before_the_engine_is_imported(tmp_path):
    """That takes seconds on a busy machine."""
    script = (
        "import sys; from cointoss.compare.cli import main\n"
        "try: main(['fit', 'nosuch.csv', 'coin.toml', '--vary', 'clock=0:1'])\n"
        "finally: print(*(name for name in sys.modules if name.startswith('cointoss.analytic')))"
    )
    answered = python("-c", script, folder=tmp_path)
    assert answered.returncode == 2
    assert answered.stderr == "cointoss: nosuch.csv: no such file; accepted: a CSV file\n"
    assert answered.stdout == "\n"


def test_what_was_seen_is_not_written_over(tmp_path):
    link = tmp_path / "found.toml"
    link.symlink_to(tmp_path / "heard.csv")
    told = refused(*CALL, "--sd-time", "1 ms", "--out", "found.toml")
    assert "heard.csv: is what is read; accepted: another file" in told
    assert (tmp_path / "heard.csv").read_text() == HEARD


def test_a_decimal_comma_between_commas_is_no_cell_of_its_own(tmp_path):
    (tmp_path / "heard.csv").write_text("t (s)\n0,2257\n0,5821\n0,8629\n")
    told = refused(*CALL, "--sd-time", "1 ms")
    assert "heard.csv: row 1 has 2 cells; accepted: 1, one for each column" in told
