"""Processes of Python that end with the test that starts them."""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from tests.helpers.command_line import HERE


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


def wait_until(process: "subprocess.Popen[str]", holds: Callable[[], object]) -> None:
    """Wait until something holds that a process, which still runs then, brings about."""
    deadline = time.monotonic() + 200
    while not holds() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.01)
    assert process.poll() is None, process.communicate()
