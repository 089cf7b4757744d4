"""Refuse a map that the disk, or the memory, has no room for."""

import math
import os
import shutil
from pathlib import Path

import numpy as np

from cointoss.compare.output.files import UnwritableError
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.layout import Layout

DRAWING_BYTES_PER_PIXEL = 80
"""Memory that measuring and drawing a map takes, at most."""


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
