"""A step of make fails as its command does; what is not ready is not released; the container makes all."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

MAKEFILE = Path(__file__).parents[1] / "Makefile"
STEP = MAKEFILE.parent / ".ci" / "step"


def run(folder, *words):
    """Run a program in a folder, whose programs come before the system's."""
    environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "MAKEFLAGS": ""}
    return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)


@pytest.mark.parametrize(("status", "told", "shown"), [("0", "", ""), ("3", ", and failed:", "made\n")])
def test_a_step_fails_as_its_command_does_and_shows_then_what_it_printed(tmp_path, status, told, shown):
    done = run(tmp_path, STEP, "doing it", "sh", "-c", "echo made; exit $0", status)
    assert (done.returncode, done.stderr) == (int(status), shown)
    assert re.fullmatch(rf"doing it: \d+ s{told}\n", done.stdout)


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
    git = (
        f"#!/bin/sh\ncase $1 in status) printf %s '{changed}';; rev-parse) test \"$4\" = '{tagged}';; esac\n"
    )
    for name, text in {
        "git": git,
        "docs/CHANGELOG.md": f"# Changelog\n\n{heading}\n\n## 0.3.0, 2026-12-24\n",
        "pyproject.toml": '[project]\nname = "a"\nversion = "0.3.1"\n',
        f"tests/releases/{'0.3.0' if 'tests/releases' in says else '0.3.1'}/made/file": "",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "git").chmod(0o755)
    done = run(tmp_path, "make", "--no-print-directory", "-f", MAKEFILE, "releasable")
    assert (done.returncode != 0) == bool(says)
    assert (f"make release: {says}" if says else "") in done.stderr


def test_the_container_makes_all_results_and_pages_by_targets_that_there_are():
    container = (MAKEFILE.parent / "Containerfile").read_text(encoding="utf-8")
    asked, made = re.findall(r"^(?:RUN make|CMD) (.*)$", container, flags=re.MULTILINE)
    # Nothing is run; what is asked for must have rules.
    program, *targets = json.loads(made)
    done = run(MAKEFILE.parent, program, "--dry-run", "--always-make", *asked.split(), *targets)
    assert done.returncode == 0, done.stderr
    (listed,) = re.findall(r"cointoss reproduce (.*) --out docs$", done.stdout, flags=re.MULTILINE)
    assert set(listed.split()) == {path.name for path in (MAKEFILE.parent / "docs/reproduction").iterdir()}
