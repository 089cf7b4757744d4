"""A sweep, and the tiles that it is tossed in."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.scenario import Scenario
from cointoss.models.title import title_of_toss

if TYPE_CHECKING:
    from cointoss.compare.metrics.margin import Quantity

TILE_TOSSES = {Engine.ANALYTIC: 1 << 14, Engine.MUJOCO: 1 << 10}
"""Most tosses in a tile, which is a file: seconds of work, so that many workers have some."""
SLOW_TILE_TOSSES = 1 << 6
"""Where the air is not linear, each toss is thousands of times slower."""
MARGIN_TOSSES = 64
"""Tosses that the margin of a pixel takes, about."""
MOST_TILES = 1 << 13
"""In a map, about; a large one has larger tiles."""


class Tile(NamedTuple):
    """A rectangle of pixels."""

    rows: slice
    columns: slice


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """What a map is made of: a scenario, two of whose fields vary, tossed by one engine."""

    scenario: Scenario
    engine: Engine
    x: Axis
    y: Axis
    settings: EngineSettings
    """Of its engine."""
    after: int | None = None
    """The map shows the face at the touch after so many impacts; None for the final outcome."""
    margin: str | None = None
    """Name of the quantity of the release along which each pixel has its margin; with its axis in Greek."""
    trust: bool = False
    """Whether it is found which pixels can be trusted."""
    name: str = ""
    """What its scenario is called; empty for one without a name."""

    def __post_init__(self) -> None:
        """Check that the axes, `after`, and the engine with what is asked of it go together.

        The margin's quantity is named in full.

        Raises:
            SweepError: naming the field.
        """
        fields = {self.x.field, self.y.field}
        if len(fields) == 1:
            raise SweepError(f"{self.x.field}: on both axes; accepted: two fields")
        if self.after is not None and "ending.max_impacts" in fields:
            raise SweepError(
                f"ending.max_impacts: an axis beside after = {self.after}; accepted: one of the two"
            )
        if self.trust and self.engine != Engine.ANALYTIC:
            raise SweepError(f"trust: by {self.engine}, accepted: only by the analytic engine")
        if self.margin is not None:
            if self.engine != Engine.ANALYTIC:
                by = f"{self.margin!r} by {self.engine}"
                raise SweepError(f"margin: {by}, accepted: only by the analytic engine")
            object.__setattr__(self, "margin", self.quantity.name)

    @property
    def quantity(self) -> "Quantity":
        """The quantity along which each pixel has its margin, of a sweep with margins."""
        from cointoss.compare.metrics.margin import quantity_of

        try:
            return quantity_of(self.margin or "")
        except ValueError as error:
            raise SweepError(f"margin {error}") from None

    @property
    def title(self) -> str:
        """Which coin is tossed, in a few words, but for what varies."""
        return title_of_toss(self.scenario, self.name, varied=(self.x.field, self.y.field))

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels in y and x."""
        return self.y.count, self.x.count


def tile_shape(sweep: Sweep) -> tuple[int, int]:
    """Give the pixels of a tile in y and x: about square, or long where the coin stays the same.

    Only tosses of one coin on one floor are made together, so a tile extends along an axis of the release
    where the other axis is none.
    """
    ny, nx = sweep.shape
    most = TILE_TOSSES[sweep.engine]
    if sweep.scenario.air.exponent > 0 or "air.exponent" in (sweep.x.field, sweep.y.field):
        most = min(most, SLOW_TILE_TOSSES)
    if sweep.margin is not None:
        most //= MARGIN_TOSSES
    most = max(most, ny * nx // MOST_TILES, 1)
    x_of_release, y_of_release = sweep.x.is_of_release, sweep.y.is_of_release
    if x_of_release and not y_of_release:
        columns = min(nx, most)
    elif y_of_release and not x_of_release:
        columns = min(nx, max(1, most // ny))
    else:
        columns = min(nx, max(math.isqrt(most), most // ny))
    return min(ny, most // columns), columns


def cut(tile: Tile, pixels: int, *, along_x: bool) -> tuple[Tile, list[Tile]]:
    """Return the first part of a tile, of at most so many pixels, and the parts that are left.

    Args:
        tile: what to cut.
        pixels: from 1 on.
        along_x: whether pixels of one row are kept together; else those of one column.
    """
    if not along_x:
        first, left = cut(Tile(*tile[::-1]), pixels, along_x=True)
        return Tile(*first[::-1]), [Tile(*part[::-1]) for part in left]
    (top, bottom, _), (start, stop, _) = (part.indices(part.stop) for part in tile)
    whole_rows = min(pixels // (stop - start), bottom - top)
    if whole_rows:
        end, first, left = top + whole_rows, Tile(slice(top, top + whole_rows), tile.columns), []
    else:
        end, middle, row = top + 1, start + pixels, slice(top, top + 1)
        first, left = Tile(row, slice(start, middle)), [Tile(row, slice(middle, stop))]
    return first, left + ([Tile(slice(end, bottom), tile.columns)] if end < bottom else [])


def gaps(tile: Tile, tossed: NDArray[np.bool_]) -> list[Tile]:
    """Return the parts of a tile that hold all pixels that are not tossed, and few others.

    Args:
        tile: of a map.
        tossed: whether each pixel is, (y, x).
    """
    found, top = [], tile.rows.start
    for run, rows in groupby(map(_missing, tossed)):
        bottom = top + len(list(rows))
        if run is not None:
            columns = slice(tile.columns.start + run[0], tile.columns.start + run[1])
            found.append(Tile(slice(top, bottom), columns))
        top = bottom
    return found


def _missing(row: NDArray[np.bool_]) -> tuple[int, int] | None:
    """Return the first and the end of those that are false; None where none is."""
    where = np.flatnonzero(~row)
    return (int(where[0]), int(where[-1]) + 1) if len(where) else None


def tiles(shape: tuple[int, int], tile: tuple[int, int]) -> Iterator[Tile]:
    """Cut a map into tiles, row by row; those at the far ends may be smaller.

    Args:
        shape: of the map, pixels in y and x.
        tile: of a tile, likewise.
    """
    (ny, nx), (rows, columns) = shape, tile
    for top in range(0, ny, rows):
        for left in range(0, nx, columns):
            yield Tile(slice(top, min(top + rows, ny)), slice(left, min(left + columns, nx)))
