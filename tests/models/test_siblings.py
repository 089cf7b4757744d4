"""A foreign package with the name of one of the four is named, with the package that it shadows."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("models", "analytic", "coin_mj", "compare")


def run_python(command, folder):
    """Run Python in a folder, which comes before ours on its path."""
    return subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])},
    )


@pytest.mark.parametrize("foreign", PACKAGES)
def test_each_of_the_others_names_the_foreign_package_and_its_own(tmp_path, foreign):
    (tmp_path / foreign).mkdir()
    (tmp_path / foreign / "__init__.py").touch()
    for imported in set(PACKAGES) - {foreign}:
        done = run_python(["-c", f"import {imported}"], tmp_path)
        assert done.stderr.splitlines()[-1].startswith(
            f"ImportError: {tmp_path / foreign / '__init__.py'} shadows cointoss's package {foreign}, "
            f"{ROOT / foreign / '__init__.py'}; accepted: "
        )


def test_the_command_says_so_in_one_line_with_exit_status_2(tmp_path):
    (tmp_path / "models.py").touch()
    done = run_python([Path(sys.executable).with_name("cointoss"), "--version"], tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith(f"cointoss: {tmp_path / 'models.py'} shadows cointoss's package models, ")


def test_a_folder_that_shadows_nothing_is_no_harm(tmp_path):
    """A folder without __init__.py yields to a package later on the path."""
    for name in PACKAGES:
        (tmp_path / name).mkdir()
    done = run_python(["-c", "import compare, models; print(compare.__file__, models.__file__)"], tmp_path)
    ours = [str(ROOT / name / "__init__.py") for name in ("compare", "models")]
    assert done.stdout.split() == ours, done.stderr


def test_a_foreign_package_that_is_imported_already_is_named(tmp_path):
    """As in a notebook that used a package of its own before; `cointoss` itself is imported without any."""
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "__init__.py").touch()
    script = "import models, sys; sys.path.remove(sys.argv[1]); import cointoss; print(cointoss.load)"
    done = run_python(["-c", script, str(tmp_path)], tmp_path)
    assert done.stderr.splitlines()[-1].startswith(
        f"ImportError: {tmp_path / 'models' / '__init__.py'} shadows cointoss's package models, "
        f"{ROOT / 'models' / '__init__.py'}; accepted: no other module of this name imported before"
    )
    made = "import sys, types; sys.modules['coin_mj'] = types.ModuleType('coin_mj'); import analytic"
    done = run_python(["-c", made], tmp_path.parent)
    assert (
        "ImportError: <module 'coin_mj'> shadows cointoss's package coin_mj" in done.stderr.splitlines()[-1]
    )
