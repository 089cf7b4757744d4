"""A sweep, and the tiles that it is tossed in."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from compare.engines import Engine, EngineSettings
from compare.sweep.axes import Axis
from compare.sweep.errors import SweepError
from models.scenario import Scenario
from models.title import title_of_toss

TILE_TOSSES = {Engine.ANALYTIC: 1 << 14, Engine.MUJOCO: 1 << 10}
"""Most tosses in a tile: seconds of work, so that little is lost with one and many workers have some."""
SLOW_TILE_TOSSES = 1 << 6
"""Where the air is not linear, each toss is thousands of times slower."""
MARGIN_TOSSES = 64
"""Tosses that the margin of a pixel takes, about."""


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
    """Name of the quantity of the release, one of `QUANTITIES`, along which each pixel has its margin."""
    name: str = ""
    """What its scenario is called; empty for one without a name."""

    def __post_init__(self) -> None:
        """Check that the axes and `after` go together.

        Raises:
            SweepError: naming the field.
        """
        fields = {self.x.field, self.y.field}
        if len(fields) == 1:
            raise SweepError(f"{self.x.field}: on both axes; accepted: two fields")
        if self.after is not None and "ending.max_impacts" in fields:
            raise SweepError("ending.max_impacts: accepted as an axis only without a number of impacts")

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
    x_of_release, y_of_release = sweep.x.is_of_release, sweep.y.is_of_release
    if x_of_release and not y_of_release:
        columns = min(nx, most)
    elif y_of_release and not x_of_release:
        columns = min(nx, max(1, most // ny))
    else:
        columns = min(nx, max(math.isqrt(most), most // ny))
    return min(ny, most // columns), columns


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
