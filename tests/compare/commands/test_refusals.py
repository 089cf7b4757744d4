"""What the command line refuses: each line of refusals.toml has its one line, and nothing is written."""

import os
import re
import shlex
import tomllib
from pathlib import Path

import pytest

from tests.helpers.command_line import HEAVY, cointoss, python, refused

TABLE = tomllib.loads((Path(__file__).parents[1] / "refusals.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What the table says that there is, and what that is as a whole: no line changes it."""
    place = tmp_path_factory.mktemp("refused")
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(place)
        for name in TABLE["folders"]:
            Path(name).mkdir(parents=True)
        for name, text in TABLE["files"].items():
            Path(name).write_text(text, encoding="utf-8")
        for name, target in TABLE["links"].items():
            Path(name).symlink_to(target)
        for name in TABLE["read_only"]:
            Path(name).chmod(0o444)
        for line in TABLE["maps"]:
            assert cointoss(*shlex.split(line)).exit_code == 0
        for name, text in TABLE["beside"].items():
            Path(name).write_text(text, encoding="utf-8")
    return place, held(place)


def held(folder):
    """Return what a folder holds, and when each file was written."""
    return {path: path.is_file() and path.stat().st_mtime_ns for path in folder.rglob("*")}


@pytest.mark.parametrize("row", TABLE["refused"] + TABLE["at_once"], ids=lambda row: row["line"])
def test_a_line_is_refused_in_one_line_with_what_is_accepted(row, folder, monkeypatch):
    place, before = folder
    monkeypatch.chdir(place)
    first, *words = shlex.split(row["line"])
    if "=" in first:
        monkeypatch.setitem(os.environ, *first.split("="))
    else:
        words = [first, *words]
    pattern = ".*".join(re.escape(part) for part in f"cointoss: {row['says']}\n".split("…"))
    assert re.fullmatch(pattern, told := refused(*words)), told
    assert held(place) == before


def test_what_a_look_refuses_is_refused_before_what_takes_long_is_imported(folder):
    script = (
        "import shlex, sys\nfrom click.testing import CliRunner\nfrom cointoss.compare.cli import main\n"
        "for line in sys.argv[1:]:\n"
        "    assert CliRunner().invoke(main, shlex.split(line)).exit_code == 2, line\n"
        "print(*sys.modules)"
    )
    done = python("-c", script, *(row["line"] for row in TABLE["at_once"]), folder=folder[0])
    assert done.returncode == 0, done.stderr
    assert not HEAVY & {*done.stdout.split()}
