"""Fill a store with the tosses that it lacks."""

import math
import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.output.files import UnwritableError
from cointoss.compare.output.interruption import saying
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import layers_of, trust_layer
from cointoss.compare.sweep.pieces import Columns, pieces
from cointoss.compare.sweep.pixels import pixels_of
from cointoss.compare.sweep.store import Store
from cointoss.models.answers import tally
from cointoss.models.records import Outcome
from cointoss.models.stages import stage

Numbers = NDArray[np.intp]
Tosser = Callable[[Iterable[Numbers]], Iterator[tuple[Numbers, Columns]]]
"""Makes the tosses with these numbers, each part within a tile, and yields the parts, whole or cut, in any
order."""
DRAWING_BYTES_PER_PIXEL = 80
"""Memory that measuring and drawing a map takes, at most."""


def toss_here(sweep: Sweep) -> Tosser:
    """Return a `Tosser` of pixels, one part after the other, on all cores of this machine."""

    def toss(parts: Iterable[Numbers]) -> Iterator[tuple[Numbers, Columns]]:
        for numbers, answers in pieces(sweep.batch, sweep.how, parts):
            yield numbers, pixels_of(sweep, numbers, answers)

    return toss


def toss_part(sweep: Sweep, numbers: Numbers) -> Columns:
    """Return what is known of some pixels, tossed at once."""
    rows = sweep.batch.rows(numbers)
    how = sweep.how
    answers = how.engine.package.toss_rows(rows, settings=how.settings, trust=how.trust, device=how.processor)
    return pixels_of(sweep, numbers, answers)


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


def fractions_of(store: Store) -> dict[Outcome, float]:
    """Return the share of a map's pixels that each outcome fills, without the whole map in memory."""
    counts = np.zeros(len(Outcome), dtype=np.int64)
    for tile in store.tiles:
        counts += tally(store.read(tile))
    return {outcome: float(counts[outcome] / counts.sum()) for outcome in Outcome}


def trust_counts(store: Store, after: int | None) -> NDArray[np.int64]:
    """Return how many pixels have 0, 1, ... in the `trust_layer`, without the whole map in memory, (n,)."""
    most = 1 if after is None else after + 1
    counts = np.zeros(most + 1, dtype=np.int64)
    for tile in store.tiles:
        # A number that a stranger made larger takes no more room.
        found = np.minimum(store.read(tile, trust_layer(after)).ravel(), most)
        counts += np.bincount(found, minlength=len(counts))
    return counts


def require_room(sweep: Sweep, folder: Path, *, maps: int, drawn: bool) -> None:
    """Refuse a grid beyond the disk, or one to be drawn beyond the memory; the message says what it needs.

    Args:
        sweep: whose grid.
        folder: where the maps will be.
        maps: how many of them are not whole.
        drawn: whether they are measured or drawn as a whole.

    Raises:
        UnwritableError: if the disk has not room enough for maps that can't be compressed.
        SweepError: if the machine has not the memory.
    """
    pixels = sweep.shape[0] * sweep.shape[1]
    grid = f"{sweep.shape[1]} by {sweep.shape[0]} tosses"
    in_a_pixel = sum(np.dtype(layer.kind).itemsize for layer in layers_of(sweep).values())
    needed, free = maps * pixels * in_a_pixel, shutil.disk_usage(folder).free
    if needed > free:
        raise UnwritableError(
            f"{folder}: {grid} need up to {_bytes(needed)} of disk; accepted: a grid for the "
            f"{_bytes(free)} that are free"
        )
    pictures = 1 if sweep.margin is None else 2
    needed = pictures * pixels * DRAWING_BYTES_PER_PIXEL
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
