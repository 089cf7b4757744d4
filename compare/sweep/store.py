"""A map on disk: a Zarr store that is filled tile by tile, by one process at a time."""

import json
import math
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import cache, cached_property
from importlib.metadata import version
from itertools import product
from pathlib import Path
from typing import Any, Literal

import numpy as np
import zarr
from filelock import FileLock, Timeout
from numpy.typing import NDArray
from zarr.codecs import ZstdCodec
from zarr.errors import ZarrUserWarning

from cointoss.compare.output.files import UnwritableError, beside, naming, remove, written_whole
from cointoss.compare.output.interruption import undoing
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.form import (
    FORMAT,
    MARGIN_ALONG,
    TRUST,
    foreign_entry,
    is_map,
    read_form,
    require_chunk,
)
from cointoss.compare.sweep.grid import Sweep, Tile, tile_shape, tiles
from cointoss.compare.sweep.layers import LAYERS, axis_attributes, holds_tosses, layers_of
from cointoss.compare.sweep.pixels import Pixels
from cointoss.models.errors import ScenarioError
from cointoss.models.reading import parse

_WAYS_OUT = "accepted: a new name, or --overwrite"


@dataclass(frozen=True, kw_only=True)
class Map:
    """A map on disk whose form is accepted; what does not decode to its size raises `FormError`."""

    path: Path
    group: zarr.Group

    @classmethod
    def at(cls, path: Path, mode: Literal["r", "r+"]) -> "Map":
        """Open a map whose form is accepted, for reading alone or to be filled."""
        return cls(path=path, group=zarr.open_group(path, mode=mode, zarr_format=3, use_consolidated=False))

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
        none = np.zeros([part.stop - part.start for part in tile], dtype=bool)
        if not (self.path / next(self._files("outcome", tile))).exists():
            return none
        try:
            parts = [holds_tosses(name, self.read(tile, name)) for name in LAYERS if name in self.group]
        except OSError:
            raise
        except Exception:  # its checksum is wrong, or it breaks off; each codec fails in its own way
            return none
        return np.logical_and.reduce(parts)

    def read(self, part: tuple[slice, ...], name: str = "outcome") -> NDArray[Any]:
        """Return a part of an array, such as a tile, (y, x)."""
        self._require_chunks(name, part)
        return self._array(name)[part]

    def whole(self, name: str) -> NDArray[Any]:
        """Return all values of an array, (y, x), or of an axis by its field, (n,)."""
        return self.read(tuple(slice(0, count) for count in self._array(name).shape), name)

    def write(self, tile: Tile, pixels: Pixels) -> None:
        """Keep what is known of a tile, or of a part of one.

        Raises:
            UnwritableError: naming the map and why, for every error of the system.
        """
        with naming(self.path):
            for name in reversed(LAYERS):  # the outcome last: where it is, the tile is whole
                if (values := getattr(pixels, name)) is not None:
                    self._put(name, tile, values)

    def _put(self, name: str, part: Tile, values: NDArray[Any]) -> None:
        """Write a part of a tile; a file around it that is damaged holds nothing else."""
        array = self._array(name)
        try:
            self._require_chunks(name, part)  # zarr reads what is around the part
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

    def _require_chunks(self, name: str, part: tuple[slice, ...]) -> None:
        """Refuse chunks of a part of an array that decode to another size than they should."""
        array = self._array(name)
        size = array.dtype.itemsize * math.prod(array.chunks)
        for file in self._files(name, part):
            require_chunk(self.path, file, size)

    def _files(self, name: str, part: tuple[slice, ...]) -> Iterator[Path]:
        """Yield the files of the chunks of a part of an array, as they are named in the map."""
        spans = zip(part, self._array(name).chunks, strict=True)
        for place in product(*(range(one.start // side, -(-one.stop // side)) for one, side in spans)):
            yield Path(name, "c", *map(str, place))

    @cached_property
    def _array(self) -> Callable[[str], Any]:
        """Opens an array by its name, once."""
        return cache(self.group.__getitem__)


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
        raise UnwritableError(f"{path}: another kind of name; accepted: one that ends in .zarr")
    with naming(path):
        target = Path(os.path.realpath(path))
        if not target.parent.is_dir():
            raise UnwritableError(
                f"{path}: no folder {path.parent}; accepted: a name in a folder that exists"
            )
        if not target.exists() or (target.is_dir() and not any(target.iterdir())):
            probe = beside(target)
            with undoing(lambda: remove(probe)):
                probe.mkdir()
        elif not is_map(target):
            raise UnwritableError(f"{path}: is no map; accepted: a new name, or a map of cointoss")
        elif not (resume or overwrite):
            raise UnwritableError(
                f"{path}: exists; accepted: a new name, --resume to continue it, or --overwrite to replace it"
            )
        elif overwrite and (foreign := foreign_entry(target)):
            raise UnwritableError(f"{path}: holds {foreign}, which is no part of a map; accepted: a new name")


def require_same(path: Path, sweep: Sweep) -> None:
    """Check that a map at a path, if there is one, is that of a sweep.

    Raises:
        UnwritableError: naming the path and what is not the same.
    """
    with naming(path):
        target = Path(os.path.realpath(path))
        if is_map(target):
            _same(path, target, "r", sweep)


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
            if overwrite and is_map(target):
                with _locked(path, target):
                    _remove(target)
            if not is_map(target):
                _create(target, sweep, scenario_text)
            kept.enter_context(_locked(path, target))
            map_ = _same(path, target, "r+", sweep)
            for left in target.rglob("*.partial"):  # by a process that was killed
                left.unlink()
        yield map_


def _create(target: Path, sweep: Sweep, scenario_text: str) -> None:
    """Make an empty map, whole or not at all; where one has come up meanwhile, leave it."""
    try:
        with written_whole(target) as aside:
            _write_empty(aside, sweep, scenario_text)
    except UnwritableError:
        if not is_map(target):
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
            chunks=(axis.count,),
            compressors=ZstdCodec(checksum=True),
            dimension_names=(dimension,),
            attributes=axis_attributes(axis),
        )
    consolidate(group)


def consolidate(group: zarr.Group) -> None:
    """Write what describes a group's arrays into one file, from which xarray reads it without a warning."""
    # Not yet in the specification of Zarr 3, but xarray asks for it.
    with warnings.catch_warnings(action="ignore", category=ZarrUserWarning):
        zarr.consolidate_metadata(group.store)


def _attributes(sweep: Sweep, scenario_text: str) -> dict[str, Any]:
    return {
        "cointoss_map": FORMAT,
        "name": sweep.name,
        "scenario": scenario_text,
        "engine": sweep.engine.value,
        "engine_settings": sweep.settings.as_dict(),
        "after": sweep.after,
        **({} if sweep.margin is None else {MARGIN_ALONG: sweep.margin}),
        **({TRUST: True} if sweep.trust else {}),
        "versions": {**sweep.engine.versions, "zarr": version("zarr")},
    }


def _same(path: Path, target: Path, mode: Literal["r", "r+"], sweep: Sweep) -> Map:
    """Open the map of a sweep.

    One of another sweep or of other versions is refused: its pixels would be of two kinds.
    """
    with _readable(path):
        form, found = read_form(target), Map.at(target, mode)
        values = {name: found.whole(name) for name in (form.x, form.y)}
    attributes = form.attributes
    stored = attributes["versions"]
    made_by = {name: stored.get(name) for name in {**sweep.engine.versions, **stored} if name != "zarr"}
    settings = attributes["engine_settings"]
    try:
        same_scenario = parse(attributes["scenario"], str(path)) == sweep.scenario
    except ScenarioError:
        same_scenario = False

    def is_axis(name: str, axis: Axis) -> bool:
        return name == axis.field and np.array_equal(values[name], axis.values)

    for what, same in (
        ("scenario", same_scenario),
        ("engine", attributes["engine"] == sweep.engine),
        (f"engine's settings, {json.dumps(settings)}", settings == sweep.settings.as_dict()),
        ("number of impacts (--after)", attributes["after"] == sweep.after),
        ("quantity of its margins (--margin)", attributes.get(MARGIN_ALONG) == sweep.margin),
        ("set of arrays (--trust)", (TRUST in attributes) == sweep.trust),
        ("grid in x", is_axis(form.x, sweep.x)),
        ("grid in y", is_axis(form.y, sweep.y)),
        (f"set of versions, {json.dumps(made_by)}", made_by == sweep.engine.versions),
        (f"size of its tiles, {form.tile}", form.tile == tile_shape(sweep)),
    ):
        if not same:
            raise UnwritableError(f"{path}: is a map with another {what}; {_WAYS_OUT}")
    return replace(found, path=path)


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    """Name a map in what goes wrong in reading it; zarr raises errors of any kind."""
    try:
        yield
    except OSError:
        raise
    except Exception as error:
        raise UnwritableError(f"{path}: is no map of cointoss ({error}); {_WAYS_OUT}") from None


@contextmanager
def _locked(path: Path, target: Path) -> Iterator[None]:
    """Keep a map for this process; the system lets go of it when the process ends, however it ends.

    The lock is a file beside the map: within, it would be no part of it, and Windows renames no open folder.
    """
    lock = target.with_name(f".{target.name}.lock")
    with ExitStack() as held:
        try:
            held.enter_context(FileLock(lock, blocking=False))
        except Timeout:
            raise UnwritableError(
                f"{path}: another process is at this map; accepted: wait for its end"
            ) from None
        held.enter_context(undoing(lambda: _unlink(lock)))
        yield


def _unlink(lock: Path) -> None:
    """Remove a lock's file while it is held; on Windows it goes when it is let go of."""
    with suppress(OSError):
        lock.unlink()


def _remove(target: Path) -> None:
    """Remove a map; renamed first, so that no half of it is left under its name."""
    aside = beside(target)
    with undoing(lambda: remove(aside)):
        target.rename(aside)


def _pair(numbers: tuple[int, ...]) -> tuple[int, int]:
    first, second = numbers
    return first, second
