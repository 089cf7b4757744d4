"""The figures and studies that can be reproduced, each a module of one of `ROOMS` named as it is."""

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from compare.output.files import require_folder, written_together
from compare.reproduction import claims, paper, studies

ROOMS = (paper, claims, studies)

Progress = Callable[[int, int], None]
"""Called after each part of a job with their number so far and in all."""


@dataclass(frozen=True, kw_only=True)
class Made:
    """What a run gave, beside its files."""

    text: str
    """The results, to be printed."""
    failed: tuple[str, ...]
    """The claims of the figure that its numbers don't bear out."""


@dataclass(frozen=True, kw_only=True)
class Figure:
    """A figure or a study that can be reproduced."""

    title: str
    """What it shows, in a few words."""
    seconds: float
    """Roughly how long it takes on two cores [s]."""
    files: tuple[str, ...]
    """Names of the files it writes."""
    run: Callable[[Path, Progress], Made]
    """Compute it, write its files into a folder that exists, and check its claims."""
    quick: Callable[[Path, Progress], Made] | None = None
    """The same at a smaller size, where there is one."""
    quick_seconds: float = 0.0
    """Roughly how long that takes on two cores [s]."""
    paper: str = ""
    """Its place in the paper, as in "Fig. 3"; empty for a study of our own."""
    assumed: str = ""
    """What the paper leaves unsaid, and what is taken here."""


def names() -> list[str]:
    """Give the names of all that can be reproduced; no figure's module is imported."""
    return sorted(name.replace("_", "-") for name in _rooms())


def _rooms() -> dict[str, str]:
    """Give the package of each module that can be reproduced, by its name."""
    return {module.name: room.__name__ for room in ROOMS for module in pkgutil.iter_modules(room.__path__)}


def find(name: str) -> Figure:
    """Give a figure by its name, one of `names`."""
    module = name.replace("-", "_")
    return importlib.import_module(f"{_rooms()[module]}.{module}").FIGURE


def folder_of(name: str, out: Path) -> Path:
    """Give the folder of a figure's files, and check that they would replace nothing but files.

    Args:
        name: of the figure.
        out: folder of all figures; it need not exist.

    Raises:
        UnwritableError: naming what is in the way.
    """
    require_folder(out, ())
    require_folder(out / name, find(name).files)
    return out / name


def reproduce(name: str, out: Path, progress: Progress, *, quick: bool = False) -> Made:
    """Compute a figure and write its files into the folder `out`/`name`, all of them or none.

    Args:
        name: of the figure, one of `names`.
        out: folder of all figures, made if missing.
        progress: called as the work goes on.
        quick: whether to make its quick size, if it has one.

    Raises:
        UnwritableError: naming the folder and why.
    """
    figure = find(name)
    with written_together(folder_of(name, out), figure.files) as aside:
        return (figure.quick if quick and figure.quick else figure.run)(aside, progress)
