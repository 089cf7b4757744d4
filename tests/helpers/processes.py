"""Processes of Python that end with the test that starts them; what is soon is processor time."""

import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.helpers.command_line import HERE

HANGS = 1200.0
"""What takes longer hangs: no honest wait does on a busy machine [s]; a third of pytest's own limit."""
SOON = 10
"""Processor time in which a process ends that is asked to [s]; what it waits for does not count."""


@contextmanager
def started(*words: object, **how: Any) -> Iterator["subprocess.Popen[str]"]:
    """Start Python, which finds this checkout; at the end kill it where it still runs, and wait for it.

    Args:
        words: what it runs.
        how: more arguments of `Popen`; by default what it prints is read as text.
    """
    command = [sys.executable, *map(str, words)]
    piped = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, **{"env": HERE, **piped, **how}) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_until(process: "subprocess.Popen[Any]", holds: Callable[[], object]) -> None:
    """Wait until something holds that a process, which still runs then, brings about."""
    deadline = time.monotonic() + HANGS
    while not holds() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.01)
    assert process.poll() is None, process.communicate()


def ask(process: "subprocess.Popen[str]", number: signal.Signals) -> None:
    """Send a signal to a process, which the system kills where it goes on for longer than `SOON`."""
    import resource  # other tests run on Windows too

    ticks = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
    spent = math.ceil(sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK"))
    # The hard limit stays: not everybody may raise it again for the next signal.
    _, hard = resource.prlimit(process.pid, resource.RLIMIT_CPU)
    resource.prlimit(process.pid, resource.RLIMIT_CPU, (spent + SOON, hard))
    process.send_signal(number)


def answered(process: "subprocess.Popen[str]") -> tuple[str, str]:
    """Return what a process has printed and said, once it has ended."""
    return process.communicate(timeout=HANGS)
