"""Read a map from disk: what it is of, and the pixels that are tossed."""

from dataclasses import fields, replace
from numbers import Integral
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray

from compare.engines import Engine, EngineSettings
from compare.film.back_end import BackEndError, require_mujoco
from compare.sweep.axes import Axis
from compare.sweep.errors import MapError, SweepError
from compare.sweep.grid import Sweep
from compare.sweep.layers import NOT_TOSSED, layers_of
from compare.sweep.outcome_map import OutcomeMap
from compare.sweep.store import FORMAT, Map
from models.errors import ScenarioError, shown
from models.fields import UNITS, lambda_unit
from models.reading import parse

MOST_READ = 100_000_000
"""Pixels of a map that is read."""
_ACCEPTED = "accepted: a map that cointoss basin made"


def read_map(path: str | Path, *, most: int = MOST_READ) -> OutcomeMap:
    """Return a map that `cointoss basin` made, as far as its tiles are tossed and whole.

    Args:
        path: of the map's folder.
        most: pixels that are kept; of a larger map every second, third, ... along both axes.

    Raises:
        MapError: naming the path and why this is no map that can be shown.
        ScenarioError: for a scenario that this version does not accept.
        BackEndError: for MuJoCo's map, where MuJoCo can't be used.
        SweepError: for `most`.
    """
    if not (is_whole(most) and most >= 1):
        raise SweepError(f"most = {most!r}; accepted: a whole number from 1")
    path = Path(path)
    if not path.is_dir():
        raise MapError(f"{path}: no such folder; {_ACCEPTED}")
    try:
        group = zarr.open_group(path, mode="r", use_consolidated=False)
        attributes: dict[str, Any] = dict(group.attrs)
    except Exception as error:  # zarr raises errors of any kind
        raise MapError(f"{path}: can't be read as a map ({type(error).__name__}); {_ACCEPTED}") from None
    if attributes.get("cointoss_map") != FORMAT:
        raise MapError(f"{path}: is no map of this version of cointoss; {_ACCEPTED}")
    try:
        sweep = _sweep(path, group, attributes)
        layers: dict[str, Any] = {name: group[name] for name in layers_of(sweep)}
        if any(layer.shape != sweep.shape for layer in layers.values()):
            raise ValueError("arrays whose shapes are not that of the axes")
    except (ScenarioError, BackEndError):
        raise
    except Exception as error:
        raise MapError(f"{path}: is a damaged map ({type(error).__name__}: {error}); {_ACCEPTED}") from None
    ny, nx = sweep.shape
    if ny * nx > MOST_READ:
        few = f"accepted: a map of at most {MOST_READ:g} pixels"
        raise MapError(f"{path}: has {nx} by {ny} pixels; {few}")
    stride = 1
    while -(-ny // stride) * -(-nx // stride) > most:
        stride += 1
    return OutcomeMap(
        name=path.name,
        sweep=sweep,
        stride=stride,
        **_read(Map(path=path, group=group), tuple(layers), stride, sweep.shape),
    )


def is_whole(number: object) -> bool:
    """Return whether a number is whole, and none that stands for a truth."""
    return isinstance(number, Integral) and not isinstance(number, bool)


def _sweep(path: Path, group: zarr.Group, attributes: dict[str, Any]) -> Sweep:
    scenario = parse(attributes["scenario"], str(path))
    engine = Engine(attributes["engine"])
    if engine == Engine.MUJOCO:
        require_mujoco()
    axes: dict[str, Axis] = {}
    for name, array in group.arrays():
        if name in UNITS:
            is_lambda = name in ("air.normal", "air.tangential")
            values: Any = array[:]
            metadata: Any = array.metadata
            (dimension,) = metadata.dimension_names
            axes[dimension] = Axis(
                field=name,
                unit=lambda_unit(scenario.air.exponent) if is_lambda else UNITS[name],
                start=float(values[0]),
                stop=float(values[-1]),
                count=len(values),
            )
            if not np.array_equal(axes[dimension].values, values):
                raise ValueError(f"values of {name} that are not evenly spaced")
    after = attributes["after"]
    if not (after is None or (is_whole(after) and after >= 0)):
        raise ValueError(f"after = {shown(after)}")
    return Sweep(
        scenario=scenario,
        engine=engine,
        x=axes["x"],
        y=axes["y"],
        settings=_settings(engine, attributes["engine_settings"]),
        after=after,
        margin=attributes.get("margin_along"),
    )


def _settings(engine: Engine, found: dict[str, Any]) -> EngineSettings:
    """Return the settings with which a map was tossed, but for those that are compiled in."""
    settings: Any = engine.package.MANY
    chosen = {item.name for item in fields(settings) if item.init}
    return replace(settings, **{name: value for name, value in found.items() if name in chosen})


def _read(map_: Map, names: tuple[str, ...], stride: int, shape: tuple[int, int]) -> dict[str, NDArray[Any]]:
    ny, nx = (-(-count // stride) for count in shape)
    fills = {"outcome": NOT_TOSSED, "impacts": NOT_TOSSED, "margin": np.nan}
    kinds = {"outcome": np.int8, "impacts": np.int32, "margin": np.float64}
    arrays = {name: np.full((ny, nx), fills[name], kinds[name]) for name in names}
    for tile in map_.tiles:
        tossed = map_.tossed(tile)
        if not tossed.any():
            continue
        kept = tuple(slice(-(-part.start // stride), -(-part.stop // stride)) for part in tile)
        first = tuple(slice(-part.start % stride, None, stride) for part in tile)
        for name, array in arrays.items():
            array[kept] = np.where(tossed, map_.read(tile, name), fills[name])[first]
    return arrays
