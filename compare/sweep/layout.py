"""The layout of a store: its dimensions, arrays and coordinates, and what made it."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, NamedTuple

from numpy.typing import NDArray

from cointoss.compare.sweep.batch import Batch, attributes_of
from cointoss.compare.sweep.chunks import FORMAT, TOSSES_FORMAT
from cointoss.compare.sweep.grid import MOST_TILES, Sweep, tile_shape, tosses_in_tile
from cointoss.compare.sweep.layers import axis_attributes, layers_of
from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import COLUMNS, AnswerColumn

MARGIN_ALONG = "margin_along"
"""Attribute of a map with margins: their quantity."""
TRUST = "trust"
"""Attribute of a map that says which of its pixels can be trusted: true."""


class Coordinate(NamedTuple):
    """The values of a field that varies, along dimensions of a store."""

    dims: tuple[str, ...]
    values: NDArray[Any]
    attributes: dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class Layout:
    """What a store is made of: its dimensions, arrays and coordinates, and what made it."""

    sizes: dict[str, int]
    """The lengths of the dimensions, the last varying fastest."""
    tile: tuple[int, ...]
    """The lengths of a tile along the dimensions; a tile is one file of each array."""
    layers: dict[str, AnswerColumn]
    coordinates: dict[str, Coordinate]
    """The coordinates by field."""
    attributes: dict[str, Any]


def layout_of_map(sweep: Sweep, scenario_text: str) -> Layout:
    """Return what a sweep's map is made of.

    Args:
        sweep: of the map.
        scenario_text: the scenario's TOML.
    """
    return Layout(
        sizes=sweep.batch.sizes,
        tile=tile_shape(sweep),
        layers=layers_of(sweep),
        coordinates={
            axis.field: Coordinate((dim,), axis.values, axis_attributes(axis))
            for axis, dim in ((sweep.y, "y"), (sweep.x, "x"))
        },
        attributes={
            "cointoss_map": FORMAT,
            "name": sweep.name,
            "scenario": scenario_text,
            "engine": sweep.engine.value,
            "engine_settings": sweep.settings.as_dict(),
            "after": sweep.after,
            **({} if sweep.margin is None else {MARGIN_ALONG: sweep.margin}),
            **({TRUST: True} if sweep.trust else {}),
            "versions": {**sweep.engine.versions, "zarr": version("zarr")},
        },
    )


def layout_of_tosses(batch: Batch, how: How) -> Layout:
    """Return what a store of a batch's tosses is made of."""
    most = max(tosses_in_tile(how.engine, batch), len(batch) // MOST_TILES)
    return Layout(
        sizes=batch.sizes,
        tile=_tile_of(batch.shape, most),
        layers={name: COLUMNS[name] for name in how.names},
        coordinates={
            one.field: Coordinate(one.dims, one.values, attributes_of(one, batch.scenario))
            for one in batch.varied
        },
        attributes={
            "cointoss_tosses": TOSSES_FORMAT,
            "scenario": batch.scenario.to_toml(),
            "engine": how.engine.value,
            "engine_settings": how.settings.as_dict(),
            "after": None,
            "errors": "keep" if how.keeps else "raise",
            "trust": how.trust,
            "versions": {**how.engine.versions, "zarr": version("zarr")},
        },
    )


def _tile_of(shape: tuple[int, ...], most: int) -> tuple[int, ...]:
    """Return the lengths of a tile of at most n tosses, as long as it can be along the last dimensions."""
    lengths: list[int] = []
    for size in reversed(shape):
        lengths.append(max(1, min(size, most)))
        most //= lengths[-1]
    return tuple(reversed(lengths))
