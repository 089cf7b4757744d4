"""A tile of a finer map than the one that is explored, tossed when one zooms past the pixels."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import NOT_TOSSED
from cointoss.compare.sweep.run import toss_part

SIDE = 32
"""Side of a tile, in pixels of the finer map."""
FINEST = 30
"""Levels; at each a pixel is cut in two along both axes."""


def toss_tile(sweep: Sweep, level: int, column: int, row: int) -> NDArray[np.int8]:
    """Return the outcomes of a tile, (SIDE, SIDE); -1 outside of the map.

    At a level a pixel of the map is cut into 2^level by 2^level of the finer map. The tiles begin with the
    lower left corner of the map's first pixel.

    Args:
        sweep: of the map, with the device that tosses.
        level: from 0, the map's own, to `FINEST`.
        column: of the tile, from 0.
        row: of the tile, from 0.

    Raises:
        SweepError: for a tile outside of the map, or of no such level.
        DeviceError: for the device "cuda" where it fails.
    """
    tiles = [-(-(count << level) // SIDE) if 0 <= level <= FINEST else 0 for count in sweep.shape]
    if not (0 <= row < tiles[0] and 0 <= column < tiles[1]):
        raise SweepError(f"level = {level}, column = {column}, row = {row}: accepted: a tile of the map")
    if "ending.max_impacts" in (sweep.x.field, sweep.y.field):
        raise SweepError("ending.max_impacts: has no values between two pixels")
    x, columns = _values(sweep.x, level, column)
    y, rows = _values(sweep.y, level, row)
    outcome = np.full((SIDE, SIDE), NOT_TOSSED, dtype=np.int8)
    if x is not None and y is not None:
        finer = replace(sweep, x=x, y=y, margin=None, trust=False)
        finer.how.processor.expect(len(sweep.batch) << 2 * level)  # of the whole finer map
        tossed = toss_part(finer, np.arange(y.count * x.count))["outcome"]
        outcome[rows, columns] = tossed.reshape(finer.shape)
    return outcome


def _values(axis: Axis, level: int, tile: int) -> tuple[Axis | None, slice]:
    """Return the part of an axis that a tile has, None for nothing, and where in the tile it lies."""
    places = (np.arange(SIDE) + tile * SIDE + 0.5) / (1 << level) - 0.5
    inside = np.flatnonzero((places >= 0) & (places <= axis.count - 1))
    if not len(inside):
        return None, slice(0, 0)
    ends = axis.start + places[inside[[0, -1]]] * ((axis.stop - axis.start) / (axis.count - 1))
    part = replace(axis, start=float(ends[0]), stop=float(ends[1]), count=len(inside))
    return part, slice(int(inside[0]), int(inside[-1]) + 1)
