"""A map on disk: read as far as it is tossed, or written from memory."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import BackEndError, require_mujoco
from cointoss.compare.sweep.axes import NUMBERS
from cointoss.compare.sweep.chunks import FORMAT, DamagedError
from cointoss.compare.sweep.errors import MapError, SweepError, is_whole
from cointoss.compare.sweep.layout import layout_of, map_layers
from cointoss.compare.sweep.maps import asked_of, layers_in, map_of, name_of, thinned
from cointoss.compare.sweep.store import Store, opened, require_place
from cointoss.compare.sweep.words import in_words
from cointoss.models.errors import ScenarioError, shown

if TYPE_CHECKING:
    import xarray as xr

MOST_READ = 50_000_000
"""The most pixels of a map that is read."""
MOST_NAME = 255
"""The most characters of a scenario's name, as of a file's, and of what is said of a store that is no map."""
MOST_TILES = 1_000_000
"""The most tiles of a map that is read."""
_ATTRIBUTES = {
    "cointoss_map": int,
    "scenario": str,
    "engine": str,
    "engine_settings": dict,
    "after": int | None,
    "versions": dict,
}
_ACCEPTED = "accepted: a map that cointoss basin made"


def read_map(path: str | Path, *, most: int = MOST_READ) -> "xr.Dataset":
    """Return a map that `cointoss basin` made, as `cointoss.basin` does, as far as it is tossed and whole.

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
        store = Store.at(path, "r")
        _require_map(store.attributes)
        _require_size(path, store)
        return in_words(thinned(map_in(store), most))
    except (MapError, BackEndError):
        raise
    except ScenarioError as error:
        raise ScenarioError(f"{path}: {error}") from None
    except Exception as error:  # zarr raises errors of any kind
        raise MapError(f"{path}: is no map of cointoss ({_line(error)}); {_ACCEPTED}") from None


def _require_map(attributes: Mapping[str, Any]) -> None:
    """Refuse the attributes of a store that is no map of this format, or of an engine that is not there."""
    for name, kind in _ATTRIBUTES.items():
        if not isinstance(attributes.get(name), kind):
            raise DamagedError(
                f"attribute {name} = {shown(attributes.get(name))}"
                + (
                    ": a store of tosses, of which xarray.open_zarr(NAME).cointoss.save makes a map"
                    if "cointoss_tosses" in attributes
                    else ""
                )
            )
    if attributes["cointoss_map"] != FORMAT:
        raise DamagedError(f"attribute cointoss_map = {attributes['cointoss_map']}, not {FORMAT}")
    name = attributes.get("name", "")
    if not (isinstance(name, str) and len(name) <= MOST_NAME):
        raise DamagedError(f"name = {shown(name)}")
    require_mujoco(Engine(attributes["engine"]))


def _require_size(path: Path, store: Store) -> None:
    (ny, nx), tile = store.shape, store.arrays["outcome"].chunks
    count = -(-ny // tile[0]) * -(-nx // tile[1])
    if ny * nx > MOST_READ:
        raise MapError(f"{path}: has {nx} by {ny} pixels; accepted: a map of at most {MOST_READ:g} pixels")
    if count > MOST_TILES:
        few = f"accepted: a map of at most {MOST_TILES:g} tiles"
        raise MapError(f"{path}: has tiles of {tile[1]} by {tile[0]} pixels; {few}")


def map_in(store: Store) -> "xr.Dataset":
    """Return the map in a store, its words as codes, as far as its tiles are tossed and whole."""
    import xarray

    given = {
        name: (array.metadata.dimension_names, np.broadcast_to(0, array.shape))
        for name, array in store.arrays.items()
    }
    axes = {name: (given[name][0], store.whole(name)) for name in given if name in NUMBERS}
    layers = {name: given[name] for name in store.layers}
    batch, how = asked_of(xarray.Dataset(layers, axes, store.attributes))
    arrays = {name: np.full(batch.shape, one.missing, one.kind) for name, one in map_layers(how).items()}
    if lacking := arrays.keys() - layers.keys():
        raise DamagedError(f"array {min(lacking)} missing")
    for tile in store.tiles:
        try:
            if not (tossed := store.tossed(tile)).any():
                continue
            for name, array in arrays.items():
                np.copyto(array[tile], store.read(tile, name), where=tossed)
        except DamagedError as error:
            raise MapError(
                f"{store.path}: a file is damaged ({_line(error)}); accepted: a whole map "
                "(cointoss basin --resume tosses again what is damaged)"
            ) from None
    return map_of(batch, how, arrays, store.attributes.get("name", ""))


def save_map(dataset: "xr.Dataset", path: Path, *, overwrite: bool) -> None:
    """Write a map from memory into a store; see `cointoss.compare.accessor.Tosses.save`."""
    (batch, how), name = asked_of(dataset), dataset.attrs.get("name", "")
    if (stride := dataset.attrs.get("stride", 1)) > 1:
        raise SweepError(f"{name_of(dataset)}: one pixel of every {stride} is here; accepted: a whole map")
    require_place(path, resume=False, overwrite=overwrite)
    layers = {layer: array.ravel() for layer, array in layers_in(dataset).items()}
    with opened(path, layout_of(batch, how, name=name), overwrite=overwrite) as kept:
        for part in map(kept.missing, kept.tiles):
            kept.write(part, {layer: array[part] for layer, array in layers.items()})


def _line(error: Exception) -> str:
    """Return the beginning of what an error says, in one line."""
    return " ".join(str(error).split())[:MOST_NAME]
