"""The command line, run in this process or in another that finds this checkout."""

import os
import subprocess
import sys
from pathlib import Path

from click.testing import CliRunner, Result

from cointoss.compare.cli import main
from cointoss_bounce.command import main as mj_bounce_main

HERE = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), "PYTHONDONTWRITEBYTECODE": "1"}


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
    "cointoss.analytic",
    "cointoss.coin_mj",
}
"""Modules whose import takes long; without them no engine is looked for."""


def cointoss(*arguments: object) -> Result:
    """Return the answer of `cointoss` to those arguments."""
    return CliRunner().invoke(main, [str(part) for part in arguments], catch_exceptions=False)


def mj_bounce(*arguments: object) -> Result:
    """Return the answer of `mj-bounce` to those arguments."""
    return CliRunner().invoke(mj_bounce_main, [str(part) for part in arguments], catch_exceptions=False)


def printed(*arguments: object) -> str:
    """Return what `cointoss` prints for those arguments, with exit status 0."""
    answered = cointoss(*arguments)
    assert answered.exit_code == 0, answered.stderr
    return answered.stdout


def refused(*arguments: object) -> str:
    """Return the one line that `cointoss` answers to those arguments, with exit status 2 and nothing else."""
    answered = cointoss(*arguments)
    assert (answered.exit_code, answered.stdout) == (2, ""), answered.stderr
    assert answered.stderr.startswith("cointoss: ")
    assert answered.stderr.count("\n") == answered.stderr.endswith("\n") == 1
    return answered.stderr


def python(
    *words: object, folder: Path | None = None, **environment: str
) -> "subprocess.CompletedProcess[str]":
    """Run Python, which finds this checkout, with more in its environment, and return what it answers."""
    return subprocess.run(
        [sys.executable, *map(str, words)],
        cwd=folder,
        env={**HERE, **environment},
        capture_output=True,
        text=True,
    )


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
