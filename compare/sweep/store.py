"""A map on disk: a Zarr store that is filled tile by tile, by one process at a time."""

import fcntl
import json
import os
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import zarr
from numpy.typing import NDArray
from zarr.codecs import ZstdCodec
from zarr.errors import ZarrUserWarning

from compare.output.files import UnwritableError, beside, naming, remove, written_whole
from compare.output.interruption import undoing
from compare.sweep.axes import Axis
from compare.sweep.grid import Sweep, Tile, tile_shape, tiles
from compare.sweep.layers import Layer, axis_attributes, layers_of
from compare.sweep.pixels import Pixels
from models.errors import ScenarioError, shown
from models.reading import parse
from models.records import Outcome

FORMAT = 1
"""Of a map, under the attribute `cointoss_map`."""
_ATTRIBUTES = {
    "scenario": str,
    "engine": str,
    "engine_settings": dict,
    "after": int | None,
    "versions": dict,
}
_MARGIN = "margin_along"
"""Attribute of a map with margins: their quantity."""
_WAYS_OUT = "accepted: a new name, or --overwrite"


@dataclass(frozen=True, kw_only=True)
class Map:
    """A map that this process may fill."""

    path: Path
    group: zarr.Group

    @property
    def tiles(self) -> list[Tile]:
        """All tiles."""
        outcome = self._array("outcome")
        return list(tiles(_pair(outcome.shape), _pair(outcome.chunks)))

    @property
    def is_empty(self) -> bool:
        """Whether no tile was tossed yet; only the names of what is on disk are read."""
        return self._array("outcome").nchunks_initialized == 0

    def tossed(self, tile: Tile) -> NDArray[np.bool_]:
        """Return which pixels of a tile are on disk; none of one that is damaged, (y, x)."""
        try:
            outcome, impacts = (self.read(tile, name) for name in ("outcome", "impacts"))
            margin = self.read(tile, "margin") if self.has_margin else np.zeros(outcome.shape)
        except OSError:
            raise
        except Exception:  # its checksum is wrong, or it breaks off; each codec fails in its own way
            return np.zeros([part.stop - part.start for part in tile], dtype=bool)
        return np.isin(outcome, list(Outcome)) & (impacts >= 0) & ~np.isnan(margin)

    @property
    def has_margin(self) -> bool:
        """Whether it holds margins too."""
        return "margin" in self.group

    def read(self, tile: Tile, name: str = "outcome") -> NDArray[Any]:
        """Return a tile of an array, (y, x)."""
        return self._array(name)[tile.rows, tile.columns]

    def write(self, tile: Tile, pixels: Pixels) -> None:
        """Keep what is known of a tile, or of a part of one.

        Raises:
            UnwritableError: naming the map and why, for every error of the system.
        """
        with naming(self.path):
            if pixels.margin is not None:
                self._put("margin", tile, pixels.margin)
            self._put("impacts", tile, pixels.impacts)
            self._put("outcome", tile, pixels.outcome)

    def _put(self, name: str, part: Tile, values: NDArray[Any]) -> None:
        """Write a part of a tile; a file around it that is damaged holds nothing else."""
        array = self._array(name)
        try:
            array[part.rows, part.columns] = values
        except OSError:
            raise
        except Exception:  # see `tossed`
            around = (
                slice(side.start // length * length, (side.start // length + 1) * length)
                for side, length in zip(part, array.chunks, strict=True)
            )
            array[tuple(around)] = array.fill_value
            array[part.rows, part.columns] = values

    def _array(self, name: str) -> Any:
        return self.group[name]


def require_place(path: Path, *, resume: bool, overwrite: bool) -> None:
    """Check that a map can be made at a path, and that nothing is lost.

    Args:
        path: a name that ends in .zarr, in a folder that exists.
        resume: whether a map there is to be gone on with.
        overwrite: whether a map there is to be replaced.

    Raises:
        UnwritableError: naming the path and why.
    """
    if path.suffix != ".zarr":
        raise UnwritableError(f"{path}: accepted: a folder's name that ends in .zarr")
    with naming(path):
        target = Path(os.path.realpath(path))
        if not target.parent.is_dir():
            raise UnwritableError(f"{path}: accepted: a name in a folder that exists")
        if not target.exists() or (target.is_dir() and not any(target.iterdir())):
            probe = beside(target)
            with undoing(lambda: remove(probe)):
                probe.mkdir()
        elif not _is_map(target):
            raise UnwritableError(f"{path}: accepted: a new name, or a map of cointoss (this is none)")
        elif not (resume or overwrite):
            raise UnwritableError(
                f"{path}: accepted: a new name (this map exists: --resume continues it, --overwrite "
                "replaces it)"
            )


def require_same(path: Path, sweep: Sweep) -> None:
    """Check that a map at a path, if there is one, is that of a sweep.

    Raises:
        UnwritableError: naming the path and what is not the same.
    """
    with naming(path):
        target = Path(os.path.realpath(path))
        if _is_map(target):
            with _readable(path):
                _require_same(path, zarr.open_group(target, mode="r", use_consolidated=False), sweep)


@contextmanager
def opened(path: Path, sweep: Sweep, scenario_text: str, *, overwrite: bool) -> Iterator[Map]:
    """Open the map of a sweep for this process alone: a new one, or what is there of it.

    Args:
        path: of the map; checked by `require_place`.
        sweep: what the map is made of.
        scenario_text: the scenario's TOML.
        overwrite: whether a map that is there is replaced.

    Raises:
        UnwritableError: naming the path and why: another process is at it, or it is another sweep's map.
    """
    target = Path(os.path.realpath(path))
    with ExitStack() as kept:
        with naming(path):
            if overwrite and _is_map(target):
                with _locked(path, target):
                    _remove(target)
            if not _is_map(target):
                _create(target, sweep, scenario_text)
            kept.enter_context(_locked(path, target))
            with _readable(path):
                group = zarr.open_group(target, mode="r+", use_consolidated=False)
                _require_same(path, group, sweep)
            for left in target.rglob("*.partial"):  # by a process that was killed
                left.unlink()
        yield Map(path=path, group=group)


def _create(target: Path, sweep: Sweep, scenario_text: str) -> None:
    """Make an empty map, whole or not at all; where one has come up meanwhile, leave it."""
    try:
        with written_whole(target) as aside:
            _write_empty(aside, sweep, scenario_text)
    except UnwritableError:
        if not _is_map(target):
            raise


def _write_empty(folder: Path, sweep: Sweep, scenario_text: str) -> None:
    group = zarr.create_group(folder, zarr_format=3, attributes=_attributes(sweep, scenario_text))
    for name, layer in layers_of(sweep).items():
        group.create_array(
            name,
            shape=sweep.shape,
            chunks=tile_shape(sweep),
            dtype=layer.kind,
            fill_value=layer.fill_value,
            dimension_names=("y", "x"),
            # A tile that breaks off must not pass for one.
            compressors=ZstdCodec(checksum=True),
            attributes={**layer.attributes, "coordinates": f"{sweep.y.field} {sweep.x.field}"},
        )
    for axis, dimension in ((sweep.y, "y"), (sweep.x, "x")):
        group.create_array(
            axis.field,
            data=axis.values,
            dimension_names=(dimension,),
            attributes=axis_attributes(axis),
        )
    with warnings.catch_warnings():
        # Not yet in the specification of Zarr 3, but xarray asks for it.
        warnings.simplefilter("ignore", ZarrUserWarning)
        zarr.consolidate_metadata(group.store)


def _attributes(sweep: Sweep, scenario_text: str) -> dict[str, Any]:
    return {
        "cointoss_map": FORMAT,
        "scenario": scenario_text,
        "engine": sweep.engine.value,
        "engine_settings": sweep.settings.as_dict(),
        "after": sweep.after,
        **({} if sweep.margin is None else {_MARGIN: sweep.margin}),
        "versions": {**sweep.engine.versions, "zarr": version("zarr")},
    }


def _require_same(path: Path, group: zarr.Group, sweep: Sweep) -> None:
    """Refuse to go on with a map of another sweep, or of other versions: its pixels would be of two kinds."""
    found: dict[str, Any] = dict(group.attrs)
    for name, kind in _ATTRIBUTES.items():
        if name not in found or not isinstance(found[name], kind):
            given = f"= {shown(found[name])}" if name in found else "missing"
            raise _damaged(path, f"attribute {name} {given}")
    made_by = {name: found["versions"].get(name) for name in sweep.engine.versions}
    try:
        same_scenario = parse(found["scenario"], str(path)) == sweep.scenario
    except ScenarioError:
        same_scenario = False
    for what, same in (
        ("scenario", same_scenario),
        ("engine", found["engine"] == sweep.engine),
        (
            f"engine's settings, {json.dumps(found['engine_settings'])}",
            found["engine_settings"] == sweep.settings.as_dict(),
        ),
        ("number of impacts (--after)", found["after"] == sweep.after),
        ("quantity of its margins (--margin)", found.get(_MARGIN) == sweep.margin),
        ("grid in x", _is_axis(group, "x", sweep.x)),
        ("grid in y", _is_axis(group, "y", sweep.y)),
        (f"versions, {json.dumps(made_by)}", made_by == sweep.engine.versions),
    ):
        if not same:
            raise UnwritableError(f"{path}: is a map with another {what}; {_WAYS_OUT}")
    consolidated = zarr.open_group(group.store, mode="r", use_consolidated=True)
    for read in (group, consolidated):
        for name, layer in layers_of(sweep).items():
            _require_array(path, read, name, layer, sweep)
    for name, axis in (("x", sweep.x), ("y", sweep.y)):
        if not _is_axis(consolidated, name, axis):
            raise _damaged(path, f"array {axis.field}: not in the consolidated metadata")


def _require_array(path: Path, group: zarr.Group, name: str, layer: Layer, sweep: Sweep) -> None:
    """Refuse an array that is none of a map of a sweep."""
    array: Any = group.get(name)
    if not isinstance(array, zarr.Array):
        raise _damaged(path, f"array {name} missing")
    for what, there, due in (
        ("type", array.dtype.name, np.dtype(layer.kind).name),
        ("shape", array.shape, sweep.shape),
        ("tile", array.chunks, tile_shape(sweep)),
        ("fill value", array.fill_value, layer.fill_value),
    ):
        if there != due and not (there != there and due != due):  # two NaN are alike
            raise _damaged(path, f"array {name}: {what} {there}, not {due}")


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    """Name a map in what goes wrong in reading it; zarr raises errors of any kind."""
    try:
        yield
    except OSError:
        raise
    except Exception as error:
        raise _damaged(path, f"{type(error).__name__}: {error}") from None


def _damaged(path: Path, what: str) -> UnwritableError:
    return UnwritableError(f"{path}: is a damaged map ({what}); {_WAYS_OUT}")


def _is_axis(group: zarr.Group, dimension: str, axis: Axis) -> bool:
    if axis.field not in group:
        return False
    array: Any = group[axis.field]
    return array.metadata.dimension_names == (dimension,) and np.array_equal(array[:], axis.values)


def _is_map(path: Path) -> bool:
    try:
        description = json.loads((path / "zarr.json").read_text(encoding="utf-8"))
        return description["attributes"]["cointoss_map"] == FORMAT
    except (OSError, ValueError, KeyError, TypeError):
        return False


@contextmanager
def _locked(path: Path, target: Path) -> Iterator[None]:
    """Keep a map for this process; the system lets go of it when the process ends, however it ends."""
    with (target / "zarr.json").open("r+b") as description:
        try:
            fcntl.flock(description, fcntl.LOCK_EX | fcntl.LOCK_NB)
            still_there = os.path.samestat(os.fstat(description.fileno()), (target / "zarr.json").stat())
        except (BlockingIOError, FileNotFoundError):
            still_there = False
        if not still_there:
            raise UnwritableError(f"{path}: another process is at this map; accepted: wait for its end")
        yield


def _remove(target: Path) -> None:
    """Remove a map; renamed first, so that no half of it is left under its name."""
    aside = beside(target)
    with undoing(lambda: remove(aside)):
        target.rename(aside)


def _pair(numbers: tuple[int, ...]) -> tuple[int, int]:
    first, second = numbers
    return first, second
