"""Runs ziglang, which compiles, links, and brings musl's sources."""

import subprocess
import sys
from pathlib import Path


def run_zig(*words: str | Path) -> None:
    """Run one of its tools, such as `cc`.

    Raises:
        RuntimeError: where it fails or is missing, in one line.
    """
    command = [sys.executable, "-m", "ziglang", *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        lines = done.stderr.strip().splitlines() or ["it says nothing"]
        told = next((line for line in lines if "error: " in line), lines[-1])
        raise RuntimeError(f"ziglang's {words[0]} failed: {told}")
