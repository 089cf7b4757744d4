"""The layout of a store: its dimensions, arrays and coordinates, and what made it."""

from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.chunks import FORMAT, TOSSES_FORMAT
from cointoss.compare.sweep.layers import map_layers
from cointoss.compare.sweep.pieces import How
from cointoss.compare.sweep.tiles import MARGIN_TOSSES, tile_shape
from cointoss.models.answers import COLUMNS, AnswerColumn

MARGIN_ALONG = "margin_along"
"""Attribute of a map with margins: their quantity."""
TRUST = "trust"
"""Attribute that says what is known of trust: true for a map where it is."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """What a store is made of: a batch, with its dimensions and coordinates, arrays, and what made them."""

    batch: Batch
    how: How
    tile: tuple[int, ...]
    """The lengths of a tile along the dimensions; a tile is one file of each array."""
    layers: dict[str, AnswerColumn]
    attributes: dict[str, Any]


def layout_of(batch: Batch, how: How, *, name: str | None = None, scenario_text: str = "") -> Layout:
    """Return what a store of tosses is made of, or a map's.

    Args:
        batch: of the tosses.
        how: they are tossed.
        name: of the map's scenario; None for what is no map.
        scenario_text: the scenario's TOML as it was given, by default as it is written.
    """
    if name is None:
        head = {"cointoss_tosses": TOSSES_FORMAT, "errors": "keep" if how.keeps else "raise"}
        layers, trust = {one: COLUMNS[one] for one in how.names}, {TRUST: how.trust}
    else:
        head = {"cointoss_map": FORMAT, "name": name}
        layers, trust = map_layers(how), {TRUST: True} if how.trust else {}
    return Layout(
        batch=batch,
        how=how,
        tile=tile_shape(how.engine, batch, 1 if how.margin is None else MARGIN_TOSSES),
        layers=layers,
        attributes={
            **head,
            "scenario": scenario_text or batch.scenario.to_toml(),
            "engine": how.engine.value,
            "engine_settings": how.settings.as_dict(),
            "after": how.after,
            **({} if how.margin is None else {MARGIN_ALONG: how.margin}),
            **trust,
            "versions": {**how.engine.versions, "zarr": version("zarr")},
        },
    )
