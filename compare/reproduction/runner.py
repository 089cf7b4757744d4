"""The figures, claims and studies that can be reproduced, each a module of one of `ROOMS` named as it is."""

import importlib
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from compare.output.files import remove, require_folder, written_together
from compare.output.progress import Progress
from compare.reproduction import claims, paper, studies
from compare.reproduction.claim import Claim, read_claims

if TYPE_CHECKING:  # names are listed without it
    from matplotlib.figure import Figure

ROOMS = (paper, claims, studies)
FOLDER = "reproduction"
"""Holds the folders of all that was reproduced."""
PARTS = "parts"
"""Holds what an interrupted run had done."""
PAGE = "index.md"
"""The page of a figure of the paper."""
SHEETS = tuple(f"table-{number}.csv" for number in range(1, 20))
"""Long tables that a page shows."""


@dataclass(frozen=True, kw_only=True)
class Result:
    """What a run found."""

    claims: Sequence[Claim]
    data: Any
    """What its pictures show: arrays by name, or a record of numbers."""
    tables: str = ""
    """More of what it found, in Markdown, to be printed before the claims."""


@dataclass(frozen=True, kw_only=True)
class Reproduction:
    """A figure, a claim or a study that can be reproduced."""

    title: str
    """What it shows, in a few words."""
    seconds: float
    """Roughly how long it takes on two cores [s]."""
    make: Callable[..., Result]
    """Computes it, from a `Progress`; one that `resumes` from a folder `parts` too."""
    read: Callable[[Path], Result] | None = None
    """Reads what a run of it left in its folder, where that is more than claims."""
    draw: "Mapping[str, Callable[[Any], Figure]]"
    """Its pictures, by name, each drawn from the data."""
    quick: Callable[..., Result] | None = None
    """Computes a smaller size, where there is one."""
    quick_seconds: float | None = None
    """Roughly how long that takes on two cores [s]."""
    paper: str = ""
    """Its place in the paper, as in "Fig. 3"; empty for a study of this project."""
    resumes: bool = False
    """Whether it keeps what it has done in its folder, so that an interrupted run goes on."""
    assumed: str = ""
    """What the paper leaves unsaid, and what is assumed instead."""

    @property
    def files(self) -> tuple[str, ...]:
        """Names of all files that it may write."""
        pictures = (f"{name}.png" for name in self.draw)
        return ("claims.json", "data.npz", "numbers.json", PAGE, *SHEETS, *pictures)


def names() -> list[str]:
    """Return the names of all that can be reproduced; none of their modules is imported."""
    return sorted(name.replace("_", "-") for name in _rooms())


def _rooms() -> dict[str, str]:
    """Return the package of each module that can be reproduced, by its name."""
    return {module.name: room.__name__ for room in ROOMS for module in pkgutil.iter_modules(room.__path__)}


def find(name: str) -> Reproduction:
    """Return what has one of the `names`."""
    module = name.replace("-", "_")
    return importlib.import_module(f"{_rooms()[module]}.{module}").REPRODUCTION


def folder_of(name: str, out: Path) -> Path:
    """Return the folder of what one of the `names` writes below `out`."""
    return out / FOLDER / name


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
    """
    from compare.reproduction.pages import write
    from compare.reproduction.saving import save

    found = find(name)
    require_writable(name, out)
    folder = folder_of(name, out)
    make = (found.quick if quick else None) or found.make
    if found.resumes:
        make = partial(make, parts=folder / PARTS)
    with written_together(folder, found.files) as aside:
        result = make(progress)
        save(aside, result, found.draw)
        write(aside, name, found, result, quick=quick)
    remove(folder / PARTS)
    return result


def kept(name: str, out: Path) -> Result:
    """Return what an earlier run of one of the `names` left below `out`: its claims, a study's all."""
    found, folder = find(name), folder_of(name, out)
    return found.read(folder) if found.read else Result(claims=read_claims(folder / "claims.json"), data={})
