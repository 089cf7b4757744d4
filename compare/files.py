"""Write a file whole or not at all: aside first, then renamed."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


class UnwritableError(OSError):
    """A place that can't be written; the message names it and says why."""


def require_folder(folder: Path) -> None:
    """Make `folder` where it is missing, and check that files can be made in it.

    Raises:
        UnwritableError: naming the folder and why.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise UnwritableError(
            f"{folder}: accepted: a folder that can be written ({error.strerror})"
        ) from None


def require_file(path: Path) -> None:
    """Check that a file can be written at `path`, in a folder that exists.

    Raises:
        UnwritableError: naming the file and why.
    """
    if path.is_dir():
        raise UnwritableError(f"{path}: accepted: a file (this is a folder)")
    if not path.parent.is_dir():
        raise UnwritableError(f"{path}: accepted: a file in a folder that exists ({path.parent} does not)")
    require_folder(path.parent)


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Give a path beside `path` to write to; rename it to `path` when all went well, else remove it."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    os.close(handle)
    aside = Path(name)
    try:
        yield aside
        mask = os.umask(0)
        os.umask(mask)
        aside.chmod(0o666 & ~mask)
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file whole or not at all."""
    with written_whole(path) as aside:
        aside.write_text(text, encoding="utf-8")
