"""The form of a map on disk: a folder not of cointoss's own form is refused before anything is decoded.

A Zarr folder names the codecs that its numbers are decoded by. A foreign one may name any, some of which run
what they decode, and sizes that fill the memory. Zarr is asked only after this module has accepted a folder.
"""

import json
import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from cointoss.compare.sweep.axes import MOST_VALUES, NUMBERS
from cointoss.compare.sweep.layers import LAYERS, trust_layer
from cointoss.models.bounded import read_bounded
from cointoss.models.errors import shown
from cointoss.models.fields import FIELDS

FORMAT = 1
"""The version of the form of a map, under the attribute `cointoss_map`."""
TOSSES_FORMAT = 2
"""The version of the form of a store of tosses, under the attribute `cointoss_tosses`; version 1 had bools
for certainties."""
_MAP, _TOSSES = "cointoss_map", "cointoss_tosses"
_FORMATS = {_MAP: FORMAT, _TOSSES: TOSSES_FORMAT}
MARGIN_ALONG = "margin_along"
"""Attribute of a map with margins: their quantity."""
TRUST = "trust"
"""Attribute of a map that says which of its pixels can be trusted: true."""
DESCRIPTION = "zarr.json"
"""Name of the file that describes a map, and of those that describe its arrays."""
MOST_DESCRIBED = 1 << 20
"""The most bytes of such a file."""
MOST_IN_TILE = 1 << 20
"""The most pixels of a tile."""
_ATTRIBUTES = {
    "scenario": str,
    "engine": str,
    "engine_settings": dict,
    "after": int | None,
    "versions": dict,
}
_DECODED = {"scale_factor", "add_offset", "_FillValue", "missing_value", "_Unsigned", "dtype"}
"""Attributes that xarray decodes numbers by; ours have none."""
_NAMES = {*LAYERS, *NUMBERS, *FIELDS}
"""What an array may be called."""


class FormError(ValueError):
    """What makes a folder no map of cointoss."""


class MapGrid(NamedTuple):
    """The grid of a map's pixels, and how it is cut into tiles."""

    x: str
    """The field of the columns."""
    y: str
    """The field of the rows."""
    shape: tuple[int, int]
    """Pixels in y and x."""
    tile: tuple[int, int]
    """Pixels of a tile in y and x."""


class StoreForm(NamedTuple):
    """What the files that describe a map or a store of tosses say."""

    attributes: dict[str, Any]
    arrays: dict[str, dict[str, Any]]
    """The description of each array, by its name."""
    grid: MapGrid | None
    """The grid of a map; None for a store of tosses."""

    def has(self, field: str, coordinate: Any) -> bool:
        """Return whether there is a coordinate of a field, of this shape and along these dimensions."""
        found, due = self.arrays.get(field, {}), (list(coordinate.values.shape), list(coordinate.dims))
        return (found.get("shape"), found.get("dimension_names")) == due


def is_map(folder: Path) -> bool:
    """Return whether a folder says that it is a map, or a store of tosses, of this format."""
    try:
        attributes = _description(folder)["attributes"]
        return any(attributes.get(kind) == number for kind, number in _FORMATS.items())
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return False


def read_form(folder: Path, dims: int) -> StoreForm:
    """Return what the descriptions of a map or a store of tosses say; nothing else of it is read.

    Args:
        folder: of one.
        dims: how many dimensions it should have.

    Raises:
        FormError: for a folder that is not as cointoss writes one.
        OSError: if a file can't be read.
    """
    _require_plain(folder, dims)
    try:
        described = _description(folder)
        attributes, arrays = _group_attributes(described), _listed(folder, described)
        return StoreForm(attributes, arrays, _grid(attributes, arrays) if _MAP in attributes else None)
    except RecursionError:
        raise FormError(f"{DESCRIPTION}: nested too deeply") from None


def require_arrays(
    form: StoreForm, sizes: Mapping[str, int], layers: Mapping[str, Any], coordinates: Mapping[str, Any]
) -> None:
    """Refuse a store whose arrays are described otherwise than those of a layout; see `store.Layout`.

    Raises:
        FormError: naming the array.
    """
    _require_layers(form.arrays, sizes, layers)
    for field, (dims, values, _) in coordinates.items():
        zero = 0 if values.dtype.kind == "i" else 0.0
        due = _array(values.dtype.name, zero, values.shape, values.shape, dims)
        _require_array(field, form.arrays[field], due)


def foreign_entry(folder: Path) -> str | None:
    """Return the name of something in a map's folder that is no part of a map, if there is any."""
    known = {DESCRIPTION, *_NAMES}
    return min((entry.name for entry in folder.iterdir() if entry.name not in known), default=None)


def require_chunk(folder: Path, name: Path, size: int) -> None:
    """Refuse a chunk of a map's folder that does not decode to `size` bytes, and one of an axis that is lost.

    Raises:
        FormError: naming the file.
    """
    try:
        with (folder / name).open("rb") as file:
            stored, head = os.fstat(file.fileno()).st_size, file.read(18)
    except FileNotFoundError:
        if name.parts[0] in LAYERS:  # not tossed yet
            return
        raise FormError(f"{name}: lost") from None
    # What can't be compressed becomes longer, by less than this.
    if stored > 2 * size + 1024 or _decoded_size(head) != size:
        raise FormError(f"{name}: does not decode to {size} bytes")


def _require_plain(folder: Path, dims: int) -> None:
    """Refuse links, which lead elsewhere, and pipes and devices, which may have no end.

    Args:
        folder: of a store.
        dims: its dimensions. Within it are folders of arrays, in each one of chunks, and in this one for each
            dimension but the last.
    """
    folders, deepest = [(folder, 0)], 1 + dims
    while folders:
        outer, depth = folders.pop()
        with os.scandir(outer) as entries:
            for entry in entries:
                if entry.is_dir(follow_symlinks=False) and depth < deepest:
                    folders.append((Path(entry), depth + 1))
                elif not entry.is_file(follow_symlinks=False):
                    name = Path(entry).relative_to(folder)
                    raise FormError(f"{name}: neither a file nor a folder of a map")


def _description(folder: Path) -> dict[str, Any]:
    """Return what describes a map or an array."""
    try:
        found = json.loads(read_bounded(folder / DESCRIPTION, MOST_DESCRIBED))
    except FileNotFoundError:
        raise FormError(f"{folder.name}: no {DESCRIPTION}") from None
    except RecursionError:
        raise FormError(f"{folder.name}/{DESCRIPTION}: nested too deeply") from None
    except ValueError as error:
        raise FormError(f"{folder.name}/{DESCRIPTION}: {error}") from None
    if not isinstance(found, dict):
        raise FormError(f"{folder.name}/{DESCRIPTION}: describes nothing")
    return found


def _grid(attributes: dict[str, Any], arrays: dict[str, dict[str, Any]]) -> MapGrid:
    """Return the grid of a map, all of whose arrays are as cointoss writes them."""
    if not isinstance(attributes.get(MARGIN_ALONG, ""), str):
        raise FormError(f"attribute {MARGIN_ALONG} = {shown(attributes[MARGIN_ALONG])}")
    if attributes.get(TRUST, True) is not True:
        raise FormError(f"attribute {TRUST} = {shown(attributes[TRUST])}")
    due = {"outcome", "impacts"} | ({"margin"} if MARGIN_ALONG in attributes else set())
    due |= {trust_layer(attributes["after"])} if TRUST in attributes else set()
    if due - set(arrays):
        raise FormError(f"array {min(due - set(arrays))} missing")
    fields = set(arrays) - due
    if len(fields) != 2 or not fields <= set(NUMBERS):
        raise FormError(f"fields of its axes: {shown(sorted(fields))}, not two of a scenario")
    (x, columns), (y, rows) = (_axis(arrays, dimension) for dimension in ("x", "y"))
    layers = {name: layer for name, layer in LAYERS.items() if name in due}
    height, width = _require_layers(arrays, {"y": rows, "x": columns}, layers)
    return MapGrid(x, y, (rows, columns), (height, width))


def _require_layers(
    arrays: dict[str, dict[str, Any]], sizes: Mapping[str, int], layers: Mapping[str, Any]
) -> tuple[int, ...]:
    """Return the lengths of a tile; refuse arrays that are described otherwise than these layers."""
    shape = tuple(sizes.values())
    tile = _sizes("outcome", arrays["outcome"].get("chunk_grid"), within=shape)
    if math.prod(tile) > MOST_IN_TILE:
        told = f"{tile[1]} by {tile[0]} pixels" if tuple(sizes) == ("y", "x") else f"{tile} tosses"
        raise FormError(f"array outcome: tiles of {told}")
    for name, layer in layers.items():
        written = "NaN" if math.isnan(layer.missing) else layer.missing
        _require_array(
            name, arrays[name], _array(np.dtype(layer.kind).name, written, shape, tile, tuple(sizes))
        )
    return tile


def _group_attributes(described: dict[str, Any]) -> dict[str, Any]:
    """Return the attributes of a map or a store of tosses, from what describes it."""
    attributes = described.get("attributes")
    if not isinstance(attributes, dict):
        raise FormError(f"attribute {_MAP} missing")
    kind = next((kind for kind in (_TOSSES, _MAP) if kind in attributes), _MAP)
    for name in (kind, *_ATTRIBUTES):
        if name not in attributes:
            raise FormError(f"attribute {name} missing")
        found = attributes[name]
        if name == kind and found != _FORMATS[kind]:
            raise FormError(f"attribute {kind} = {shown(found)}, not {_FORMATS[kind]}")
        if not isinstance(found, _ATTRIBUTES.get(name, object)):
            raise FormError(f"attribute {name} = {shown(found)}")
    for name, due in (("zarr_format", 3), ("node_type", "group")):
        if described.get(name) != due:
            raise FormError(f"{name} = {shown(described.get(name))}, not {due}")
    return attributes


def _listed(folder: Path, described: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the descriptions of the arrays by their names, of which the store has copies."""
    consolidated = described.get("consolidated_metadata")
    listed = consolidated.get("metadata") if isinstance(consolidated, dict) else None
    if not isinstance(listed, dict):
        raise FormError("consolidated_metadata missing")
    if foreign := set(listed) - _NAMES:
        raise FormError(f"fields of its axes: {shown(sorted(foreign))}, not of a scenario")
    arrays = {name: _description(folder / name) for name in listed}
    for name, found in arrays.items():
        if _text(found) != _text(listed[name]):
            raise FormError(f"array {name}: described otherwise in the map's {DESCRIPTION}")
        if decoded := _DECODED & set(found.get("attributes") or ()):
            raise FormError(
                f"array {name}: attribute {min(decoded)}, by which xarray would change its numbers"
            )
    return arrays


def _axis(arrays: dict[str, dict[str, Any]], dimension: str) -> tuple[str, int]:
    """Return the field of an axis, and how many values it has."""
    fields = [name for name in arrays if arrays[name].get("dimension_names") == [dimension]]
    if len(fields) != 1:
        raise FormError(f"grid in {dimension}: {len(fields)} arrays")
    (name,) = fields
    found = arrays[name]
    shape = _whole(name, found.get("shape"), within=(MOST_VALUES,))
    if shape == (1,):
        raise FormError(f"grid in {dimension}: one value")
    chunk = _sizes(name, found.get("chunk_grid"), within=shape)
    _require_array(name, found, _array("float64", 0.0, shape, chunk, (dimension,)))
    return name, shape[0]


def _sizes(name: str, grid: object, *, within: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape of the chunks of an array."""
    match grid:
        case {"name": "regular", "configuration": {"chunk_shape": sizes}}:
            return _whole(name, sizes, within=within)
    raise FormError(f"array {name}: chunk_grid = {shown(grid)}")


def _whole(name: str, sizes: object, *, within: tuple[int, ...]) -> tuple[int, ...]:
    """Return sizes along axes, each from 1 to its bound."""
    if not isinstance(sizes, list) or [type(size) for size in sizes] != [int] * len(within):
        raise FormError(f"array {name}: sizes {shown(sizes)}")
    if not all(1 <= size <= most for size, most in zip(sizes, within, strict=True)):
        raise FormError(f"array {name}: sizes {shown(sizes)}, not from 1 to {list(within)}")
    return tuple(sizes)


def _array(
    kind: str, fill_value: object, shape: tuple[int, ...], chunk: tuple[int, ...], dimensions: tuple[str, ...]
) -> dict[str, Any]:
    """Return what describes an array, but for its attributes and codecs."""
    return {
        "zarr_format": 3,
        "node_type": "array",
        "data_type": kind,
        "shape": list(shape),
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": list(chunk)}},
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "fill_value": fill_value,
        "dimension_names": list(dimensions),
        "storage_transformers": [],
    }


def _require_array(name: str, found: dict[str, Any], due: dict[str, Any]) -> None:
    """Refuse what describes an array otherwise than cointoss does."""
    rest = {"storage_transformers": [], **found}
    rest.pop("attributes", None)
    codecs = rest.pop("codecs", None)
    for key in sorted({*rest, *due}):
        if key not in due or _text(rest.get(key)) != _text(due[key]):
            raise FormError(f"array {name}: {key} = {shown(rest.get(key))}, not {shown(due.get(key))}")
    order = {} if due["data_type"] == "int8" else {"configuration": {"endian": "little"}}
    settings = [{"level": 0, "checksum": is_checked} for is_checked in (True, False)]
    ours = [[{"name": "bytes", **order}, {"name": "zstd", "configuration": each}] for each in settings]
    if _text(codecs) not in map(_text, ours):
        raise FormError(f"array {name}: codecs {shown(codecs)}, not bytes and zstd")


def _text(value: object) -> str:
    """Return a value as JSON, in which 1, 1.0 and true differ."""
    return json.dumps(value, sort_keys=True)


def _decoded_size(head: bytes) -> int | None:
    """Return how many bytes the Zstandard frame that begins so says it holds (RFC 8878, 3.1.1.1)."""
    if len(head) < 6 or head[:4] != b"\x28\xb5\x2f\xfd":
        return None
    single = head[4] >> 5 & 1
    length = (single, 2, 4, 8)[head[4] >> 6]
    start = 5 + (1 - single) + (0, 1, 2, 4)[head[4] & 3]
    field = head[start : start + length]
    return int.from_bytes(field, "little") + 256 * (length == 2) if len(field) == length > 0 else None
