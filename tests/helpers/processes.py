"""Processes of Python that end with the test that starts them."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tests.helpers.command_line import HERE


@contextmanager
def started(*words: object, **how: Any) -> Iterator["subprocess.Popen[str]"]:
    """Start Python, which finds this checkout; at the end kill it where it still runs, and wait for it."""
    command = [sys.executable, *map(str, words)]
    with subprocess.Popen(command, **{"env": HERE, "text": True, **how}) as process:
        try:
            yield process
        finally:
            process.kill()
