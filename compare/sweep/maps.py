"""A map, the dataset of tosses over two fields: how it is asked for, and what a dataset is a map of."""

import json
import math
from collections.abc import Mapping
from dataclasses import fields, replace
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.basins.maps import outcome_codes
from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.sweep.axes import NUMBERS, Axis, unit_of
from cointoss.compare.sweep.batch import Batch, Varied
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.layout import is_untrusted, map_layers, trust_layer
from cointoss.compare.sweep.pieces import Columns, How
from cointoss.compare.sweep.words import codes_of, in_codes
from cointoss.models.answers import NOT_TOSSED, REFUSED
from cointoss.models.devices import Device
from cointoss.models.processor import Processor
from cointoss.models.reading import parse
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.title import title_of_toss

if TYPE_CHECKING:
    import xarray as xr

MOST_STEPS = 1_000_000_000
"""The most steps of an engine in the settings of a map."""


def asked(
    scenario: Scenario,
    x: Axis,
    y: Axis,
    *,
    engine: Engine = Engine.ANALYTIC,
    settings: EngineSettings | None = None,
    after: int | None = None,
    margin: str | None = None,
    trust: bool = False,
    device: Device = Device.CPU,
) -> tuple[Batch, How]:
    """Return the tosses of a map, row by row, and how they are tossed; the arguments are those of `basin`.

    Raises:
        SweepError: for axes that exclude each other, and for what the engine does not find.
    """
    if x.field == y.field:
        raise SweepError(f"{x.field}: on both axes; accepted: two fields")
    if after is not None and "ending.max_impacts" in (x.field, y.field):
        raise SweepError(f"ending.max_impacts: an axis beside after = {after}; accepted: one of the two")
    if trust and engine != Engine.ANALYTIC:
        raise SweepError(f"trust: by {engine}, accepted: only by the analytic engine")
    if margin is not None and engine != Engine.ANALYTIC:
        raise SweepError(f"margin: {margin!r} by {engine}, accepted: only by the analytic engine")
    how = How(
        engine=engine,
        settings=engine.package.MANY if settings is None else settings,
        trust=("certain" if after is None else "impacts") if trust else None,
        processor=Processor(device),
        after=after,
        margin=margin,
    )
    if margin is not None:
        try:
            how = replace(how, margin=how.quantity.name)
        except ValueError as error:
            raise SweepError(f"margin {margin}: accepted: {error}") from None
    varied = tuple(
        Varied(field=one.field, dims=(dim,), values=one.values) for dim, one in zip("yx", (y, x), strict=True)
    )
    return Batch(scenario=scenario, varied=varied, sizes={"y": y.count, "x": x.count}), how


def asked_of(dataset: "xr.Dataset") -> tuple[Batch, How]:
    """Return what a map is made of: its tosses, all of them where only every n-th is here, and how.

    Raises:
        SweepError: for what is no map.
    """
    y, x = axes_of(dataset)
    about = dataset.attrs
    if law := about.get("law"):
        raise SweepError(
            f"dataset: by the law {law} of one's own, accepted: the scenario's, which a map names"
        )
    engine, after, settings = Engine(about["engine"]), after_of(dataset), about["engine_settings"]
    # A store has them as they are; a dataset in memory as JSON, which any file takes.
    settings = json.loads(settings) if isinstance(settings, str) else settings
    return asked(
        parse(about["scenario"], "attribute scenario"),
        x,
        y,
        engine=engine,
        settings=settings_of(engine, settings),
        after=after,
        margin=about.get("margin_along") or None,
        trust=trust_layer(after) in dataset,
    )


def map_of(batch: Batch, how: How, arrays: Columns, name: str) -> "xr.Dataset":
    """Return a map, its words as codes.

    Args:
        batch: of all its tosses.
        how: they were tossed.
        arrays: by name, over y and x.
        name: of the scenario; empty where it has none.
    """
    import xarray

    about = {
        "name": name,
        "scenario": batch.scenario.to_toml(),
        "engine": how.engine.value,
        "engine_settings": json.dumps(how.settings.as_dict()),
        "after": "" if how.after is None else how.after,
        "margin_along": how.margin or "",
        "trust": how.trust or "",
        "stride": 1,
        "axes": json.dumps([[one.values[0], one.values[-1], len(one.values)] for one in batch.varied]),
    }
    layers = {one: (("y", "x"), arrays[one], layer.attributes) for one, layer in map_layers(how).items()}
    return xarray.Dataset(layers, batch.coordinates, about)


def as_map(dataset: "xr.Dataset") -> "xr.Dataset":
    """Return tosses over two fields as a map, along y and x and with a map's attributes; a map as it is.

    Raises:
        SweepError: for another dataset.
    """
    batch, how = asked_of(dataset)
    is_map, name = "stride" in dataset.attrs, dataset.attrs.get("name", "")
    return dataset if is_map else map_of(batch, how, layers_in(dataset), name)


def layers_in(dataset: "xr.Dataset") -> Columns:
    """Return the arrays that a map keeps on disk, by name, of a dataset in words or in codes.

    Raises:
        SweepError: for what is no map.
    """
    names, coded = map_layers(asked_of(dataset)[1]), in_codes(dataset)
    return {**{name: coded[name].values for name in names}, "outcome": outcomes_in(dataset)}


def outcomes_in(dataset: "xr.Dataset") -> NDArray[np.int8]:
    """Return the codes of a map's outcomes; -1 where no toss was made.

    Raises:
        ValueError: for a code that is none.
    """
    codes = codes_of("outcome", dataset["outcome"].values)
    codes[codes == REFUSED] = NOT_TOSSED
    if (made := codes[codes != NOT_TOSSED]).size:
        outcome_codes(made)
    return codes


def untrusted_in(dataset: "xr.Dataset") -> NDArray[np.bool_] | None:
    """Return the pixels of a map that the engine's own errors may have decided; None where unknown."""
    after = after_of(dataset)
    name = trust_layer(after)
    return is_untrusted(after, codes_of(name, dataset[name].values)) if name in dataset else None


def after_of(dataset: "xr.Dataset") -> int | None:
    """Return the number of impacts before the touch that a map shows; None for final outcomes."""
    after = dataset.attrs.get("after")
    return None if after in (None, "") else int(after)


def title_of(dataset: "xr.Dataset") -> str:
    """Return which coin a map tosses, in a few words, but for what varies."""
    about = dataset.attrs
    varied = [axis.field for axis in axes_of(dataset)]
    return title_of_toss(parse(about["scenario"], "attribute scenario"), about.get("name", ""), varied=varied)


def name_of(dataset: "xr.Dataset") -> str:
    """Return what a message calls a map."""
    return str(dataset.attrs.get("name") or "map")


def thinned(dataset: "xr.Dataset", most: int) -> "xr.Dataset":
    """Return every second, third, ... pixel of a map along both axes, so that there are at most `most`."""
    ends = [[axis.start, axis.stop, axis.count] for axis in axes_of(dataset)]
    step = stride_of(dataset["outcome"].shape, most)
    kept = dataset.isel({dim: slice(None, None, step) for dim in dataset["outcome"].dims})
    # A copy lets go of the whole.
    return kept.copy(deep=True).assign_attrs(
        stride=step * dataset.attrs.get("stride", 1), axes=json.dumps(ends)
    )


def stride_of(shape: tuple[int, ...], most: int) -> int:
    """Return the least n for which every n-th pixel along both axes makes at most `most` pixels."""
    return next(n for n in count(1) if math.prod(-(-side // n) for side in shape) <= most)


def axes_of(dataset: "xr.Dataset") -> tuple[Axis, ...]:
    """Return the axes of a map, y and x, whole where only every n-th pixel is here.

    Raises:
        SweepError: for what is no map.
    """
    about, dims = dataset.attrs, dataset["outcome"].dims if "outcome" in dataset else ()
    names = [field_along(dataset, str(dim)) for dim in dims]
    if len(dims) != 2 or not all(names) or "scenario" not in about:
        raise SweepError(
            "dataset: accepted: one of tosses over two fields of a scenario, as of cointoss.basin"
        )
    scenario, stride = parse(about["scenario"], "attribute scenario"), int(about.get("stride", 1))
    whole = json.loads(about["axes"]) if stride > 1 else [None, None]
    return tuple(
        _axis(name, dataset[name].values, unit_of(name, scenario), ends, stride)
        for name, ends in zip(names, whole, strict=True)
    )


def field_along(dataset: "xr.Dataset", dim: str) -> str:
    """Return the numeric field that varies along a dimension, empty where none or several do."""
    found = [str(name) for name, one in dataset.coords.items() if one.dims == (dim,) and name in NUMBERS]
    return found[0] if len(found) == 1 else ""


def _axis(field: str, values: Array, unit: str, ends: list[float] | None, stride: int) -> Axis:
    if len(values) < 2:
        raise SweepError(f"{field}: one value, accepted: a map of two or more")
    own = float(values[0]), float(values[-1]), len(values)  # as a slice of a thinned map has them
    for (start, stop, number), step in ((ends or own, stride), (own, 1)):
        axis = Axis(field=field, unit=unit, start=start, stop=stop, count=int(number))
        there = axis.values[::step]
        if there.shape == values.shape and np.allclose(there, values, rtol=1e-12):
            return axis
    raise SweepError(f"{field}: values that are not evenly spaced, accepted: those of a whole range")


def settings_of(engine: Engine, found: Mapping[str, Any]) -> EngineSettings:
    """Return the settings with which a map was tossed, but for those that are compiled in.

    Raises:
        ValueError: for more steps than anybody waits for.
    """
    settings: Any = engine.package.MANY
    chosen = {item.name for item in fields(settings) if item.init}
    given = {name: value for name, value in found.items() if name in chosen}
    if many := [
        f"{name} = {one}" for name, one in given.items() if isinstance(one, int) and one > MOST_STEPS
    ]:
        raise ValueError(many[0])
    return replace(settings, **given)
