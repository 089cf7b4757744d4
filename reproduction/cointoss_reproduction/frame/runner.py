"""The figures, claims and studies that can be reproduced, each a folder of `studies` named as it is."""

import importlib
import pkgutil
import shutil
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cointoss_reproduction import studies
from cointoss_reproduction.frame.files import CLAIMS, FOLDER, TABLE, folder_of, said_by

if TYPE_CHECKING:
    from cointoss.study import Progress
    from cointoss_reproduction.frame.result import Reproduction, Result

PARTS = "parts"
"""The folder with the finished part of an interrupted run."""


def names() -> list[str]:
    """Return the names of all that can be reproduced; none of their modules is imported."""
    return sorted(study.name.replace("_", "-") for study in pkgutil.iter_modules(studies.__path__))


def told(name: str) -> dict[str, Any]:
    """Return what the TOML file of one of the `names` says; its module is not imported."""
    return said_by(_module(name))


def find(name: str) -> "Reproduction":
    """Return what has one of the `names`; its module is imported."""
    return importlib.import_module(_module(name)).REPRODUCTION


def _module(name: str) -> str:
    return f"{studies.__name__}.{name.replace('-', '_')}.study"


def require_writable(name: str, out: Path) -> None:
    """Check that the files of one of the `names` would replace nothing but files.

    Raises:
        UnwritableError: naming what is in the way.
    """
    from cointoss.study import require_folder

    for folder in (out, out / FOLDER):
        require_folder(folder, ())
    require_folder(folder_of(name, out), find(name).files)


def reproduce(
    name: str,
    out: Path,
    progress: "Progress",
    *,
    quick: bool = False,
    beside: Path | None = None,
) -> "Result":
    """Compute one of the `names` and write its files into its folder, all of them or none.

    Args:
        name: what to reproduce.
        out: folder of all that is reproduced, made if missing.
        progress: called as the work goes on.
        quick: whether to make its quick size, if it has one.
        beside: folder of the results with which a study compares itself, by default `out`.

    Raises:
        UnwritableError: naming the folder and why.
    """
    from cointoss.study import written_together
    from cointoss_reproduction.frame import pages, provenance, saving

    found = find(name)
    require_writable(name, out)
    folder = folder_of(name, out)
    make = (found.quick if quick else None) or found.make
    if beside is not None and "out" in found.usual:
        make = partial(make, out=beside)
    if found.resumes:
        make = partial(make, kept=folder / PARTS)
    with written_together(folder, found.files) as aside:
        result = make(progress)
        saving.save(aside, result, found.draw)
        pages.write(aside, name, found, result, quick=quick)
        provenance.keep(aside, quick=quick)
    shutil.rmtree(folder / PARTS, ignore_errors=True)
    return result


def is_whole(name: str, out: Path) -> bool:
    """Return whether a run of one of the `names` left its claims below `out`, and a study its table."""
    folder = folder_of(name, out)
    return (folder / CLAIMS).exists() and (find(name).read is None or (folder / TABLE).exists())


def kept(name: str, out: Path) -> "Result":
    """Return what an earlier run of one of the `names` left below `out`: its claims, a study's all."""
    from cointoss_reproduction.frame.claim import read_claims
    from cointoss_reproduction.frame.result import Result

    found, folder = find(name), folder_of(name, out)
    return found.read(folder) if found.read else Result(claims=read_claims(folder / CLAIMS), data={})
