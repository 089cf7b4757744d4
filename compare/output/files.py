"""Write files whole or not at all: aside first, then renamed; what a killed process left aside is removed."""

import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

PREFIX, LOCK = ".cointoss-", ".lock"
"""What the name of a folder aside begins with, and the file in it that is locked while its process lives."""
PAGES = (".md", ".html")
"""How the names of pages end, which show what lies beside them."""


class UnwritableError(OSError):
    """A place that can't be written; the message names it and says why."""


def require_name(path: Path, suffixes: tuple[str, ...]) -> None:
    """Check that a path ends as it must, and that its folder exists.

    Raises:
        UnwritableError: naming the path and why.
    """
    if path.suffix.lower() not in suffixes:
        raise UnwritableError(
            f"{path}: another kind of file; accepted: a name that ends in {' or '.join(suffixes)}"
        )
    with naming(path):
        if not path.parent.is_dir():
            raise UnwritableError(
                f"{path}: no folder {path.parent}; accepted: a name in a folder that exists"
            )


def require_file(path: Path, suffixes: tuple[str, ...], source: str | None, *read: Path) -> None:
    """Check that a file can be written at `path`, in a folder that exists, and that nothing else is lost.

    Args:
        path: where to write; a link stands for what it points to.
        suffixes: of which its name must end in one.
        source: the scenario, if there is one, which must be another file.
        read: what else is read, which must be others, too.

    Raises:
        UnwritableError: naming the file and why.
    """
    require_name(path, suffixes)
    with naming(path):
        target = Path(os.path.realpath(path))
        if target.exists():
            require_replaceable(target, source, *read)
        tempfile.TemporaryFile(dir=target.parent).close()


def require_folder(folder: Path, names: tuple[str, ...], source: str | None = None) -> list[Path]:
    """Check that files can be written to a folder, and would replace nothing but files.

    Args:
        folder: it need not exist.
        names: of the files.
        source: the scenario, if there is one, which must be another file.

    Returns:
        Those of the files that exist.

    Raises:
        UnwritableError: naming the folder or the file in the way, and why.
    """
    with naming(folder):
        if os.path.lexists(folder) and not folder.is_dir():
            raise UnwritableError(f"{folder}: is no folder; accepted: a folder")
        there = next(part for part in (folder, *folder.parents) if os.path.lexists(part))
        tempfile.TemporaryFile(dir=there).close()
        in_the_way = [folder / name for name in names if os.path.lexists(folder / name)]
        for path in in_the_way:
            require_replaceable(path, source)
    return in_the_way


def require_replaceable(path: Path, source: str | None = None, *read: Path) -> None:
    """Check that what is at `path` is a file that may be replaced.

    Args:
        path: of what exists.
        source: the scenario, if there is one, which must be another file.
        read: what else is read, which must be others, too.

    Raises:
        UnwritableError: naming the file and why.
    """
    if path.is_symlink() or not path.is_file():
        kind = "folder" if path.is_dir() else "link or a device"
        raise UnwritableError(f"{path}: is a {kind}; accepted: a new name or a regular file")
    # The permission bits are checked too, because the superuser may write everything.
    if not (path.stat().st_mode & 0o222 and os.access(path, os.W_OK)):
        raise UnwritableError(f"{path}: is read-only; accepted: a new name or a file that can be written")
    if source is not None and Path(source).exists() and path.samefile(source):
        raise UnwritableError(f"{path}: is the scenario; accepted: another file")
    if any(Path(other).exists() and path.samefile(other) for other in read):
        raise UnwritableError(f"{path}: is what is read; accepted: another file")


def is_stream(path: Path) -> bool:
    """Return whether `path` is a device, a pipe, or where standard output goes: no file to replace."""
    with naming(path):
        return path.exists() and (_is_stdout(path) or not (path.is_file() or path.is_dir()))


def write_text(path: Path, text: str) -> None:
    """Write a text file whole or not at all; write to a stream directly.

    Raises:
        UnwritableError: naming the file and why.
    """
    with naming(path):
        if not is_stream(path):
            with written_whole(path) as aside:
                aside.write_text(text, encoding="utf-8")
        elif _is_stdout(path):  # opened a second time, a file would be written over from its start
            sys.stdout.write(text)
            sys.stdout.flush()
        else:
            path.write_text(text, encoding="utf-8")


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file whole or not at all.

    Raises:
        UnwritableError: naming the file and why.
    """
    with written_whole(path) as aside:
        aside.write_bytes(content)


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Yield a path beside `path` for a file or a folder; rename it to `path` when all went well.

    Raises:
        UnwritableError: naming the file and why, for every error of the system on the way.
    """
    with naming(path):
        target = Path(os.path.realpath(path))
        with aside_in(target.parent) as aside:
            made = aside / f"made{target.suffix.lower()}"
            yield made
            _move(made, target)


@contextmanager
def written_together(folder: Path, names: tuple[str, ...]) -> Iterator[Path]:
    """Yield a folder to write to; when all went well, it becomes `folder`, or its files go where that exists.

    A new folder appears whole, with the parents that it lacks. In one that exists each file is replaced by a
    rename, the pages last; then those of `names` that were not written are removed, as they belong to what is
    replaced. Until all are written, everything is as before. What ends the process between two of the renames
    leaves files of both, each whole.

    Raises:
        UnwritableError: naming the folder or the file in the way, and why, for every error of the system.
    """
    require_folder(folder, names)
    with naming(folder), aside_in(next(part for part in (folder, *folder.parents) if part.exists())) as aside:
        written = aside / "made"
        written.mkdir()
        yield written
        if folder.exists():
            _move_files(written, folder, names)
        else:
            folder.parent.mkdir(parents=True, exist_ok=True)
            _move(written, folder)


def _move_files(written: Path, folder: Path, names: tuple[str, ...]) -> None:
    """Move those of `names` that were written to a folder, and remove the others there."""
    replaced = require_folder(folder, names)
    new = [name for name in names if (written / name).exists()]
    for name in sorted(new, key=lambda name: name.endswith(PAGES)):
        _move(written / name, folder / name)
    for path in replaced:
        if path.name not in new:
            path.unlink()


@contextmanager
def aside_in(folder: Path) -> Iterator[Path]:
    """Yield a new folder inside `folder`, as a rename must stay on one disk, and remove it at the end.

    What earlier processes were killed at in `folder` is removed, too: the system has released their locks.
    """
    from filelock import FileLock  # takes longer to import than the command line

    for left in folder.glob(f"{PREFIX}*/{LOCK}"):
        with suppress(OSError, NotImplementedError), FileLock(left).acquire(blocking=False):
            shutil.rmtree(left.parent)
    with (
        tempfile.TemporaryDirectory(prefix=PREFIX, dir=folder, ignore_cleanup_errors=True) as name,
        ExitStack() as held,
    ):
        with suppress(NotImplementedError):  # a disk without locks, where nobody else gets one either
            # Another process that finds the folder before it is locked has the lock for a moment.
            held.enter_context(FileLock(Path(name) / LOCK).acquire(timeout=1))
        yield Path(name)


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Name a path in the system's errors about it."""
    try:
        yield
    except UnwritableError:
        raise
    except OSError as error:
        raise UnwritableError(f"{path}: can't be written ({error.strerror or error})") from None


def _is_stdout(path: Path) -> bool:
    try:
        return os.path.samestat(path.stat(), os.fstat(1))
    except OSError:
        return False


def _move(aside: Path, target: Path) -> None:
    """Rename a file or a folder to what it replaces, with the mode of that, if it is there."""
    if target.exists():
        aside.chmod(stat.S_IMODE(target.stat().st_mode))
    if aside.is_dir() and target.is_dir():
        target.rmdir()  # Windows replaces no folder, not even one that is empty
    aside.replace(target)
