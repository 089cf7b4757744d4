"""Parts of a long study, kept in a folder so that an interrupted run goes on where it was."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from cointoss.study import beside

Part = Mapping[str, NDArray[Any]]


def kept(folder: Path, name: str, compute: Callable[[], Part]) -> Part:
    """Return a part of a study: what an earlier run kept, else what `compute` gives, which is kept.

    Args:
        folder: of the parts, made if missing.
        name: of the part; it names all that the part depends on.
        compute: gives the part, arrays by name.
    """
    path = folder / f"{name}.npz"
    try:
        # A damaged file would be left open by NumPy.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return dict(arrays)
    except (OSError, ValueError, EOFError, BadZipFile):
        part = compute()
    folder.mkdir(parents=True, exist_ok=True)
    aside = beside(path)
    np.savez_compressed(aside, allow_pickle=False, **part)
    aside.replace(path)
    return part
