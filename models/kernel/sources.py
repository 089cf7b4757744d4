"""The sources that a module's compiled code is made of, and their hash."""

import hashlib
import re
import time
from functools import cache
from pathlib import Path

PACKAGES = ("models", "analytic", "coin_mj", "compare")
"""Packages with compiled functions; what others compile is not kept."""
_STARTED = time.time()
_TOP = Path(__file__).parents[2]
_IMPORT = re.compile(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+)?import[ \t]+(\([^)]*\)|[^\n]*)", re.MULTILINE)


@cache
def source_hash(module: str, top: Path = _TOP) -> str:
    """Return the hash of the sources of a module and of what it imports, directly or not, from `PACKAGES`.

    Args:
        module: its full name.
        top: the folder that holds the packages.
    """
    digest = hashlib.sha256()
    for name in _hashed(module, top):
        digest.update(f"{name}\n".encode())
        digest.update(_source(name, top) or b"")
    return digest.hexdigest()[:16]


@cache
def is_as_imported(module: str) -> bool:
    """Return whether none of the sources in a module's hash was written since this process began.

    One that was may not be the source that was imported, and what is compiled of it must not be kept for it.
    A time of writing that lies ahead is of another clock.
    """
    source_hash(module)  # it reads the sources: what is written later does not matter
    files = filter(None, (_file(name, _TOP) for name in _hashed(module, _TOP)))
    return not any(_STARTED < file.stat().st_mtime <= time.time() for file in files)


@cache
def imported(module: str, top: Path = _TOP) -> frozenset[str]:
    """Return the modules of `PACKAGES` that a module imports: a name that it imports may be one."""
    names = {module.rpartition(".")[0]}
    for start, listed in _IMPORT.findall((_source(module, top) or b"").decode()):
        found = [words.split()[0] for words in re.sub(r"[()]|#.*", "", listed).split(",") if words.split()]
        names |= {start, *(f"{start}.{name}" for name in found)} if start else set(found)
    parents = {name.rpartition(".")[0] for name in names}
    return frozenset(
        name
        for name in names | parents
        if name.partition(".")[0] in PACKAGES and _source(name, top) is not None
    )


@cache
def _hashed(module: str, top: Path) -> tuple[str, ...]:
    """Return the modules whose sources are in a module's hash, sorted."""
    found, todo = {module}, [module]
    while todo:
        new = imported(todo.pop(), top) - found
        found |= new
        todo += new
    return tuple(sorted(found))


def _file(module: str, top: Path) -> Path | None:
    """Return the file of a module, None where there is none of this name."""
    path = top.joinpath(*module.split("."))
    files = (path.with_suffix(".py"), path / "__init__.py")
    return next((file for file in files if file.is_file()), None)


@cache
def _source(module: str, top: Path) -> bytes | None:
    file = _file(module, top)
    return None if file is None else file.read_bytes()
