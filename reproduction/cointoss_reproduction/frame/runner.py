"""The figures, claims and studies that can be reproduced, each a folder of `studies` named as it is."""

import importlib
import pkgutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from cointoss.study import Progress, remove, require_folder, written_together
from cointoss_reproduction import studies
from cointoss_reproduction.frame.claim import read_claims
from cointoss_reproduction.frame.result import FOLDER, Reproduction, Result, folder_of

PARTS = "parts"
"""Holds what an interrupted run had done."""


def names() -> list[str]:
    """Return the names of all that can be reproduced; none of their modules is imported."""
    return sorted(study.name.replace("_", "-") for study in pkgutil.iter_modules(studies.__path__))


def find(name: str) -> Reproduction:
    """Return what has one of the `names`."""
    return importlib.import_module(f"{studies.__name__}.{name.replace('-', '_')}.study").REPRODUCTION


def require_writable(name: str, out: Path) -> None:
    """Check that the files of one of the `names` would replace nothing but files.

    Raises:
        UnwritableError: naming what is in the way.
    """
    for folder in (out, out / FOLDER):
        require_folder(folder, ())
    require_folder(folder_of(name, out), find(name).files)


def reproduce(name: str, out: Path, progress: Progress, *, quick: bool = False) -> Result:
    """Compute one of the `names` and write its files into its folder, all of them or none.

    Args:
        name: what to reproduce.
        out: folder of all that is reproduced, made if missing.
        progress: called as the work goes on.
        quick: whether to make its quick size, if it has one.

    Raises:
        UnwritableError: naming the folder and why.
        ImportError: in one line, where numba is missing, by which a study compiles functions of its own.
    """
    from cointoss_reproduction.frame.pages import write
    from cointoss_reproduction.frame.saving import keep_provenance, save

    found = find(name)
    require_writable(name, out)
    folder = folder_of(name, out)
    make = (found.quick if quick else None) or found.make
    if found.resumes:
        make = partial(make, kept=folder / PARTS)
    with written_together(folder, found.files) as aside:
        with _numba_named(name):
            result = make(progress)
        save(aside, result, found.draw)
        write(aside, name, found, result, quick=quick)
        keep_provenance(aside, quick=quick)
    remove(folder / PARTS)
    return result


@contextmanager
def _numba_named(name: str) -> Iterator[None]:
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name not in ("numba", "flint"):
            raise
        raise ImportError(f"{name}: needs {error.name}: pip install cointoss-reproduction") from None


def kept(name: str, out: Path) -> Result:
    """Return what an earlier run of one of the `names` left below `out`: its claims, a study's all."""
    found, folder = find(name), folder_of(name, out)
    return found.read(folder) if found.read else Result(claims=read_claims(folder / "claims.json"), data={})
