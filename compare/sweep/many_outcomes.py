"""The outcomes of more tosses than memory holds, chunk by chunk into a Zarr store."""

from collections.abc import Iterable
from dataclasses import Field, fields
from importlib.metadata import version
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from zarr.codecs import ZstdCodec

from cointoss.compare.engines import Engine
from cointoss.compare.output.files import UnwritableError, naming
from cointoss.compare.sweep.store import consolidate
from cointoss.models.errors import require_type
from cointoss.models.outcomes import Outcomes
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import UnsupportedError
from cointoss.models.releases import Releases, changed_releases
from cointoss.models.stages import stage

FORMAT = 1
"""Of a store, under the attribute `cointoss_tosses`."""
STORED = 1 << 18
"""Tosses in a file of an array."""


def toss_to_zarr(
    path: str | PathLike[str],
    scenario: ScenarioSource,
    chunks: Iterable[Releases],
    *,
    engine: Engine | str = "analytic",
    progress: bool | None = None,
    **asked: Any,
) -> int:
    """Toss coins chunk by chunk, and keep how they ended in a Zarr store that `xarray.open_zarr` reads.

        hand, rng = cointoss.Hand(), np.random.default_rng(0)
        chunks = (hand.releases(coin.body, rng, 1_000_000) for _ in range(100))
        cointoss.toss_to_zarr("tosses.zarr", coin, chunks)

    No more than one chunk is in memory at a time. Where Ctrl-C or an error ends it, the store has the chunks
    that were finished. Without any chunk it is a store of no tosses.

    Args:
        path: of the store, which ends in .zarr and must not exist.
        scenario: what to toss; or a file's path, or a name.
        chunks: releases, such as of a generator; each chunk is made when the one before is stored.
        engine: "analytic" or "mujoco".
        progress: whether how far it is is shown, as by `toss_many`.
        asked: of `toss_many`: `settings`, and of the analytic engine `horizon` and `certain`.

    Returns:
        The number of tosses.

    Raises:
        OSError: for a path that can't be written or exists.
        TypeError: for what are no chunks, or one that is no `Releases`.
        UnsupportedError: for a law of one's own.
    """
    place, described, tosses = Path(path), scenario_of(scenario), 0
    _require_new(place)
    require_type("chunks", chunks, Iterable, "Releases, one after the other, as in [releases]")
    if asked.get("law") is not None:
        raise UnsupportedError("law: given, accepted: none in a store, whose scenario would not name it")
    package: Any = Engine(engine).package
    about = {
        "cointoss_tosses": FORMAT,
        "scenario": described.to_toml(),
        "engine": str(engine),
        "engine_settings": asked.get("settings", package.MANY).as_dict(),
        "versions": {**Engine(engine).versions, "zarr": version("zarr")},
    }
    with stage("tossing into a store", "tosses", shown=progress) as tell, naming(place):
        store = None
        for chunk in chunks:
            require_type("chunks", chunk, Releases, "Releases, one after the other")
            outcomes = package.toss_many(described, chunk, **asked)
            store = _append(store or _created(place, outcomes, about), outcomes, tosses)
            tosses += len(chunk)
            tell(tosses, tosses)
        if store is None:
            none = changed_releases(described.release, 0, {})
            _created(place, package.toss_many(described, none, **asked), about)
    return tosses


def _created(place: Path, outcomes: Outcomes, about: dict[str, Any]) -> zarr.Group:
    """Return a new store for what these outcomes have, without tosses."""
    store = zarr.create_group(place, zarr_format=3, attributes=about)
    for item in _kept(outcomes):
        store.create_array(
            item.name,
            shape=(0,),
            chunks=(STORED,),
            dtype=item.metadata["kind"],
            fill_value=item.metadata["kind"](0),
            dimension_names=("toss",),
            compressors=ZstdCodec(checksum=True),
            attributes=item.metadata["attributes"],
        )
    consolidate(store)
    return store


def _append(store: zarr.Group, outcomes: Outcomes, first: int) -> zarr.Group:
    """Write outcomes behind the first ones; what describes the store last, so that it has them whole."""
    for item in _kept(outcomes):
        array: Any = store[item.name]
        array.resize((first + len(outcomes),))
        array[first:] = np.asarray(getattr(outcomes, item.name))
    consolidate(store)
    return store


def _kept(outcomes: Outcomes) -> list[Field[Any]]:
    return [item for item in fields(Outcomes) if getattr(outcomes, item.name) is not None]


def _require_new(place: Path) -> None:
    if place.suffix != ".zarr":
        raise UnwritableError(f"{place}: another kind of name; accepted: one that ends in .zarr")
    if place.exists():
        raise UnwritableError(f"{place}: exists; accepted: a new name")
    if not place.parent.is_dir():
        raise UnwritableError(f"{place}: no folder {place.parent}; accepted: a name in a folder that exists")
