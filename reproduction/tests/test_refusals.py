"""What `cointoss reproduce` refuses, in one line, what it lists, and what a shell completes."""

import pytest
from click.testing import CliRunner

from cointoss.compare.cli import main
from cointoss_reproduction.frame import runner
from tests.helpers.command_line import cointoss, refused

REFUSED = {
    "all": "--out: missing; accepted: main reproduce all --out DIR (see ",
    "--out out": "NAME: missing; accepted: all, or a name that cointoss reproduce --list prints",
    "nothing": "nothing: no such name; accepted: a name that cointoss reproduce --list prints",
    "fig42": "fig42: no such name; did you mean fig4? accepted: a name that cointoss reproduce --list prints",
    "contact-laws no-such --out out": "no-such: no such name; accepted: ",
    "contact_laws --out out": "contact_laws: no such name; did you mean contact-laws? accepted: ",
}


@pytest.mark.parametrize("line", REFUSED)
def test_a_line_is_refused_before_anything_is_written(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert REFUSED[line] in refused("reproduce", *line.split())
    assert list(tmp_path.iterdir()) == []


def test_a_shell_completes_the_names_of_studies():
    asking = {
        "_COINTOSS_COMPLETE": "bash_complete",
        "COMP_WORDS": "cointoss reproduce table",
        "COMP_CWORD": "2",
    }
    assert CliRunner().invoke(main, [], env=asking, prog_name="cointoss").stdout == "plain,table1\n"


def test_the_names_are_listed_with_their_titles():
    listed = cointoss("reproduce", "--list").stdout
    assert listed == cointoss("reproduce").stdout
    due = [(name, runner.told(name)) for name in runner.names()]
    for line, (name, said) in zip(listed.splitlines(), due, strict=True):
        assert line.split()[0] == name
        assert line.endswith(f"{said['title']} ({said['seconds']:g} s)")
        assert said.get("paper", "") in line
    assert cointoss("reproduce", "table1", "--list").stdout.startswith(
        "table1  Table 1: twelve Euler sequences"
    )
