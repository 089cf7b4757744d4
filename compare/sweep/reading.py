"""Read a map from disk: what it is of, and the pixels that are tossed."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import BackEndError, require_mujoco
from cointoss.compare.sweep.axes import Axis, unit_of
from cointoss.compare.sweep.errors import MapError, SweepError, is_whole
from cointoss.compare.sweep.form import MARGIN_ALONG, TRUST, FormError, MapGrid, read_form
from cointoss.compare.sweep.grid import Sweep, tiles
from cointoss.compare.sweep.layers import LAYERS, NOT_TOSSED, REFUSED, layers_of
from cointoss.compare.sweep.store import Store
from cointoss.compare.sweep.tossed_map import TossedMap, settings_of, stride_of
from cointoss.models.errors import ScenarioError, shown
from cointoss.models.reading import parse
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr

MOST_READ = 50_000_000
"""The most pixels of a map that is read."""
MOST_NAME = 255
"""The most characters of a scenario's name, as of a file's."""
MOST_TILES = 1_000_000
"""The most tiles of a map that is read."""
_ACCEPTED = "accepted: a map that cointoss basin made"


def read_map(path: str | Path, *, most: int = MOST_READ) -> "xr.Dataset":
    """Return a map that `cointoss basin` made, as far as its tiles are tossed and whole.

    The arguments and errors are those of `tossed_map_at`; what it returns is as of `cointoss.basin`.
    """
    return tossed_map_at(path, most=most).dataset()


def tossed_map_at(path: str | Path, *, most: int = MOST_READ) -> TossedMap:
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
    if str(path) == "":
        raise MapError(f"(no name): no such folder; {_ACCEPTED}")
    path = Path(path)
    if not path.is_dir():
        raise MapError(f"{path}: {'is no' if path.exists() else 'no such'} folder; {_ACCEPTED}")
    try:
        form = read_form(path, 2)
        if (grid := form.grid) is None:
            raise FormError("attribute cointoss_map missing")
        map_ = Store.at(path, "r")
        sweep = _sweep(path, form.attributes, grid, map_)
        layers = layers_of(sweep)
    except (ScenarioError, BackEndError):
        raise
    except Exception as error:  # zarr raises errors of any kind
        raise MapError(f"{path}: is no map of cointoss ({error}); {_ACCEPTED}") from None
    ny, nx = grid.shape
    if ny * nx > MOST_READ:
        few = f"accepted: a map of at most {MOST_READ:g} pixels"
        raise MapError(f"{path}: has {nx} by {ny} pixels; {few}")
    if -(-ny // grid.tile[0]) * -(-nx // grid.tile[1]) > MOST_TILES:
        few = f"accepted: a map of at most {MOST_TILES:g} tiles"
        raise MapError(f"{path}: has tiles of {grid.tile[1]} by {grid.tile[0]} pixels; {few}")
    stride = stride_of(grid.shape, most)
    return TossedMap(name=path.name, sweep=sweep, stride=stride, layers=_read(map_, grid, layers, stride))


def _sweep(path: Path, attributes: Mapping[str, Any], grid: MapGrid, map_: Store) -> Sweep:
    scenario = parse(attributes["scenario"], f"{path}: attribute scenario")
    engine = Engine(attributes["engine"])
    require_mujoco(engine)
    after = attributes["after"]
    if not (after is None or (is_whole(after) and after >= 0)):
        raise ValueError(f"after = {shown(after)}")
    name = attributes.get("name", "")
    if not (isinstance(name, str) and len(name) <= MOST_NAME):
        raise ValueError(f"name = {shown(name)}")
    return Sweep(
        scenario=scenario,
        engine=engine,
        x=_axis(grid.x, map_, scenario),
        y=_axis(grid.y, map_, scenario),
        settings=settings_of(engine, attributes["engine_settings"]),
        after=after,
        margin=attributes.get(MARGIN_ALONG),
        trust=TRUST in attributes,
        name=name,
    )


def _axis(field: str, map_: Store, scenario: Scenario) -> Axis:
    values = map_.whole(field)
    axis = Axis(
        field=field,
        unit=unit_of(field, scenario),
        start=float(values[0]),
        stop=float(values[-1]),
        count=len(values),
    )
    if not np.array_equal(axis.values, values):
        raise ValueError(f"values of {field} that are not evenly spaced")
    return axis


def _read(map_: Store, grid: MapGrid, names: Iterable[str], stride: int) -> dict[str, NDArray[Any]]:
    ny, nx = (-(-count // stride) for count in grid.shape)
    arrays = {name: np.full((ny, nx), LAYERS[name].missing, LAYERS[name].kind) for name in names}
    for tile in tiles(grid.shape, grid.tile):
        tossed = map_.tossed(tile)
        if not tossed.any():
            continue
        kept = tuple(slice(-(-part.start // stride), -(-part.stop // stride)) for part in tile)
        first = tuple(slice(-part.start % stride, None, stride) for part in tile)
        for name, array in arrays.items():
            array[kept] = np.where(tossed, map_.read(tile, name), LAYERS[name].missing)[first]
    # No map has a pixel that is no scenario.
    arrays["outcome"][arrays["outcome"] == REFUSED] = NOT_TOSSED
    return arrays
