"""Tosses on disk: a Zarr store that is filled tile by tile, by one process at a time."""

import json
import math
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import cache, cached_property
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
from cointoss.compare.sweep.form import (
    MARGIN_ALONG,
    TRUST,
    StoreForm,
    foreign_entry,
    is_map,
    read_form,
    require_arrays,
    require_chunk,
)
from cointoss.compare.sweep.grid import numbers_in, tiles
from cointoss.compare.sweep.layers import LAYERS, holds_tosses
from cointoss.compare.sweep.layout import Layout
from cointoss.compare.sweep.pieces import Columns
from cointoss.models.errors import ScenarioError
from cointoss.models.reading import parse

_WAYS_OUT = "accepted: a new name, or `overwrite`"
_READERS = ("zarr", "xarray")
"""Versions on which no toss depends."""
_CALLED = {
    "engine": "engine",
    "engine_settings": "engine's settings",
    "after": "number of impacts (`after`)",
    MARGIN_ALONG: "quantity of its margins (`margin`)",
    TRUST: "set of arrays (`trust`)",
}
"""What a person calls attributes."""


@dataclass(frozen=True, kw_only=True)
class Store:
    """A store on disk whose form is accepted; what does not decode to its size raises `FormError`."""

    path: Path
    group: zarr.Group

    @classmethod
    def at(cls, path: Path, mode: Literal["r", "r+"]) -> "Store":
        """Open a store whose form is accepted, for reading alone or to be filled."""
        return cls(path=path, group=zarr.open_group(path, mode=mode, zarr_format=3, use_consolidated=False))

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of its dimensions."""
        return self._array("outcome").shape

    @property
    def tiles(self) -> list[tuple[slice, ...]]:
        """All tiles."""
        return list(tiles(self.shape, self._array("outcome").chunks))

    @property
    def is_empty(self) -> bool:
        """Whether no tile was tossed yet; only the names of what is on disk are read."""
        return self._array("outcome").nchunks_initialized == 0

    def tossed(self, tile: tuple[slice, ...]) -> NDArray[np.bool_]:
        """Return what of a tile is on disk, over the tile; nothing of one that is damaged."""
        none = np.zeros([part.stop - part.start for part in tile], dtype=bool)
        if not (self.path / next(self._files("outcome", tile))).exists():
            return none
        try:
            parts = [holds_tosses(name, self.read(tile, name)) for name in self._layers]
        except OSError:
            raise
        except Exception:  # its checksum is wrong, or it breaks off; each codec fails in its own way
            return none
        return np.logical_and.reduce(parts)

    def missing(self, tile: tuple[slice, ...]) -> NDArray[np.intp]:
        """Return the numbers of what of a tile is not on disk, in the order of a C array."""
        return numbers_in(tile, self.shape)[~self.tossed(tile)]

    def read(self, part: tuple[slice, ...], name: str = "outcome") -> NDArray[Any]:
        """Return a part of an array, such as a tile."""
        self._require_chunks(name, part)
        return self._array(name)[part]

    def whole(self, name: str) -> NDArray[Any]:
        """Return all values of an array, or of a coordinate by its field."""
        return self.read(tuple(slice(0, count) for count in self._array(name).shape), name)

    def write(self, numbers: NDArray[np.intp], layers: Columns) -> None:
        """Keep what is known of a tile, or of a part of one.

        Args:
            numbers: of the tosses, in one tile.
            layers: by name, (n,) each.

        Raises:
            UnwritableError: naming the store and why, for every error of the system.
        """
        at = np.unravel_index(numbers, self.shape)
        lengths = self._array("outcome").chunks
        tile = tuple(
            slice(one[0] // length * length, min((one[0] // length + 1) * length, size))
            for one, length, size in zip(at, lengths, self.shape, strict=True)
        )
        inside = tuple(one - part.start for one, part in zip(at, tile, strict=True))
        with naming(self.path):
            # The outcome last: where it is, the tile is whole.
            for name in sorted(layers, key=lambda name: name == "outcome"):
                self._put(name, tile, inside, layers[name])

    def _put(self, name: str, tile: tuple[slice, ...], inside: tuple[Any, ...], values: NDArray[Any]) -> None:
        """Write a part of a tile; a file around it that is damaged holds nothing else."""
        array = self._array(name)
        shape = [part.stop - part.start for part in tile]
        known = np.full(shape, array.fill_value, array.dtype)
        if len(values) < math.prod(shape):
            try:
                known = self.read(tile, name)
            except OSError:
                raise
            except Exception:  # see `tossed`
                pass
        known[inside] = values
        array[tile] = known

    def _require_chunks(self, name: str, part: tuple[slice, ...]) -> None:
        """Refuse chunks of a part of an array that decode to another size than they should."""
        array = self._array(name)
        size = array.dtype.itemsize * math.prod(array.chunks)
        for file in self._files(name, part):
            require_chunk(self.path, file, size)

    def _files(self, name: str, part: tuple[slice, ...]) -> Iterator[Path]:
        """Yield the files of the chunks of a part of an array, as they are named in the store."""
        spans = zip(part, self._array(name).chunks, strict=True)
        for place in product(*(range(one.start // side, -(-one.stop // side)) for one, side in spans)):
            yield Path(name, "c", *map(str, place))

    @cached_property
    def _layers(self) -> list[str]:
        return [name for name in LAYERS if name in self.group]

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
                f"{path}: exists; accepted: a new name, `resume` to continue it, or `overwrite` to replace it"
            )
        elif overwrite and (foreign := foreign_entry(target)):
            raise UnwritableError(f"{path}: holds {foreign}, which is no part of a map; accepted: a new name")


def require_same(path: Path, layout: Layout) -> None:
    """Check that a store at a path, if there is one, has a layout.

    Raises:
        UnwritableError: naming the path and what is not the same.
    """
    with naming(path):
        target = Path(os.path.realpath(path))
        if is_map(target):
            _same(path, target, "r", layout)


@contextmanager
def opened(path: Path, layout: Layout, *, overwrite: bool) -> Iterator[Store]:
    """Open a store for this process alone: a new one, or what is there of it.

    Args:
        path: of the store; checked by `require_place`.
        layout: what it is made of.
        overwrite: whether a store that is there is replaced.

    Raises:
        UnwritableError: naming the path and why: another process is at it, or it is another one.
    """
    target = Path(os.path.realpath(path))
    with ExitStack() as kept:
        with naming(path):
            if overwrite and is_map(target):
                with _locked(path, target):
                    _remove(target)
            if not is_map(target):
                _create(target, layout)
            kept.enter_context(_locked(path, target))
            store = _same(path, target, "r+", layout)
            for left in target.rglob("*.partial"):  # by a process that was killed
                left.unlink()
        yield store


def _create(target: Path, layout: Layout) -> None:
    """Make an empty store, whole or not at all; where one has come up meanwhile, leave it."""
    try:
        with written_whole(target) as aside:
            _write_empty(aside, layout)
    except UnwritableError:
        if not is_map(target):
            raise


def _write_empty(folder: Path, layout: Layout) -> None:
    group = zarr.create_group(folder, zarr_format=3, attributes=layout.attributes)
    for name, layer in layout.layers.items():
        group.create_array(
            name,
            shape=tuple(layout.sizes.values()),
            chunks=layout.tile,
            dtype=layer.kind,
            fill_value=layer.missing,
            dimension_names=list(layout.sizes),
            # A tile that breaks off must not pass for one.
            compressors=ZstdCodec(checksum=True),
            attributes={**layer.attributes, "coordinates": " ".join(layout.coordinates)},
        )
    for field, one in layout.coordinates.items():
        group.create_array(
            field,
            data=one.values,
            chunks=one.values.shape,
            # Zeros are the fill value, and a file that is not there is one that was lost.
            config={"write_empty_chunks": True},
            compressors=ZstdCodec(checksum=True),
            dimension_names=list(one.dims),
            attributes=one.attributes,
        )
    # Not yet in the specification of Zarr 3, but xarray asks for it.
    with warnings.catch_warnings(action="ignore", category=ZarrUserWarning):
        zarr.consolidate_metadata(group.store)


def _same(path: Path, target: Path, mode: Literal["r", "r+"], layout: Layout) -> Store:
    """Open a store of this layout.

    A store of another layout or of other versions raises an error: its tosses would be of two kinds.
    """
    with _readable(path):
        form = read_form(target, len(layout.sizes))
    unlike = _unlike(form, layout, path)
    if unlike is None:
        with _readable(path):
            require_arrays(form, layout.sizes, layout.layers, layout.coordinates)
            found = Store.at(target, mode)
            unlike = _unlike_values(found, form, layout)
        if unlike is None:
            return replace(found, path=path)
    kind = "map" if "cointoss_map" in layout.attributes else "store of tosses"
    raise UnwritableError(f"{path}: is a {kind} with another {unlike}; {_WAYS_OUT}")


def _unlike(form: StoreForm, layout: Layout, path: Path) -> str | None:
    """Return how a store's description differs from a layout, in words; None where it does not."""
    stored, due = form.attributes, layout.attributes
    try:
        same_scenario = parse(stored["scenario"], str(path)) == parse(due["scenario"], str(path))
    except ScenarioError:
        same_scenario = False
    if not same_scenario:
        return "scenario"
    others = (stored.keys() | due.keys()) - {"scenario", "versions", "name"}
    for name in [*_CALLED, *sorted(others)]:
        if stored.get(name) != due.get(name):
            value = f", {json.dumps(stored.get(name))}" if name == "engine_settings" else ""
            return f"{_CALLED.get(name, name)}{value}"
    if grids := [one.dims[0] for field, one in layout.coordinates.items() if not form.has(field, one)]:
        return f"grid in {grids[-1]}"
    arrays = sorted(form.arrays.keys() ^ {*layout.layers, *layout.coordinates})
    return f"set of arrays, for {', '.join(arrays)}" if arrays else None


def _unlike_values(found: Store, form: StoreForm, layout: Layout) -> str | None:
    """Return which values or versions of a store differ from those of a layout; None where none do."""
    for field, one in reversed(layout.coordinates.items()):
        if not np.array_equal(found.whole(field), one.values, equal_nan=one.values.dtype.kind == "f"):
            return f"grid in {one.dims[0]}"
    made_by, ours = (
        {name: one for name, one in each["versions"].items() if name not in _READERS}
        for each in (form.attributes, layout.attributes)
    )
    return None if made_by == ours else f"set of versions, {json.dumps(made_by)}"


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
    """Keep a map for this process; the system releases the map when the process ends, however it ends.

    The lock is a file beside the map: inside, it would be a foreign file, and Windows renames no open folder.
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
    """Remove a lock's file while the lock is held; Windows removes it when the lock is released."""
    with suppress(OSError):
        lock.unlink()


def _remove(target: Path) -> None:
    """Remove a map; renamed first, so that no half of it is left under its name."""
    aside = beside(target)
    with undoing(lambda: remove(aside)):
        target.rename(aside)
