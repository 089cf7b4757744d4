"""Finds an engine's library, or builds it where a checkout has none for its sources: once, whoever asks.

`python -m cointoss.models.kernel.building MODULE ...` has libraries ready.
"""

import hashlib
import os
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from cointoss.models.kernel.base_folder import EngineMissingError, base_folder
from cointoss.models.kernel.digests import HOME, digest_of
from cointoss.models.kernel.manifest import BROWSER, CUDA, MANIFEST, SYSTEM, Made, current
from cointoss.models.stages import stage

CARRIED = Path(__file__).with_name("engines")
"""The folder in which a wheel carries the libraries."""
NEEDED = ("numba", "llvmlite", "ziglang")
UNUSED = 3 * 24 * 3600.0
"""Libraries that were not used for so long are removed when another is built [s]."""
REFUSED = 2
"""Exit status of a build that says in one line why it can't be."""


def library_file(module: str, system: str | None = None) -> Path:
    """Return the file of an engine's library: that which a wheel carries, or the one of the sources here.

    The library of sources that have none yet is built.

    Args:
        module: the full name of the engine's table of entries.
        system: for which it is; by default this one.

    Raises:
        EngineMissingError: in one line.
    """
    system = system or SYSTEM
    name = module.split(".")[-2]
    if CARRIED.is_dir():
        manifest = CARRIED / f"{name}-{system}{MANIFEST}"
        made = Made.read(manifest, is_carried=True)
        if made is None and not manifest.exists():
            others = CARRIED.glob(f"{name}-*{MANIFEST}")
            there = sorted(each.name.removesuffix(MANIFEST).partition("-")[2] for each in others)
            raise EngineMissingError(
                f"{CARRIED}: no {name} engine for {system}; there is: {', '.join(there) or 'none'}"
            )
        file = manifest.with_suffix("")
        if made is None or digest_of(file) != made.digest:
            raise EngineMissingError(f"{file}: is damaged; install cointoss-dynamics again")
        return file
    folder = base_folder() / "engines"
    if (found := current(folder, name, system)) is not None:
        return found
    build_once(module, folder, [system])
    if (found := current(folder, name, system)) is not None:
        return found
    raise EngineMissingError(f"{folder}: the {name} engine was built, but of other sources; start again")


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
    import subprocess

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
    ]
    paths = filter(None, (str(HOME.parent), os.environ.get("PYTHONPATH")))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    shown = "" if systems[0] == SYSTEM else f" for {_WORDS.get(systems[0], systems[0])}"
    with stage(f"building the {name} engine{shown}, once", shown=True):
        done = subprocess.run(command, env=environment, text=True, capture_output=True, check=False)
    if done.returncode == REFUSED:
        raise EngineMissingError(f"the {name} engine could not be built: {done.stderr.strip()}")
    if done.returncode:
        print(done.stderr, end="", file=sys.stderr)  # numba's own words, for whoever has edited a function
        raise EngineMissingError(f"the {name} engine could not be built: exit status {done.returncode}")


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
    try:
        for module in sys.argv[1:]:
            library_file(module)
    except EngineMissingError as problem:
        print(f"cointoss: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
