"""A tile of a finer map than the one that is explored, tossed when one zooms past the pixels."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.maps import asked, asked_of, axes_of
from cointoss.compare.sweep.pieces import toss_part
from cointoss.models.answers import NOT_TOSSED
from cointoss.models.devices import Device

if TYPE_CHECKING:
    import xarray as xr

SIDE = 32
"""Side of a tile, in pixels of the finer map."""
FINEST = 30
"""Levels; at each a pixel is cut in two along both axes."""


def toss_tile(
    found: "xr.Dataset", level: int, column: int, row: int, device: Device = Device.CPU
) -> NDArray[np.int8]:
    """Return the outcomes of a tile, (SIDE, SIDE); -1 outside of the map.

    At a level a pixel of the map is cut into 2^level by 2^level of the finer map. The tiles begin with the
    lower left corner of the map's first pixel.

    Args:
        found: the map.
        level: from 0, the map's own, to `FINEST`.
        column: of the tile, from 0.
        row: of the tile, from 0.
        device: that tosses.

    Raises:
        SweepError: for a tile outside of the map, or of no such level.
        DeviceError: for the device "cuda" where it fails.
    """
    axes, (batch, how) = axes_of(found), asked_of(found)
    tiles = [-(-(axis.count << level) // SIDE) if 0 <= level <= FINEST else 0 for axis in axes]
    if not (0 <= row < tiles[0] and 0 <= column < tiles[1]):
        raise SweepError(f"level = {level}, column = {column}, row = {row}: accepted: a tile of the map")
    if "ending.max_impacts" in [axis.field for axis in axes]:
        raise SweepError("ending.max_impacts: has no values between two pixels")
    (y, rows), (x, columns) = (
        _values(axis, level, tile) for axis, tile in zip(axes, (row, column), strict=True)
    )
    outcome = np.full((SIDE, SIDE), NOT_TOSSED, dtype=np.int8)
    if x is not None and y is not None:
        finer, how = asked(
            batch.scenario,
            x,
            y,
            engine=how.engine,
            settings=how.settings,
            after=how.after,
            device=device,
        )
        how.processor.expect(len(batch) << 2 * level)  # of the whole finer map
        tossed = toss_part(finer, how, np.arange(len(finer)))["outcome"]
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
