"""Builds an engine's library where a checkout has none for its sources: once, whoever asks.

`python -m cointoss.models.kernel.building MODULE ...` has libraries ready.
"""

import hashlib
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.digests import HOME
from cointoss.models.kernel.library import BROWSER, CUDA, MANIFEST, SYSTEM, current
from cointoss.models.stages import stage

NEEDED = ("numba", "llvmlite", "ziglang")
UNUSED = 3 * 24 * 3600.0
"""Libraries that were not used for so long are removed when another is built [s]."""
REFUSED = 2
"""Exit status of a build that says in one line why it can't be."""


def build_once(module: str, folder: Path, systems: Sequence[str] = (SYSTEM,)) -> None:
    """Build an engine's libraries into a folder, or wait for another process that does.

    Args:
        module: the full name of the engine's table of entries.
        folder: that of the libraries.
        systems: for which they are; what is there already is not built.

    Raises:
        EngineMissingError: where it can't be built, in one line.
    """
    from filelock import FileLock

    name = module.split(".")[-2]
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        remove_unused(folder)
        checkout = hashlib.sha256(str(HOME).encode()).hexdigest()[:8]
        lock = FileLock(folder / f"{name}-{checkout}.lock")
        with stage(f"waiting for another process, which builds the {name} engine", shown=True):
            lock.acquire()
        try:
            if missing := [each for each in systems if current(folder, name, each) is None]:
                _build(module, name, folder, missing)
        finally:
            lock.release()
    except OSError as error:
        raise EngineMissingError(f"the {name} engine could not be built: {error}") from None


def _build(module: str, name: str, folder: Path, systems: Sequence[str]) -> None:
    if missing := [each for each in NEEDED if find_spec(each) is None]:
        raise EngineMissingError(
            f"no {name} engine for {' and '.join(systems)}, and no {', '.join(missing)} to build it; "
            "accepted: a wheel for this system, or pip install --group build in a checkout"
        )
    command = [
        sys.executable,
        "-P",
        "-m",
        "cointoss.models.kernel.build",
        module,
        "--out",
        str(folder),
        *(word for system in systems for word in ("--system", system)),
        "--of-parent",
    ]
    paths = filter(None, (str(HOME.parent), os.environ.get("PYTHONPATH")))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    given, parts = subprocess.PIPE, [""]
    shown = "" if systems[0] == SYSTEM else f" for {_WORDS.get(systems[0], systems[0])}"
    with (
        tempfile.TemporaryFile("w+") as errors,
        stage(f"building the {name} engine{shown}, once", detail=lambda: "".join(parts), shown=True),
        subprocess.Popen(
            command, env=environment, text=True, stdin=given, stdout=given, stderr=errors
        ) as process,
    ):
        try:
            for line in process.stdout or ():
                parts[:] = [line.strip()]
            process.wait()
        except BaseException:
            process.kill()  # LLVM would keep it from heeding less
            raise
        errors.seek(0)
        problem = errors.read()
    if process.returncode == REFUSED:
        raise EngineMissingError(f"the {name} engine could not be built: {problem.strip()}")
    if process.returncode:
        print(problem, end="", file=sys.stderr)  # numba's own words on a function, for whoever has edited it
        raise EngineMissingError(f"the {name} engine could not be built: exit status {process.returncode}")


_WORDS = {CUDA: "NVIDIA's cards", BROWSER: "a browser"}


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
