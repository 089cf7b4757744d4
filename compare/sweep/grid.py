"""A sweep, and the tiles that it is tossed in."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.batch import Batch, Varied
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import Trust
from cointoss.models.devices import Device
from cointoss.models.processor import Processor
from cointoss.models.scenario import Scenario
from cointoss.models.title import title_of_toss

if TYPE_CHECKING:
    from cointoss.compare.metrics.margin import ReleaseQuantity

TILE_TOSSES = {Engine.ANALYTIC: 1 << 14, Engine.MUJOCO: 1 << 10}
"""The most tosses in a tile, which is a file: seconds of work, so that each of many workers has some."""
SLOW_TILE_TOSSES = 1 << 6
"""The most tosses in a tile where the air is not linear: each toss is thousands of times slower."""
MARGIN_TOSSES = 64
"""About how many tosses the margin of a pixel takes."""
MOST_TILES = 1 << 13
"""About the most tiles in a map; a large map has larger tiles."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """What a map is made of: a scenario, two of whose fields vary, tossed by one engine."""

    scenario: Scenario
    engine: Engine
    x: Axis
    y: Axis
    settings: EngineSettings
    """The settings of the engine."""
    after: int | None = None
    """The map shows the face at the touch after this number of impacts; None for the final outcome."""
    margin: str | None = None
    """Name of the quantity of the release along which each pixel has its margin; with its axis in Greek."""
    trust: bool = False
    """Whether to find which pixels can be trusted."""
    device: Device = Device.CPU
    """What tosses."""
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
    def quantity(self) -> "ReleaseQuantity":
        """The quantity along which each pixel has its margin, of a sweep with margins."""
        from cointoss.compare.metrics.margin import quantity_of

        try:
            return quantity_of(self.margin or "")
        except ValueError as error:
            raise SweepError(f"margin {self.margin}: accepted: {error}") from None

    @property
    def title(self) -> str:
        """Which coin is tossed, in a few words, but for what varies."""
        return title_of_toss(self.scenario, self.name, varied=(self.x.field, self.y.field))

    @cached_property
    def batch(self) -> Batch:
        """The tosses of its pixels, row by row, each up to the touch that is shown."""
        scenario = self.scenario
        if self.after is not None:
            most = scenario.ending.max_impacts
            stop = self.after + 1 if most is None else min(self.after + 1, most)
            scenario = scenario.replace("ending.max_impacts", stop)
        varied = (
            Varied(field=axis.field, dims=(dim,), values=axis.values)
            for dim, axis in (("y", self.y), ("x", self.x))
        )
        return Batch(scenario=scenario, varied=tuple(varied), sizes={"y": self.y.count, "x": self.x.count})

    @cached_property
    def how(self) -> How:
        """How its pixels are tossed."""
        trust: Trust | None = ("certain" if self.after is None else "impacts") if self.trust else None
        return How(engine=self.engine, settings=self.settings, trust=trust, processor=Processor(self.device))

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels in y and x."""
        return self.y.count, self.x.count


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
