"""A long step of make says that it runs, and fails as its command does; what is not ready is not released."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

from tests.helpers.command_line import cointoss

MAKEFILE = Path(__file__).parents[1] / "Makefile"
STEP = MAKEFILE.parent / ".ci" / "step"
SLEEP = """#!/bin/sh
if [ ! -e once ]; then touch once; else touch twice; exit 1; fi
"""
"""The first minute passes at once, the next never."""


def make(folder, *words, program=("make", "--no-print-directory")):
    """Run make, or another program, in a folder, whose programs come before the system's."""
    environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "MAKEFLAGS": ""}
    return subprocess.run([*program, *words], cwd=folder, env=environment, capture_output=True, text=True)


def test_a_long_step_says_that_it_runs_and_shows_what_it_printed_where_it_fails(tmp_path):
    (tmp_path / "sleep").write_text(SLEEP)
    (tmp_path / "sleep").chmod(0o755)
    waits = "echo made; while [ ! -e twice ]; do /bin/sleep 0.01; done; exit $0"
    for status in ("0", "3"):
        done = make(tmp_path, "doing it", "sh", "-c", waits, status, program=(STEP,))
        lines = [re.sub(r"\b\d+ s\b", "N s", line) for line in done.stdout.splitlines()]
        assert lines == ["doing it: N s", "doing it: N s" if status == "0" else "doing it: N s, and failed:"]
        assert (done.returncode, done.stderr) == (int(status), "" if status == "0" else "made\n")
        (tmp_path / "once").unlink()
        (tmp_path / "twice").unlink()


READY = "## 0.3.1, 2027-01-31"
UNREADY = 'docs/CHANGELOG.md needs a heading "## 0.3.1, YYYY-MM-DD"\n'


@pytest.mark.parametrize(
    ("changed", "heading", "tagged", "says"),
    [
        ("", READY, "", ""),
        (" M README.md", READY, "", "commit first, or put aside:\n M README.md"),
        ("", "## 0.3.1, not yet released", "", UNREADY),
        ("", "## 0.3.10, 2027-01-31", "", UNREADY),
        ("", READY, "", "tests/releases/0.3.1/ needs files of this release; docs/CONTRIBUTING.md says"),
        ("", READY, "refs/tags/v0.3.1", "v0.3.1 is tagged; pyproject.toml needs another version\n"),
    ],
)
def test_what_is_not_ready_is_not_released(tmp_path, changed, heading, tagged, says):
    git = f"""#!/bin/sh
case $1 in
  status) printf %s '{changed}' ;;
  rev-parse) test "$4" = '{tagged}' ;;
esac
"""
    (tmp_path / "git").write_text(git)
    (tmp_path / "git").chmod(0o755)
    if "tests/releases" not in says:
        (tmp_path / "tests" / "releases" / "0.3.1" / "made").mkdir(parents=True)
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "CHANGELOG.md").write_text(f"# Changelog\n\n{heading}\n\n## 0.3.0, 2026-12-24\n")
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "a"\nversion = "0.3.1"\n')
    done = make(tmp_path, "-f", str(MAKEFILE), "releasable")
    assert (done.returncode != 0) == bool(says)
    assert (f"make release: {says}" if says else "") in done.stderr


def test_the_container_makes_all_results_and_pages_by_targets_that_there_are():
    container = (MAKEFILE.parent / "Containerfile").read_text(encoding="utf-8")
    (asked,) = re.findall(r"^RUN make (.*)$", container, flags=re.MULTILINE)
    (made,) = re.findall(r"^CMD (.*)$", container, flags=re.MULTILINE)
    program, *targets = json.loads(made)
    # Nothing is run; what is asked for must have rules.
    assert program == "make"
    done = make(MAKEFILE.parent, "--dry-run", "--always-make", *asked.split(), *targets)
    assert done.returncode == 0, done.stderr
    (listed,) = re.findall(r"cointoss reproduce (.*) --out docs$", done.stdout, flags=re.MULTILINE)
    assert set(listed.split()) == {path.name for path in (MAKEFILE.parent / "docs/reproduction").iterdir()}
    assert set(listed.split()) <= {line.split()[0] for line in cointoss("reproduce").stdout.splitlines()}


def test_what_is_reported_first_is_the_lab():
    done = make(MAKEFILE.parent, "--dry-run", "report")
    printed = re.findall(r"^\S*cointoss lab --out (.*)$|cointoss compare", done.stdout, flags=re.MULTILINE)
    assert printed == ["out/lab.html", ""]
