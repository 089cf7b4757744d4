"""The cache of machine code sees an edit in a function that another compiled function calls."""

import shutil
import subprocess
import sys
from pathlib import Path

import models.compiled
from models.compiled import COMPILED_PACKAGES, cache_folder

TOP = Path(models.compiled.__file__).parent.parent
CALLEE = "from models.compiled import compiled\n\n\n@compiled\ndef part(x):\n    return {} * x\n"
CALLER = (
    "from analytic.callee import part\nfrom models.compiled import compiled\n\n\n"
    "@compiled\ndef whole(x):\n    return part(x) + 1\n"
)


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


def test_an_edited_callee_is_seen(tmp_path):
    for package in ("models", "analytic"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text("")
    shutil.copy(TOP / "models" / "compiled.py", tmp_path / "models")
    (tmp_path / "analytic" / "caller.py").write_text(CALLER)

    (tmp_path / "analytic" / "callee.py").write_text(CALLEE.format(2.0))
    assert run_caller(tmp_path) == (21.0, 0)
    assert run_caller(tmp_path) == (21.0, 1), "the cache should be used where nothing changed"
    (tmp_path / "analytic" / "callee.py").write_text(CALLEE.format(3.0))
    assert run_caller(tmp_path) == (31.0, 0)


def test_every_package_with_compiled_functions_is_watched():
    users = {
        path.relative_to(TOP).parts[0]
        for package in ("models", "analytic", "coin_mj", "compare")
        for path in (TOP / package).rglob("*.py")
        if "@compiled" in path.read_text(encoding="utf-8")
    }
    assert users == set(COMPILED_PACKAGES)


def test_the_folder_is_named_by_the_sources():
    assert cache_folder().name.startswith("cointoss-")
    assert cache_folder().is_dir()
