"""Ctrl-C, SIGTERM and SIGHUP end every command soon, with one line, and leave nothing half-made."""

import signal
import time

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.sweep import layout
from tests.helpers.basin_runs import AXES, SCENARIO, SMALL, assert_same, basin, pixels
from tests.helpers.command_line import python
from tests.helpers.processes import HANGS, answered, ask, started, wait_until

STATUSES = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}

ENDLESS = """
import hashlib
from pathlib import Path

def endless():
    Path("begun").touch()
    hashlib.pbkdf2_hmac("sha256", b"", b"", (1 << 31) - 1)
"""
"""For a child process: a call that, like compiled code, gives Python no chance for minutes, and lets other
threads run. It leaves a file `begun`."""


def of_toss(*engines):
    """Return the head of a script in which a toss of these engines never ends after its third impact."""
    within = {"cointoss.analytic": "runs", "cointoss.coin_mj": "toss"}
    stuck = "toss_coin = lambda *given: (given[-1].fill(3), endless())"
    lines = [f"import {name}; sys.modules['{name}.{within[name]}'].{stuck}" for name in engines]
    return "\n".join([f"{ENDLESS}import sys", "from cointoss.compare.cli import main", *lines, ""])


def wait_until_begun(process, folder):
    wait_until(process, (folder / "begun").exists)


def ended(folder, number, script, *arguments):
    """Send a signal to a script once it has begun; return its exit status and what it said."""
    with started("-c", script, *arguments, cwd=folder) as process:
        wait_until_begun(process, folder)
        time.sleep(0.1)
        ask(process, number)
        _, said = answered(process)
        return process.returncode, said


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("engine", "number"),
    [*((Engine.ANALYTIC, number) for number in STATUSES), (Engine.MUJOCO, signal.SIGINT)],
)
def test_a_toss_is_interrupted(tmp_path, engine, number):
    script = of_toss(engine.package.__name__) + "main()"
    time = 3 if engine == Engine.ANALYTIC else 0
    said = f"cointoss: interrupted by {number.name}: 3 impacts in {time} s of the coin's time\n"
    toss = ("toss", "fig24a", "--engine", engine)
    assert ended(tmp_path, number, script, *toss) == (STATUSES[number], said)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "tossing"),
    [(Engine.ANALYTIC, "analytic.many"), (Engine.MUJOCO, "coin_mj.on_machines")],
)
def test_a_map_is_interrupted_in_a_tile_and_resumed_to_the_same_pixels(here, monkeypatch, engine, tossing):
    monkeypatch.setitem(layout.TILE_TOSSES, engine, SMALL)
    (here / "coin.toml").write_text(SCENARIO + "[ending]\nmax_impacts = 1\n")
    asked = ("coin.toml", "--x", f"{AXES[1][:-2]}20", "--y", f"{AXES[3][:-2]}20", "--engine", engine)
    script = (
        f"{ENDLESS}\nfrom cointoss.compare.cli import main; from cointoss.compare.engines import Engine\n"
        "from cointoss.compare.sweep import layout\n"
        f"layout.TILE_TOSSES[Engine('{engine}')] = {SMALL}\n"
        f"import cointoss.{tossing} as of_many\n"
        "in_tiles, left = of_many.in_tiles, [5]\n"
        "def some(n, most, work, workers):\n"
        "    left[0] -= 1\n"
        "    in_tiles(n, most, work if left[0] > 0 else lambda _: endless(), workers)\n"
        "of_many.in_tiles = some\n"
        "main()"
    )
    status, said = ended(here, signal.SIGTERM, script, "basin", *asked, "--out", "map.zarr")
    kept = np.sum(pixels(here / "map.zarr")["impacts"] >= 0)
    assert 0 < kept < 400
    assert (status, said) == (
        143,
        f"cointoss: map.zarr: {kept} of 400 tosses are saved; --resume continues\n",
    )
    assert {path.name for path in here.iterdir()} == {"begun", "coin.toml", "map.zarr"}
    assert basin(*asked, "--out", "map.zarr", "--resume").exit_code == 0
    assert basin(*asked, "--out", "undisturbed.zarr").exit_code == 0
    assert_same(here / "map.zarr", pixels(here / "undisturbed.zarr"))


def test_in_python_ctrl_c_raises_out_of_a_toss_and_of_many(tmp_path):
    script = of_toss("cointoss.analytic", "cointoss.coin_mj") + (
        "from cointoss import analytic, coin_mj\n"
        "import cointoss.analytic.many as of_many\n"
        "in_tiles = of_many.in_tiles\n"
        "of_many.in_tiles = lambda n, most, _, workers: in_tiles(n, most, lambda _: endless(), workers)\n"
        "from cointoss.models.batch import rows_of\n"
        "from cointoss.models.reading import load\n"
        "fig = load('fig24a')\n"
        "for each in (analytic.toss, coin_mj.toss, lambda one: analytic.toss_rows(rows_of(one, 9999))):\n"
        "    try: each(fig)\n"
        "    except KeyboardInterrupt: print('back', flush=True)\n"
        "import os; os._exit(0)"
    )
    with started("-c", script, cwd=tmp_path) as process:
        for _ in range(3):
            wait_until_begun(process, tmp_path)
            (tmp_path / "begun").unlink()
            time.sleep(0.1)
            ask(process, signal.SIGINT)
            assert process.stdout is not None
            assert process.stdout.readline() == "back\n"
        assert process.wait(HANGS) == 0


ENDING = f"""{ENDLESS}
import os, signal, sys, threading
from cointoss.compare.output.files import written_together, written_whole
from cointoss.compare.output.interruption import run_to_exit
from cointoss.models.interruptible import interruptible

"""


@pytest.mark.parametrize("number", STATUSES)
def test_an_interruption_of_compiled_code_leaves_nothing_half_made(tmp_path, number):
    script = ENDING + (
        "def command():\n"
        "    with written_together(Path('new/folder'), ('a',)) as a, written_whole(Path('file')) as b:\n"
        "        (a / 'a').touch(), b.touch()\n"
        "        interruptible(endless)\n"
        "run_to_exit(command)"
    )
    status, said = ended(tmp_path, number, script)
    assert (status, said) == (STATUSES[number], f"cointoss: interrupted by {number.name}\n")
    assert [path.name for path in tmp_path.iterdir()] == ["begun"]


ENDS = {
    "another thread": "threading.Thread(target=threading.Event().wait).start(); threading.Event().wait()",
    "another error on the way out": (
        "try: threading.Event().wait()\n    except BaseException: raise ValueError('because of it')"
    ),
    # C has no place for what is raised: Python prints a traceback there, and goes on.
    "a call from C": "import ctypes; ctypes.CFUNCTYPE(None)(threading.Event().wait)()",
}


@pytest.mark.parametrize("end", ENDS)
def test_nothing_keeps_the_process_and_what_was_printed_before_is_there(tmp_path, end):
    script = f"{ENDING}def command():\n    print('first')\n    Path('begun').touch()\n    {ENDS[end]}\n"
    with started("-c", script + "run_to_exit(command)", cwd=tmp_path) as process:
        wait_until_begun(process, tmp_path)
        ask(process, signal.SIGINT)
        assert answered(process) == ("first\n", "cointoss: interrupted by SIGINT\n")
    assert process.returncode == 130


@pytest.mark.slow_after_first
@pytest.mark.parametrize("name", ["cointoss", "cointoss/__main__.py"])
def test_a_script_that_imports_the_package_keeps_its_ctrl_c(tmp_path, name):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text(
        "import signal, cointoss\n"
        "cointoss.load('fig24a'), cointoss.compare, cointoss.Engine('analytic').package\n"
        "print(signal.getsignal(signal.SIGINT) == signal.default_int_handler)\n"
    )
    done = python(tmp_path / name, folder=tmp_path)
    assert (done.stdout, done.stderr) == ("True\n", "")


def test_the_command_leaves_no_traceback_even_while_it_is_imported():
    script = (
        "import builtins, os, signal\n"
        "own = builtins.__import__\n"
        "def importing(name, *more):\n"
        "    if name == 'cointoss.compare.cli': os.kill(os.getpid(), signal.SIGINT)\n"
        "    return own(name, *more)\n"
        "builtins.__import__ = importing\n"
        "from cointoss.__main__ import main\n"
        "main()"
    )
    done = python("-c", script)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_a_signal_that_is_ignored_stays_so(tmp_path):
    script = ENDING + (
        "def command():\n"
        "    os.kill(os.getpid(), signal.SIGHUP)\n"
        "    print('goes on')\n"
        "    sys.exit(3)\n"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does\n"
        "run_to_exit(command)"
    )
    with started("-c", script, cwd=tmp_path) as process:
        assert answered(process) == ("goes on\n", "")
    assert process.returncode == 3
