"""A map in memory: what it is of, and its arrays, as a dataset and back."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.basins.maps import outcome_codes
from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.sweep.axes import NUMBERS, Axis, unit_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import (
    LAYERS,
    NOT_TOSSED,
    REFUSED,
    layers_of,
    trust_layer,
)
from cointoss.compare.sweep.pieces import Columns
from cointoss.compare.sweep.untrusted import untrusted_pixels
from cointoss.models.reading import parse
from cointoss.models.records import Array

if TYPE_CHECKING:
    import xarray as xr

MOST_STEPS = 1_000_000_000
"""The most steps of an engine in the settings of a map."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TossedMap:
    """The outcomes of tosses over two fields of a scenario."""

    sweep: Sweep
    """The scenario, the axes, the engine with its settings, and which face or outcome is shown."""
    layers: Columns
    """The arrays by name, (ny, nx) each; `outcome` is -1 where no toss was made yet."""
    name: str
    stride: int = 1
    """Every n-th pixel of the sweep is here, along both axes."""

    def __post_init__(self) -> None:
        """Refuse outcomes that are none."""
        tossed = self.outcome[self.outcome != NOT_TOSSED]
        if tossed.size:
            outcome_codes(tossed)

    @property
    def outcome(self) -> NDArray[np.int8]:
        """`Outcome`, or -1 where no toss was made yet, (ny, nx)."""
        return self.layers["outcome"]

    @cached_property
    def untrusted(self) -> NDArray[np.bool_] | None:
        """The pixels that the engine's own errors may have decided, (ny, nx); None where unknown."""
        after = self.sweep.after
        return untrusted_pixels(after, self.layers[trust_layer(after)]) if self.sweep.trust else None

    def thinned(self, most: int) -> "TossedMap":
        """Return every second, third, ... pixel along both axes, so that there are at most `most`."""
        step = stride_of(self.outcome.shape, most)
        layers = {name: layer[::step, ::step] for name, layer in self.layers.items()}
        return replace(self, layers=layers, stride=step * self.stride)

    def dataset(self) -> "xr.Dataset":
        """Return the map as a dataset of xarray, with its outcomes in words."""
        import xarray

        from cointoss.compare.sweep.accessor import in_words

        sweep, layers = self.sweep, layers_of(self.sweep)
        coordinates = {
            field: one._replace(values=one.values[:: self.stride])
            for field, one in sweep.batch.coordinates.items()
        }
        arrays = {name: (("y", "x"), array, layers[name].attributes) for name, array in self.layers.items()}
        about = {
            "name": sweep.name,
            "scenario": sweep.scenario.to_toml(),
            "engine": sweep.engine.value,
            "engine_settings": json.dumps(sweep.settings.as_dict()),
            "after": "" if sweep.after is None else sweep.after,
            "margin_along": sweep.margin or "",
            "trust": sweep.how.trust or "",
            "stride": self.stride,
            "axes": json.dumps([[axis.start, axis.stop, axis.count] for axis in (sweep.y, sweep.x)]),
        }
        return in_words(xarray.Dataset(arrays, coordinates, about))


def stride_of(shape: tuple[int, ...], most: int) -> int:
    """Return the least n for which every n-th pixel along both axes makes at most `most` pixels."""
    return next(n for n in count(1) if math.prod(-(-side // n) for side in shape) <= most)


def map_of(dataset: "xr.Dataset") -> TossedMap:
    """Return a dataset of tosses over two fields as a map.

    Raises:
        SweepError: for another dataset.
    """
    from cointoss.compare.sweep.accessor import in_codes

    coded, about = in_codes(dataset), dataset.attrs
    dims = coded["outcome"].dims if "outcome" in coded else ()
    names = [field_along(coded, str(dim)) for dim in dims]
    if len(dims) != 2 or not all(names) or "scenario" not in about:
        raise SweepError(
            "dataset: accepted: one of tosses over two fields of a scenario, as of cointoss.basin"
        )
    if law := about.get("law"):
        raise SweepError(
            f"dataset: by the law {law} of one's own, accepted: the scenario's, which a map names"
        )
    scenario = parse(about["scenario"], "attribute scenario")
    engine, stride = Engine(about["engine"]), int(about.get("stride", 1))
    whole = json.loads(about["axes"]) if stride > 1 else [None, None]
    y, x = (
        _axis(name, coded[name].values, unit_of(name, scenario), ends, stride)
        for name, ends in zip(names, whole, strict=True)
    )
    after, settings = about.get("after"), about["engine_settings"]
    after = None if after in (None, "") else int(after)
    # A store has them as they are; a dataset in memory as JSON, which any file takes.
    settings = json.loads(settings) if isinstance(settings, str) else settings
    sweep = Sweep(
        scenario=scenario,
        engine=engine,
        x=x,
        y=y,
        settings=settings_of(engine, settings),
        after=after,
        margin=about.get("margin_along") or None,
        trust=trust_layer(after) in coded,
        name=str(about.get("name", "")),
    )
    kept = layers_of(sweep)
    layers = {name: coded[name].values.astype(LAYERS[name].kind) for name in kept if name in coded}
    layers["outcome"][layers["outcome"] == REFUSED] = NOT_TOSSED
    return TossedMap(sweep=sweep, layers=layers, name=sweep.name or "map", stride=stride)


def field_along(dataset: "xr.Dataset", dim: str) -> str:
    """Return the numeric field that varies along a dimension, empty where none or several do."""
    found = [str(name) for name, one in dataset.coords.items() if one.dims == (dim,) and name in NUMBERS]
    return found[0] if len(found) == 1 else ""


def _axis(field: str, values: Array, unit: str, ends: list[float] | None, stride: int) -> Axis:
    if len(values) < 2:
        raise SweepError(f"{field}: one value, accepted: a map of two or more")
    start, stop, count = ends or (float(values[0]), float(values[-1]), len(values))
    axis = Axis(field=field, unit=unit, start=start, stop=stop, count=int(count))
    there = axis.values[::stride]
    if there.shape != values.shape or not np.allclose(there, values, rtol=1e-12):
        raise SweepError(f"{field}: values that are not evenly spaced, accepted: those of a whole range")
    return axis


def settings_of(engine: Engine, found: Mapping[str, Any]) -> EngineSettings:
    """Return the settings with which a map was tossed, but for those that are compiled in.

    Raises:
        ValueError: for more steps than anybody waits for.
    """
    settings: Any = engine.package.MANY
    chosen = {item.name for item in fields(settings) if item.init}
    given = {name: value for name, value in found.items() if name in chosen}
    for name, value in given.items():
        if isinstance(value, int) and value > MOST_STEPS:
            raise ValueError(f"{name} = {value}")
    return replace(settings, **given)
