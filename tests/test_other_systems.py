"""The package where only Unix's parts of Python are missing, as on Windows, and where there is no EGL."""

import json
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


def test_what_only_unix_has_is_missing_there(elsewhere):
    script = (
        "import os, signal, sys\n"
        "print(sys.modules['fcntl'], hasattr(os, 'fork'), hasattr(signal, 'SIGHUP'), sys.stdout.encoding)"
    )
    assert elsewhere("-c", script) == "None False False cp1252\n"


@pytest.mark.slow
def test_every_module_is_imported(elsewhere):
    script = (
        "import importlib, pkgutil\n"
        "names = ['cointoss']\n"
        "for part in ('models', 'analytic', 'coin_mj', 'compare'):\n"
        "    package = importlib.import_module(f'cointoss.{part}')\n"
        "    names += [m.name for m in pkgutil.walk_packages(package.__path__, f'cointoss.{part}.')]\n"
        "print(len([importlib.import_module(name) for name in names if not name.endswith('__main__')]))"
    )
    assert int(elsewhere("-c", script)) > 300


@pytest.mark.slow_after_first
@pytest.mark.parametrize("engine", ["analytic", "mujoco"])
def test_both_engines_toss(elsewhere, engine):
    tossed = json.loads(elsewhere("-m", "cointoss", "toss", "fig24a", "--engine", engine, "--json"))
    assert tossed["engine"] == engine
    assert tossed["sequence"].startswith("H")
    # The letters that the code page lacks are question marks.
    assert "sequence" in elsewhere("-m", "cointoss", "toss", "fig24a", "--engine", engine)


@pytest.mark.slow
def test_a_map_is_made_locked_and_resumed(elsewhere, tmp_path):
    out = tmp_path / "map.zarr"
    made = elsewhere("-m", "cointoss", *MAP, "--out", out)
    script = (
        "import sys; from pathlib import Path; import cointoss.compare.sweep.store as store\n"
        "path = Path(sys.argv[1])\n"
        "with store._locked(path, path):\n"
        "    try:\n"
        "        with store._locked(path, path): pass\n"
        "    except store.UnwritableError as error: print(error)"
    )
    # Without a lock of the system filelock warns that another process may break its own.
    said = elsewhere("-W", "ignore", "-c", script, out)
    assert said == f"{out}: another process is at this map; accepted: wait for its end\n"
    assert elsewhere("-m", "cointoss", *MAP, "--out", out, "--resume") == made
    assert [path.name for path in tmp_path.iterdir()] == ["map.zarr"]


@pytest.mark.slow
def test_a_report_is_made_and_says_why_it_has_no_video(elsewhere, tmp_path):
    script = "from cointoss.compare.film.back_end import drawing_problem; print(drawing_problem())"
    problem = elsewhere("-c", script)
    assert problem.startswith("video needs an OpenGL library")
    elsewhere("-m", "cointoss", "compare", "table", "--no-video", "--out", tmp_path / "report")
    assert "table" in (tmp_path / "report" / "report.html").read_text(encoding="utf-8")


def test_an_engine_is_built_by_one_process_at_a_time(elsewhere, tmp_path):
    script = (
        "import sys; from pathlib import Path; import cointoss.models.kernel.building as building\n"
        "building._build = lambda _, name, folder, systems: print(name, *folder.glob('*.lock'))\n"
        "for _ in range(2): building.build_once('cointoss.analytic.entries', Path(sys.argv[1]))"
    )
    said = elsewhere("-W", "ignore", "-c", script, tmp_path)
    (lock,) = {line.removeprefix("analytic ") for line in said.splitlines()}
    assert len(said.splitlines()) == 2
    assert Path(lock).parent == tmp_path
    assert Path(lock).match("analytic-*.lock")
