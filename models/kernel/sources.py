"""The sources that a module's compiled code is made of, and their hash."""

import hashlib
import re
import time
from functools import cache
from itertools import accumulate
from pathlib import Path

PACKAGES = ("models", "analytic", "coin_mj", "compare")
"""Packages with compiled functions; what others compile is not kept."""
_IMPORTED = time.time()
"""When modules began to be read: `models` imports this one first [s]."""
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


def is_as_imported(module: str) -> bool:
    """Return whether none of the sources in a module's hash was changed since this process began to import.

    One that was may not be the source that was imported, and what is compiled of it must not be kept for it.
    """
    source_hash(module)  # reads the sources: what is written after that does not matter
    return all(_is_older(name) for name in _hashed(module, _TOP))


@cache
def imported(module: str, top: Path = _TOP) -> frozenset[str]:
    """Return the modules of `PACKAGES` that a module imports: a name that it imports may be one.

    A package is among them where a name is imported from it, not where it only holds what is imported: else
    one whose `__init__` imports all its modules would tie each of them to all others.
    """
    names = set()
    for start, listed in _IMPORT.findall((_source(module, top) or b"").decode()):
        found = [words.split()[0] for words in re.sub(r"[()]|#.*", "", listed).split(",") if words.split()]
        if start:
            names |= {start, *(f"{start}.{name}" for name in found)}
        else:
            names |= {whole for name in found for whole in accumulate(name.split("."), "{}.{}".format)}
    return frozenset(
        name for name in names if name.partition(".")[0] in PACKAGES and _source(name, top) is not None
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


@cache
def _is_older(module: str) -> bool:
    """Return whether a source was last changed before the first import.

    An older file that is put in its place keeps the time at which it was written, but not that of its change.
    """
    file = _file(module, _TOP)
    return file is None or file.stat().st_ctime <= _IMPORTED
