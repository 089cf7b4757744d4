"""Fill a map with the tosses that it lacks."""

import math
import os
import shutil
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.output.files import UnwritableError
from cointoss.compare.output.interruption import Interruption
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep, Tile, cut, gaps
from cointoss.compare.sweep.layers import bytes_per_pixel, trust_layer
from cointoss.compare.sweep.pixels import Pixels, toss_pixels
from cointoss.compare.sweep.store import Map
from cointoss.models.outcomes import tally
from cointoss.models.records import Outcome
from cointoss.models.stages import stage

Tosser = Callable[[Sweep, Iterable[Tile]], Iterator[tuple[Tile, Pixels]]]
"""Tosses all pixels of tiles and gives these or parts of them, in any order."""

FIRST, GROWTH, SECOND = 8, 8, 1.0
"""Pixels of the first part that is tossed; how many times as many the next may have; and its time [s]."""
DRAWING_BYTES_PER_PIXEL = 80
"""Memory that measuring and drawing a map takes, at most."""


def toss_here(sweep: Sweep, tiles: Iterable[Tile]) -> Iterator[tuple[Tile, Pixels]]:
    """Toss tiles one after the other, on all cores of this machine, in parts of about a second.

    What a toss costs is known from the part before: some cost a thousand times what others do.
    """
    left, pixels = deque(tiles), FIRST
    while left:
        # Tosses of one coin are made together, so such pixels are kept together.
        part, rest = cut(left.popleft(), pixels, along_x=sweep.x.is_of_release or not sweep.y.is_of_release)
        left.extendleft(reversed(rest))
        start = time.perf_counter()
        tossed = toss_pixels(sweep, part)
        pixels = next_pixels(tossed.outcome.size, time.perf_counter() - start)
        yield part, tossed


def next_pixels(pixels: int, seconds: float) -> int:
    """Return how many pixels to toss next, where so many took so long [s]."""
    return max(1, int(pixels * min(GROWTH, SECOND / max(seconds, 1e-9))))


def missing(map_: Map) -> list[Tile]:
    """Return the parts of a map that are not on disk yet."""
    if map_.is_empty:
        return map_.tiles
    return [part for tile in map_.tiles for part in gaps(tile, map_.tossed(tile))]


def fill(map_: Map, sweep: Sweep, tosser: Tosser) -> None:
    """Toss what a map lacks and keep each part as soon as it is tossed; an interruption says what is kept.

    Raises:
        UnwritableError: naming the map and why.
        SweepError, UnsupportedError: for a pixel that can't be tossed.
    """
    left, whole, name = missing(map_), size(map_.tiles), map_.path.name
    kept = whole - size(left)
    try:
        with stage(name, "tosses", total=whole, done=kept) as progress:
            for tile, pixels in tosser(sweep, left):
                map_.write(tile, pixels)
                kept += pixels.outcome.size
                progress(kept, whole)
    except Interruption as interruption:
        interruption.message = f"{name}: {kept} of {whole} tosses are saved; --resume continues"
        raise


def fractions_of(map_: Map) -> dict[Outcome, float]:
    """Give the share of a map's pixels that each outcome fills, without the whole map in memory."""
    counts = np.zeros(len(Outcome), dtype=np.int64)
    for tile in map_.tiles:
        counts += tally(map_.read(tile))
    return {outcome: float(counts[outcome] / counts.sum()) for outcome in Outcome}


def trust_counts(map_: Map, after: int | None) -> NDArray[np.int64]:
    """Return how many pixels have 0, 1, ... in the `trust_layer`, without the whole map in memory, (n,)."""
    most = 1 if after is None else after + 1
    counts = np.zeros(most + 1, dtype=np.int64)
    for tile in map_.tiles:
        # A number that a stranger made larger takes no more room.
        found = np.minimum(map_.read(tile, trust_layer(after)).ravel(), most)
        counts += np.bincount(found, minlength=len(counts))
    return counts


def size(tiles: Iterable[Tile]) -> int:
    """Give the number of pixels of tiles."""
    return sum((rows.stop - rows.start) * (columns.stop - columns.start) for rows, columns in tiles)


def require_room(sweep: Sweep, folder: Path, *, maps: int, drawn: bool) -> None:
    """Refuse a grid beyond the disk, or one to be drawn beyond the memory; the message says what it needs.

    Args:
        sweep: whose grid.
        folder: where the maps will be.
        maps: how many of them.
        drawn: whether they are measured or drawn as a whole.

    Raises:
        UnwritableError: if the disk has not room enough for maps that can't be compressed.
        SweepError: if the machine has not the memory.
    """
    pixels = sweep.shape[0] * sweep.shape[1]
    grid = f"{sweep.shape[1]} by {sweep.shape[0]} tosses"
    needed, free = maps * pixels * bytes_per_pixel(sweep), shutil.disk_usage(folder).free
    if needed > free:
        raise UnwritableError(
            f"{folder}: {grid} need up to {_gigabytes(needed)} of disk; accepted: a grid for the "
            f"{_gigabytes(free)} that are free"
        )
    pictures = 1 if sweep.margin is None else 2
    needed = pictures * pixels * DRAWING_BYTES_PER_PIXEL
    there = _memory()
    if drawn and needed > there:
        raise SweepError(
            f"{grid}: to draw or compare them needs up to {_gigabytes(needed)} of memory; accepted: "
            f"a grid for the {_gigabytes(there)} of this machine, or the map alone"
        )


def _memory() -> float:
    """Return the memory of this machine [bytes]; infinite where the system does not say, as Windows."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError):
        return math.inf


def _gigabytes(count: float) -> str:
    return f"{count / 1e9:,.2f} GB"
