"""The sources that a module's compiled code is made of, and their hash."""

import ast
import hashlib
import time
from collections.abc import Iterator
from functools import cache
from itertools import accumulate
from pathlib import Path

PROJECT = __name__.partition(".")[0]
"""The package whose code is kept; what others compile is not."""
_IMPORTED = time.time()
"""When modules began to be read: `cointoss.models` imports this one first [s]."""
_HOME = Path(__file__).parents[2]


def part_of(module: str) -> str:
    """Return the part of the project that a module is in, such as "analytic"; "" for a module of others."""
    project, _, rest = module.partition(".")
    return rest.partition(".")[0] if project == PROJECT else ""


@cache
def source_hash(module: str, home: Path = _HOME) -> str:
    """Return the hash of the sources of a module and of what it imports, directly or not, from the project.

    Args:
        module: its full name.
        home: the folder that holds the project's parts.
    """
    digest = hashlib.sha256()
    for name in _hashed(module, home):
        digest.update(f"{name}\n".encode())
        digest.update(_source(name, home) or b"")
    return digest.hexdigest()[:16]


def is_as_imported(module: str) -> bool:
    """Return whether none of the sources in a module's hash was changed since this process began to import.

    One that was may not be the source that was imported, and what is compiled of it must not be kept for it.
    """
    source_hash(module)  # reads the sources: what is written after that does not matter
    return all(_is_older(name) for name in _hashed(module, _HOME))


@cache
def imported(module: str, home: Path = _HOME) -> frozenset[str]:
    """Return the modules of the project that a module imports: a name that it imports may be one.

    A package is among them where a name is imported from it, not where it only holds what is imported: else
    one whose `__init__` imports all its modules would tie each of them to all others.
    """
    tree = ast.parse(_source(module, home) or b"")
    names = {name for node in ast.walk(tree) for name in _imported_by(node, _package(module, home))}
    return frozenset(name for name in names if part_of(name) and _source(name, home) is not None)


def _imported_by(node: ast.AST, package: str) -> Iterator[str]:
    """Yield what one import statement in a module of `package` may import."""
    if isinstance(node, ast.Import):
        for alias in node.names:
            yield from accumulate(alias.name.split("."), "{}.{}".format)
    elif isinstance(node, ast.ImportFrom):
        above = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
        start = ".".join([*above, *filter(None, [node.module])])
        yield start
        yield from (f"{start}.{alias.name}" for alias in node.names)


def _package(module: str, home: Path) -> str:
    """Return the package in which a module's relative imports begin."""
    file = _file(module, home)
    return module if file is not None and file.name == "__init__.py" else module.rpartition(".")[0]


@cache
def _hashed(module: str, home: Path) -> tuple[str, ...]:
    """Return the modules whose sources are in a module's hash, sorted."""
    found, todo = {module}, [module]
    while todo:
        new = imported(todo.pop(), home) - found
        found |= new
        todo += new
    return tuple(sorted(found))


def _file(module: str, home: Path) -> Path | None:
    """Return the file of a module of the project, None where there is none of this name."""
    path = home.joinpath(*module.split(".")[1:])
    files = (path.with_suffix(".py"), path / "__init__.py")
    return next((file for file in files if part_of(module) and file.is_file()), None)


@cache
def _source(module: str, home: Path) -> bytes | None:
    file = _file(module, home)
    return None if file is None else file.read_bytes()


@cache
def _is_older(module: str) -> bool:
    """Return whether a source was last changed before the first import.

    An older file that is put in its place keeps the time at which it was written, but not that of its change.
    """
    file = _file(module, _HOME)
    return file is None or file.stat().st_ctime <= _IMPORTED
