"""Fill a store with the tosses that it lacks, or with a map from memory."""

import math
import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.output.files import UnwritableError
from cointoss.compare.output.interruption import saying
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.layout import Layout, layout_of
from cointoss.compare.sweep.maps import asked_of, layers_in, name_of
from cointoss.compare.sweep.pieces import Columns
from cointoss.compare.sweep.store import Store, opened, require_place
from cointoss.compare.sweep.tiles import numbers_in
from cointoss.models.stages import stage

if TYPE_CHECKING:
    import xarray as xr

Numbers = NDArray[np.intp]
Tosser = Callable[[Iterable[Numbers]], Iterator[tuple[Numbers, Columns]]]
"""Makes the tosses with these numbers, each part within a tile, and yields the parts, whole or cut, in any
order."""
DRAWING_BYTES_PER_PIXEL = 80
"""Memory that measuring and drawing a map takes, at most."""


def fill(store: Store, tosser: Tosser, *, shown: bool | None = None) -> None:
    """Toss what a store lacks and keep each part as soon as it is tossed; an interruption says what is kept.

    Raises:
        UnwritableError: naming the store and why.
        ScenarioError, UnsupportedError: for what can't be tossed.
    """
    whole, name = math.prod(store.shape), store.path.name
    left = [tile for tile in store.tiles if store.missing(tile).size]
    kept = whole - sum(int(store.missing(tile).size) for tile in left)
    with (
        saying(lambda _: f"{name}: {kept} of {whole} tosses are saved; `resume` continues"),
        stage(name, "tosses", total=whole, done=kept, shown=shown) as progress,
    ):
        for numbers, layers in tosser(map(store.missing, left)):
            store.write(numbers, layers)
            kept += len(numbers)
            progress(kept, whole)


def save_map(dataset: "xr.Dataset", path: Path, *, overwrite: bool) -> None:
    """Write a map from memory into a store; see `cointoss.compare.accessor.Tosses.save`."""
    (batch, how), name = asked_of(dataset), dataset.attrs.get("name", "")
    if (stride := dataset.attrs.get("stride", 1)) > 1:
        raise SweepError(f"{name_of(dataset)}: one pixel of every {stride} is here; accepted: a whole map")
    require_place(path, resume=False, overwrite=overwrite)
    layers = layers_in(dataset)
    with opened(path, layout_of(batch, how, name=name), overwrite=overwrite) as kept:
        for tile in kept.tiles:
            parts = {layer: array[tile].ravel() for layer, array in layers.items()}
            kept.write(numbers_in(tile, kept.shape).ravel(), parts)


def require_room(layout: Layout, folder: Path, *, maps: int, drawn: bool) -> None:
    """Refuse a grid beyond the disk, or one to be drawn beyond the memory; the message says what it needs.

    Args:
        layout: of each map.
        folder: where the maps will be.
        maps: how many of them are not whole.
        drawn: whether they are measured or drawn as a whole.

    Raises:
        UnwritableError: if the disk has not room enough for maps that can't be compressed.
        SweepError: if the machine has not the memory.
    """
    pixels, (ny, nx) = len(layout.batch), layout.batch.shape
    grid = f"{nx} by {ny} tosses"
    in_a_pixel = sum(np.dtype(layer.kind).itemsize for layer in layout.layers.values())
    needed, free = maps * pixels * in_a_pixel, shutil.disk_usage(folder).free
    if needed > free:
        raise UnwritableError(
            f"{folder}: {grid} need up to {_bytes(needed)} of disk; accepted: a grid for the "
            f"{_bytes(free)} that are free"
        )
    needed = (1 + ("margin" in layout.layers)) * pixels * DRAWING_BYTES_PER_PIXEL
    there = _memory()
    if drawn and needed > there:
        raise SweepError(
            f"{grid}: to draw or compare them needs up to {_bytes(needed)} of memory; accepted: "
            f"a grid for the {_bytes(there)} of this machine, or the map alone"
        )


def _memory() -> float:
    """Return the memory of this machine [bytes]; infinite where the system does not say, as Windows."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError):
        return math.inf


def _bytes(count: float) -> str:
    """Return a number of bytes in the unit that shows it."""
    unit, size = ("GB", 1e9) if count >= 1e9 else ("MB", 1e6) if count >= 1e6 else ("kB", 1e3)
    return f"{count / size:,.1f} {unit}"
