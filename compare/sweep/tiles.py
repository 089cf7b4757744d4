"""The tiles in which a batch is tossed into a store."""

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.batch import Batch

TILE_TOSSES = {Engine.ANALYTIC: 1 << 14, Engine.MUJOCO: 1 << 10}
"""The most tosses in a tile, which is a file: seconds of work, so that each of many workers has some."""
SLOW_TILE_TOSSES = 1 << 6
"""The most tosses in a tile where the air is not linear: each toss is thousands of times slower."""
MARGIN_TOSSES = 64
"""About how many tosses the margin of a pixel takes."""
MOST_TILES = 1 << 13
"""About the most tiles in a store; a large one has larger tiles."""


def tile_shape(engine: Engine, batch: Batch, each: int = 1) -> tuple[int, ...]:
    """Return the lengths of a tile: seconds of work, as long as it can be along the last dimensions.

    Args:
        engine: that tosses.
        batch: of tosses.
        each: how many tosses each of them takes.
    """
    is_slow = batch.scenario.air.exponent > 0 or "air.exponent" in batch.fields
    most = min(TILE_TOSSES[engine], SLOW_TILE_TOSSES) if is_slow else TILE_TOSSES[engine]
    most, lengths = max(most // each, len(batch) // MOST_TILES), list[int]()
    for size in reversed(batch.shape):
        lengths.append(max(1, min(size, most)))
        most //= lengths[-1]
    return tuple(reversed(lengths))


def tiles(shape: tuple[int, ...], tile: tuple[int, ...]) -> Iterator[tuple[slice, ...]]:
    """Cut a grid into tiles in the order of a C array; those at the far ends may be smaller.

    Args:
        shape: of the grid.
        tile: of a tile, along the same dimensions.
    """
    sides = (range(0, size, length) for size, length in zip(shape, tile, strict=True))
    for corner in product(*sides):
        yield tuple(
            slice(first, min(first + length, size))
            for first, length, size in zip(corner, tile, shape, strict=True)
        )


def numbers_in(part: tuple[slice, ...], shape: tuple[int, ...]) -> NDArray[np.intp]:
    """Return the numbers, in the order of a C array, of what lies in a part of a grid, over that part."""
    sides = (np.arange(one.start, one.stop) for one in part)
    return np.ravel_multi_index(np.ix_(*sides), shape)
