"""The sources that a module's compiled code is made of, and their hash."""

import ast
import hashlib
import json
import threading
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from itertools import accumulate
from pathlib import Path

from cointoss.models.kernel import BEGUN
from cointoss.models.kernel.base_folder import base_folder
from cointoss.models.kernel.kept_file import read_kept, write_kept

PROJECT = __name__.partition(".")[0]
"""The package whose code is kept; what others compile is not."""
MOST_KEPT = 2000
"""Sources of which the imports are kept."""
_ABOUT = "imports, by package and source"
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
        digest.update(f"{name} {_digest(name, home)}\n".encode())
    _imports.keep()
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
    package = _package(module, home)
    names = _imports.of(_source(module, home) or b"", _digest(module, home), package)
    return frozenset(name for name in names if _source(name, home) is not None)


class _Imports:
    """What sources import from the project: kept, for to parse all of them takes longer than a toss."""

    def __init__(self) -> None:
        self._known: dict[str, list[str]] | None = None
        self._has_new = False
        # Python 3.11 counts how deep trees are for all threads together, and fails where two parse at once.
        self._parsing = threading.Lock()

    def of(self, source: bytes, digest: str, package: str) -> list[str]:
        """Return what may be modules of the project among the names that a source in a package imports."""
        known, key = self._known, f"{package} {digest}"
        if known is None:
            known = self._known = json.loads(read_kept(_kept_imports(), _ABOUT) or b"{}")
        if key not in known:
            with self._parsing:
                tree = ast.parse(source)
            found = {name for node in ast.walk(tree) for name in _imported_by(node, package)}
            known[key] = sorted(filter(part_of, found))
            self._has_new = True
        return known[key]

    def keep(self) -> None:
        """Keep what was found for the next process, the latest of it."""
        if self._has_new and self._known:
            latest = dict(list(self._known.items())[-MOST_KEPT:])
            with suppress(OSError):
                write_kept(_kept_imports(), _ABOUT, json.dumps(latest).encode())
            self._has_new = False


_imports = _Imports()


def _kept_imports() -> Path:
    return base_folder() / "imports"


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


@cache
def _file(module: str, home: Path) -> Path | None:
    """Return the file of a module of the project, None where there is none of this name."""
    if not part_of(module):
        return None
    path = home.joinpath(*module.split(".")[1:])
    return next((file for file in (path.with_suffix(".py"), path / "__init__.py") if file.is_file()), None)


@cache
def _digest(module: str, home: Path) -> str:
    return hashlib.sha256(_source(module, home) or b"").hexdigest()


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
    return file is None or file.stat().st_ctime <= BEGUN
