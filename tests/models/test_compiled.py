"""The cache of machine code notices an edit in a function that another compiled function calls."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import models.kernel.compiled
from models.kernel.compiled import COMPILED_PACKAGES, cache_folder

TOP = Path(models.kernel.compiled.__file__).parents[2]
IMPORT = "from models.kernel.compiled import compiled\n"
CALLEE = IMPORT + "\n\n@compiled\ndef part(x):\n    return {} * x\n"
CALLER = IMPORT + "from {} import part\n\n\n@compiled\ndef whole(x):\n    return part(x) + 1\n"


def run_caller(folder):
    script = "from analytic.caller import whole\nprint(whole(10.0), sum(whole.stats.cache_hits.values()))"
    environment = {"NUMBA_CACHE_DIR": str(folder / "cache"), "PATH": ""}
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    value, hits = done.stdout.split()
    return float(value), int(hits)


@pytest.mark.parametrize("callee", ["analytic.callee", "analytic.room.callee", "models.room.deeper.callee"])
def test_an_edited_callee_is_noticed(tmp_path, callee):
    kernel, caller = tmp_path / "models" / "kernel", tmp_path / "analytic" / "caller.py"
    edited = tmp_path.joinpath(*callee.split(".")).with_suffix(".py")
    for folder in (kernel, caller.parent, edited.parent):
        folder.mkdir(parents=True, exist_ok=True)
    # Without it the installed package would be found first.
    for package in ("models", "analytic"):
        (tmp_path / package / "__init__.py").touch()
    shutil.copy(TOP / "models" / "kernel" / "compiled.py", kernel)
    caller.write_text(CALLER.format(callee))

    edited.write_text(CALLEE.format(2.0))
    assert run_caller(tmp_path) == (21.0, 0)
    assert run_caller(tmp_path) == (21.0, 1), "the cache should be used where nothing changed"
    edited.write_text(CALLEE.format(3.0))
    assert run_caller(tmp_path) == (31.0, 0)


def test_every_package_with_compiled_functions_is_watched():
    users = {
        path.relative_to(TOP).parts[0]
        for package in ("models", "analytic", "coin_mj", "compare")
        for path in (TOP / package).rglob("*.py")
        if "@compiled" in path.read_text(encoding="utf-8")
    }
    assert users == set(COMPILED_PACKAGES)


def test_each_package_has_a_folder_that_its_own_sources_name(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    folders = {cache_folder.__wrapped__(package) for package in COMPILED_PACKAGES}
    assert {folder.parent for folder in folders} == {tmp_path}
    assert {folder.name.rpartition("-")[0] for folder in folders} == {
        f"cointoss-{package}" for package in COMPILED_PACKAGES
    }
    assert len({folder.name.rpartition("-")[2] for folder in folders}) == len(COMPILED_PACKAGES)
