"""The layout of a store: its dimensions, arrays and coordinates, and what made it."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.chunks import FORMAT, TOSSES_FORMAT
from cointoss.compare.sweep.grid import MARGIN_TOSSES, Sweep, tile_shape
from cointoss.compare.sweep.layers import layers_of
from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import COLUMNS, AnswerColumn

MARGIN_ALONG = "margin_along"
"""Attribute of a map with margins: their quantity."""
TRUST = "trust"
"""Attribute of a map that says which of its pixels can be trusted: true."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """What a store is made of: a batch, with its dimensions and coordinates, arrays, and what made them."""

    batch: Batch
    tile: tuple[int, ...]
    """The lengths of a tile along the dimensions; a tile is one file of each array."""
    layers: dict[str, AnswerColumn]
    attributes: dict[str, Any]


def layout_of_map(sweep: Sweep, scenario_text: str) -> Layout:
    """Return what a sweep's map is made of.

    Args:
        sweep: of the map.
        scenario_text: the scenario's TOML.
    """
    return Layout(
        batch=sweep.batch,
        tile=tile_shape(sweep.engine, sweep.batch, 1 if sweep.margin is None else MARGIN_TOSSES),
        layers=layers_of(sweep),
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
    return Layout(
        batch=batch,
        tile=tile_shape(how.engine, batch),
        layers={name: COLUMNS[name] for name in how.names},
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
