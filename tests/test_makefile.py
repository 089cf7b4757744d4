"""A long step of make says what it does and that it still runs, and fails as its command does."""

import os
import subprocess
from pathlib import Path

MAKEFILE = Path(__file__).parents[1] / "Makefile"
SLEEP = """#!/bin/sh
if [ ! -e once ]; then touch once; else touch twice; exit 1; fi
"""
"""The first ten seconds pass at once, the next never."""


def test_a_long_step_says_that_it_runs_and_ends_as_its_command_does(tmp_path):
    (tmp_path / "sleep").write_text(SLEEP)
    (tmp_path / "sleep").chmod(0o755)
    waits = "sh -c 'while [ ! -e twice ]; do /bin/sleep 0.01; done; exit 3'"
    (tmp_path / "step.mk").write_text(f"include {MAKEFILE}\nstep:\n\t@$(call told,doing it,{waits})\n")
    done = subprocess.run(
        ["make", "--no-print-directory", "-f", "step.mk", "step"],
        cwd=tmp_path,
        env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "MAKEFLAGS": ""},
        capture_output=True,
        text=True,
    )
    assert done.stdout.splitlines() == ["doing it", "doing it: 10 s"]
    assert "Error 3" in done.stderr


def test_what_is_told_to_be_quiet_is_told_of():
    recipes = [line for line in MAKEFILE.read_text().splitlines() if line.startswith("\t")]
    quiet = [line for line in recipes if " --quiet" in line or "sphinx-build -q" in line]
    assert len(quiet) == 4
    assert all("$(call told," in line for line in quiet)
