"""The command `mj-bounce`: what it prints, what it refuses, and that it needs nothing of cointoss."""

import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from cointoss_bounce.quantities import in_si
from tests.helpers.command_line import mj_bounce, python
from tests.helpers.golden import BOUNCE, assert_alike, replayed

HERE = Path(__file__).parent
README = (HERE.parent / "README.md").read_text(encoding="utf-8")
TABLE = tomllib.loads((HERE / "refusals.toml").read_text(encoding="utf-8"))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the files that refusals.toml describes."""
    monkeypatch.chdir(tmp_path)
    for name, text in TABLE["files"].items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bounce", "solref"])
def test_commands_print_and_write_what_their_transcript_has(name):
    golden = (BOUNCE / f"{name}.txt").read_text(encoding="utf-8")
    assert_alike(replayed(golden, BOUNCE), golden)


def shown(command):
    """Return the words of a command that README has, and what it shows of the answer."""
    asked, answer = re.findall(rf"\n    mj-bounce ({command} .*)\n\n((?:    .*\n)+)", README)[0]
    return shlex.split(asked), [line[4:] for line in answer.splitlines()]


def test_the_example_of_readme_prints_what_readme_has(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = (re.findall(rf"```{kind}\n(.*?)```", README, re.DOTALL) for kind in ("xml", "python"))
    ((model,), (code,)), (asked, table), (asked_for, settings) = blocks, shown("bounce"), shown("solref")
    Path(asked[1]).write_text(model)
    assert {*table} <= {*mj_bounce(*asked).stdout.splitlines()}
    assert mj_bounce(*asked_for).stdout.splitlines()[:2] == settings
    assert re.fullmatch(r".*solref=.*\n1\.124\d*\n", python("-c", code, folder=tmp_path).stdout)
    Path(asked[1]).write_text(
        re.sub(r"<option .*/>", settings[0], re.sub(r'priority="1" solref[^/]*', settings[1][6:-2], model))
    )
    assert re.findall(r"^    ( +1  0\.84.*)$", README, re.MULTILINE)[0] in mj_bounce(*asked).stdout


@pytest.mark.parametrize("row", TABLE["refused"] + TABLE["at_once"], ids=lambda row: row["line"])
def test_a_line_is_refused_in_one_line_with_what_is_accepted(row, folder):
    answered = mj_bounce(*shlex.split(row["line"]))
    pattern = ".*".join(re.escape(part) for part in f"mj-bounce: {row['says']}\n".split("…"))
    assert re.fullmatch(pattern, answered.stderr), answered.stderr
    assert (answered.exit_code, answered.stdout) == (2, "")
    assert {path.name for path in folder.iterdir()} == {*TABLE["files"]}


def test_what_a_look_refuses_is_refused_before_what_takes_long_is_imported(folder):
    script = (
        "import shlex, sys\nfrom click.testing import CliRunner\nfrom cointoss_bounce.command import main\n"
        "for line in sys.argv[1:]:\n"
        "    assert CliRunner().invoke(main, shlex.split(line)).exit_code == 2, line\n"
        "assert not {'mujoco', 'numpy', 'matplotlib', 'cointoss'} & {*sys.modules}"
    )
    lines = [row["line"] for row in TABLE["at_once"]]
    subprocess.run([sys.executable, "-c", script, *lines], cwd=folder, check=True)


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("0.002", "s", 0.002),
        ("2ms", "s", 0.002),
        (" 2e3 us ", "s", 0.002),
        ("5 g", "kg", 0.005),
        ("80 %", "", 0.8),
        ("1.62 m/s^2", "m/s^2", 1.62),
        ("1.62m / s**2", "m/s^2", 1.62),
        ("-3 cm/s²", "m/s^2", -0.03),
        ("32.2 ft/s^2", "m/s^2", 32.2 * 0.3048),
    ],
)
def test_a_quantity_is_read_in_si(text, unit, number):
    assert in_si(text, unit) == pytest.approx(number, rel=1e-15)
