"""The package where only Unix's parts of Python are missing, as on Windows, and where there is no EGL."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.helpers.command_line import HERE

HIDING = """
import os, signal, sys

for name in ("fcntl", "resource", "pwd", "grp", "termios", "tty", "pty", "readline", "curses", "syslog",
             "mujoco.egl", "OpenGL.EGL"):
    assert name not in sys.modules or name == "pwd", name
    sys.modules[name] = None
for name in ("fork", "forkpty", "geteuid", "getuid", "fchmod", "sysconf", "O_NONBLOCK", "O_CLOEXEC", "mkfifo",
             "killpg", "setsid", "getpgid", "nice", "chown", "sched_getaffinity", "getloadavg"):
    delattr(os, name)
for name in ("SIGHUP", "SIGKILL", "SIGPIPE", "SIGALRM", "SIGCHLD", "SIGQUIT", "SIGWINCH"):
    delattr(signal, name)
"""
"""Python runs a file `sitecustomize.py` before all else, in child processes too."""
MAP = ("basin", "zloty", "--x", "release.angular_velocity.xi=20:30:6", "--y", "release.position.z=0.3:0.4:4")


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory):
    """Return what runs Python in such a place and returns what it prints; the locale is one of Windows'."""
    hiding = tmp_path_factory.mktemp("hiding")
    (hiding / "sitecustomize.py").write_text(HIDING, encoding="utf-8")
    paths = os.pathsep.join(filter(None, [str(hiding), HERE.get("PYTHONPATH", "")]))
    environment = {**HERE, "PYTHONPATH": paths, "PYTHONIOENCODING": "cp1252"}
    for name in ("DISPLAY", "MUJOCO_GL"):
        environment.pop(name, None)

    def run(*words):
        command = [sys.executable, *map(str, words)]
        done = subprocess.run(command, env=environment, capture_output=True, encoding="cp1252")
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def test_a_toss_is_printed_with_the_letters_that_the_code_page_has(elsewhere):
    """Those that it lacks are question marks."""
    printed = elsewhere("-m", "cointoss", "toss", "fig24a", "--max-impacts", "1", "--engine", "mujoco")
    assert "sequence  H" in printed


WHOLE = """
import importlib, pkgutil, sys
from pathlib import Path
from click.testing import CliRunner
from cointoss.compare.film.back_end import drawing_problem
from cointoss.compare.cli import main
print(drawing_problem())
names = [
    module.name
    for part in ("models", "analytic", "coin_mj", "compare")
    for module in pkgutil.walk_packages(
        importlib.import_module(f"cointoss.{part}").__path__, f"cointoss.{part}."
    )
]
print(len([importlib.import_module(name) for name in names if not name.endswith("__main__")]))
import cointoss.compare.sweep.store as store
folder = Path(sys.argv[1])
out = str(folder / "map.zarr")
made, *rest = [
    CliRunner().invoke(main, words, catch_exceptions=False).stdout
    for words in (
        [*sys.argv[2:], "--out", out],
        [*sys.argv[2:], "--out", out, "--resume"],
        ["toss", "fig24a", "--max-impacts", "1"],
        ["compare", "fig24a", "--set", "max_impacts=1", "--no-video", "--out", str(folder / "report")],
    )
]
print(made == rest[0], "sequence  H" in rest[1])
print(*sorted(path.name for path in [*folder.iterdir(), *(folder / "report").iterdir()]))
with store._locked(folder, folder):
    try:
        with store._locked(folder, folder): pass
    except store.UnwritableError as error: print(error)
"""


@pytest.mark.slow
def test_every_module_is_imported_and_a_map_and_a_report_are_made(elsewhere, tmp_path):
    # Without a lock of the system filelock warns that another process may break its own.
    problem, count, same, files, locked = elsewhere("-W", "ignore", "-c", WHOLE, tmp_path, *MAP).splitlines()
    assert problem.startswith("video needs an OpenGL library")
    assert int(count) > 300
    assert same == "True True"
    assert files == "map.zarr numbers.json path-analytic.csv path-mujoco.csv report report.html"
    assert locked == f"{tmp_path}: another process is at this map; accepted: wait for its end"


def test_an_engine_is_built_by_one_process_at_a_time(elsewhere, tmp_path):
    script = (
        "import sys; from pathlib import Path; import cointoss.models.kernel.building as building\n"
        "building._build = lambda _, name, folder, systems: print(name, *folder.glob('*.lock'))\n"
        "for _ in range(2): building.build_once('cointoss.analytic.entries', Path(sys.argv[1]))"
    )
    first, second = elsewhere("-W", "ignore", "-c", script, tmp_path).splitlines()
    assert first == second
    assert Path(first.removeprefix("analytic ")).match(f"{tmp_path}/analytic-*.lock")
