"""The provenance of a run: its sources, versions and machine; and hashes of the files that it wrote."""

import hashlib
import json
import platform
import sys
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any
from warnings import catch_warnings, simplefilter

from cointoss import Engine, UnsupportedError, load, named_scenarios
from cointoss.study import code_digest, read_bounded, rows_of, versions_of
from cointoss_reproduction.frame.files import CLAIMS, MOST_BYTES, PROVENANCE, TABLE

PACKAGES = ("mujoco", "numpy", "scipy")
"""The packages from whose numbers a result is made."""
FIRST_IMPACTS = 20
"""The largest number of impacts of the tosses from which `fingerprints` makes its digests."""
_OUTPUTS = (CLAIMS, TABLE)
_BOOK = Path(__file__).parents[1]


def provenance(folder: Path, *, quick: bool) -> dict[str, Any]:
    """Return what a run was made of, and the hashes of what it wrote.

    Args:
        folder: that was written.
        quick: whether it was the smaller size.
    """
    written = {name: folder / name for name in _OUTPUTS if (folder / name).exists()}
    return {
        "sources": sources(),
        "engines": fingerprints(),
        "quick": quick,
        "versions": {"python": platform.python_version(), **versions_of(PACKAGES)},
        "machine": machine(),
        "sha256": {name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in written.items()},
    }


def keep(folder: Path, *, quick: bool) -> None:
    """Write what a run was made of into its folder, after all else; see `provenance`."""
    made_of = json.dumps(provenance(folder, quick=quick), indent=1)
    (folder / PROVENANCE).write_text(made_of + "\n", encoding="utf-8")


@cache
def sources() -> str:
    """Return the digest of the sources of cointoss and of its studies."""
    digest = hashlib.sha256(code_digest().encode())
    for file in sorted(path for path in _BOOK.rglob("*") if path.suffix in (".py", ".toml")):
        digest.update(f"{file.relative_to(_BOOK)} ".encode() + file.read_bytes())
    return digest.hexdigest()[:16]


@cache
def fingerprints() -> dict[str, str]:
    """Return a digest of how each engine tosses the named scenarios, to the bit, by its name.

    Engines with the same fingerprint make the same tosses, on whatever system.
    """
    return {str(engine): _fingerprint(engine) for engine in Engine}


def _fingerprint(engine: Engine) -> str:
    digest = hashlib.sha256()
    for name in named_scenarios():
        scenario = load(name).replace("ending.max_impacts", FIRST_IMPACTS)
        with suppress(UnsupportedError), catch_warnings():
            simplefilter("ignore")
            found = engine.package.toss_rows(rows_of(scenario, 1), workers=1, device="cpu")
            digest.update(found.outcome.tobytes() + found.impacts.tobytes() + found.end_time.tobytes())
    return digest.hexdigest()[:16]


def older(made_of: Mapping[str, Any] | None) -> str:
    """Return which engines that made a run differ from those here, in words; empty if none differs."""
    if made_of is None or "engines" not in made_of:
        return "does not say by which engines it was made"
    other = [name for name, digest in fingerprints().items() if made_of["engines"].get(name) != digest]
    return f"is older than {' and '.join(other)}" if other else ""


def machine() -> dict[str, str]:
    """Return the kind of this machine, and the C library of what the engines do not compute."""
    return {
        "system": sys.platform,
        "architecture": platform.machine(),
        "libc": " ".join(filter(None, platform.libc_ver())),
    }


def read_provenance(path: Path) -> dict[str, Any] | None:
    """Return what a run was made of, by its file; None where there is none.

    Raises:
        ValueError: for a file that is not as `provenance` gives it.
    """
    if not path.exists():
        return None
    made_of = json.loads(read_bounded(path, MOST_BYTES))
    kinds = {"sources": str, "quick": bool, "versions": dict, "machine": dict}
    if not (isinstance(made_of, dict) and all(isinstance(made_of.get(key), kinds[key]) for key in kinds)):
        raise ValueError(f"needs {', '.join(kinds)}")
    return made_of


def unlike(there: Mapping[str, Any] | None, here: Mapping[str, Any]) -> str:
    """Return the differences of two runs that may change their bits, in words; empty if there are none."""
    if there is None:
        return f"no {PROVENANCE} there"
    other = ["other sources"] if there["sources"] != here["sources"] else []
    other += [
        f"{name} {there[kind].get(name)} there, {value} here"
        for kind in ("versions", "machine")
        for name, value in here[kind].items()
        if there[kind].get(name) != value
    ]
    return "; ".join(other)
