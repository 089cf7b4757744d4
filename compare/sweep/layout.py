"""The layout of a store: its dimensions, arrays, tiles and coordinates, and what made it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib.metadata import version
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import COLUMNS, NOT_TOSSED, REFUSED, AnswerColumn
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Outcome

FORMAT = 1
"""The version of the form of a map, under the attribute `cointoss_map`."""
TOSSES_FORMAT = 2
"""The version of the form of a store of tosses, under the attribute `cointoss_tosses`; version 1 had bools
for certainties."""
MARGIN_ALONG = "margin_along"
"""Attribute of a map with margins: their quantity."""
TRUST = "trust"
"""Attribute that says what is known of trust: true for a map where it is."""
TILE_TOSSES = {Engine.ANALYTIC: 1 << 14, Engine.MUJOCO: 1 << 10}
"""The most tosses in a tile, which is a file: seconds of work, so that each of many workers has some."""
SLOW_TILE_TOSSES = 1 << 6
"""The most tosses in a tile where the air is not linear: each toss is thousands of times slower."""
MARGIN_TOSSES = 64
"""About how many tosses the margin of a pixel takes."""
MOST_TILES = 1 << 13
"""About the most tiles in a store; a large one has larger tiles."""
LAYERS = {**COLUMNS, "margin": AnswerColumn(kind=np.float64, attributes={}, missing=np.nan)}
"""All arrays that there may be; what the attributes of a map's say depends on what is asked for."""


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


def map_layers(how: How) -> dict[str, AnswerColumn]:
    """Return the arrays of a map that is tossed so, by name."""
    attributes = {
        "outcome": {
            "long_name": "outcome",
            **meanings_of({NOT_TOSSED: "not_tossed", **Outcome.by_value()}),
        },
        "impacts": {"long_name": "number of impacts"},
    }
    if how.margin is not None:
        found = f"smallest change of the release's {how.margin} that was found to change the outcome"
        about = f"{found}; infinite: none up to 1 SI unit"
        attributes["margin"] = {"long_name": about, "units": how.quantity.unit}
    if how.trust and how.after is not None:
        about = f"number of leading impacts up to touch {how.after + 1} that the engine's own errors cannot"
        attributes["trusted_impacts"] = {"long_name": f"{about} have changed"}
    elif how.trust:
        attributes["outcome_certain"] = {
            "long_name": "whether the engine's own errors cannot change the outcome",
            **meanings_of({NOT_TOSSED: "not_tossed", 0: "uncertain", 1: "certain"}),
        }
    return {name: replace(LAYERS[name], attributes=about) for name, about in attributes.items()}


def trust_layer(after: int | None) -> str:
    """Return the name of the array that says which pixels can be trusted, of a map with this `after`."""
    return "outcome_certain" if after is None else "trusted_impacts"


def is_untrusted(after: int | None, trust: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Return where the engine's own errors may have decided the face or the outcome, in any shape.

    The face at touch n + 1 can be trusted where n + 1 impacts can. Where the toss ended before, its outcome
    is shown, which depends on more than its impacts: there it is not trusted. A final outcome can be trusted
    where it is certain.

    Args:
        after: n of the map; None where it shows final outcomes.
        trust: its `trust_layer`; below 0 where no toss was made yet.
    """
    return (trust >= 0) & (trust <= (after or 0))


def holds_tosses(name: str, values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where an array, by its name, holds what a toss gave."""
    if name == "margin":
        return ~np.isnan(values)
    if values.dtype.kind == "f":  # NaN, too, of what is no scenario
        return np.ones(values.shape, dtype=bool)
    known = {"outcome": [*Outcome], "outcome_certain": [0, 1]}.get(name)
    return (values == REFUSED) | (values >= 0 if known is None else np.isin(values, known))


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
    for corner in product(*(range(0, size, length) for size, length in zip(shape, tile, strict=True))):
        yield tuple(
            slice(first, min(first + length, size))
            for first, length, size in zip(corner, tile, shape, strict=True)
        )


def numbers_in(part: tuple[slice, ...], shape: tuple[int, ...]) -> NDArray[np.intp]:
    """Return the numbers, in the order of a C array, of what lies in a part of a grid, over that part."""
    return np.ravel_multi_index(np.ix_(*(np.arange(one.start, one.stop) for one in part)), shape)
