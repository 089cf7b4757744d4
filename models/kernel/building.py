"""Builds an engine's library where a checkout has none for its sources: once, whoever asks.

`python -m cointoss.models.kernel.building MODULE ...` has libraries ready.
"""

import hashlib
import io
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from cointoss.models.kernel.digests import HOME
from cointoss.models.kernel.library import CUDA, MANIFEST, SYSTEM, EngineMissingError, current

NEEDED = ("numba", "llvmlite", "ziglang")
UNUSED = 3 * 24 * 3600.0
"""Libraries that were not used for so long are removed when another is built [s]."""
REFUSED = 2
"""Exit status of a build that says in one line why it can't be."""
EVERY = 10.0
"""The line is written again so often, with the time so far [s]."""


def build_once(module: str, folder: Path, system: str = SYSTEM) -> None:
    """Build a library into a folder, or wait for another process that does.

    Raises:
        EngineMissingError: where it can't be built, in one line.
    """
    from filelock import FileLock, Timeout

    name = module.split(".")[-2]
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        remove_unused(folder)
        checkout = hashlib.sha256(str(HOME).encode()).hexdigest()[:8]
        lock, begun = FileLock(folder / f"{name}-{system}-{checkout}.lock"), time.monotonic()
        try:
            lock.acquire(blocking=False)
        except Timeout:
            with told(
                f"waiting for another process, which builds the {name} engine{_FOR.get(system, '')}", begun
            ):
                lock.acquire()
        try:
            if current(folder, name, system) is None:
                _build(module, name, folder, system)
        finally:
            lock.release()
    except OSError as error:
        raise EngineMissingError(f"the {name} engine could not be built: {error}") from None


def _build(module: str, name: str, folder: Path, system: str) -> None:
    if missing := [each for each in NEEDED if find_spec(each) is None]:
        raise EngineMissingError(
            f"there is no {name} engine for {system}, and no {', '.join(missing)} to build it; "
            "accepted: a wheel for this system, or pip install --group dev in a checkout"
        )
    command = [
        sys.executable,
        "-P",
        "-m",
        "cointoss.models.kernel.build",
        module,
        "--out",
        str(folder),
        "--system",
        system,
        "--of-parent",
    ]
    paths = filter(None, (str(HOME.parent), os.environ.get("PYTHONPATH")))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    with (
        told(f"building the {name} engine{_FOR.get(system, '')}, once", time.monotonic()),
        # It ends with this process, however that ends: then nobody holds its standard input any more.
        subprocess.Popen(command, env=environment, text=True, **_PIPES) as process,
    ):
        try:
            problem = (process.stderr or io.StringIO()).read()
            process.wait()
        except BaseException:
            process.send_signal(signal.SIGTERM)
            raise
    if process.returncode == REFUSED:
        raise EngineMissingError(f"the {name} engine could not be built: {problem.strip()}")
    if process.returncode:
        print(problem, end="", file=sys.stderr)  # numba's own words on a function, for whoever has edited it
        raise EngineMissingError(f"the {name} engine could not be built: exit status {process.returncode}")


_FOR = {CUDA: " for NVIDIA's cards"}
_PIPES: dict[str, Any] = {
    "stdin": subprocess.PIPE,
    "stdout": subprocess.DEVNULL,
    "stderr": subprocess.PIPE,
}


@contextmanager
def told(what: str, since: float) -> Iterator[None]:
    """Say on standard error what is done within, in one line, with its time so far [s]."""
    over, rewrites = threading.Event(), sys.stderr is not None and sys.stderr.isatty()

    def line(end: str) -> None:
        if sys.stderr is None:
            return
        with suppress(OSError, ValueError):  # nobody reads it, which stops no work
            text = f"{chr(13) * rewrites}cointoss: {what}: {time.monotonic() - since:.0f} s"
            print(text, end=end, file=sys.stderr, flush=True)

    def keep_telling() -> None:
        while not over.wait(0.25 if rewrites else EVERY):
            line("" if rewrites else "\n")

    teller = threading.Thread(target=keep_telling, daemon=True)
    teller.start()
    try:
        yield
    finally:
        over.set()
        teller.join()
        line("\n")


def remove_unused(folder: Path) -> None:
    """Remove libraries that no process has begun to use for long."""
    for manifest in folder.glob(f"*{MANIFEST}"):
        with suppress(OSError):
            if time.time() - manifest.stat().st_mtime > UNUSED:
                manifest.unlink()
                manifest.with_suffix("").unlink()


def main() -> int:
    """Have the libraries of the tables that the arguments name ready, and return the exit status."""
    from cointoss.models.kernel.library import library_file

    try:
        for module in sys.argv[1:]:
            library_file(module)
    except EngineMissingError as problem:
        print(f"cointoss: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
