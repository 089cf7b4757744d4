"""Tosses on disk: a Zarr store that is filled tile by tile, by one process at a time."""

import json
import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any, Literal

import numpy as np
import zarr
from filelock import FileLock, Timeout
from numpy.typing import NDArray
from zarr.codecs import ZstdCodec
from zarr.errors import ZarrUserWarning

from cointoss.compare.output.files import UnwritableError, aside_in, naming, written_whole
from cointoss.compare.output.interruption import saying
from cointoss.compare.sweep.axes import NUMBERS
from cointoss.compare.sweep.chunks import (
    DESCRIPTION,
    DamagedError,
    is_map,
    require_array,
    require_chunk,
    require_plain,
)
from cointoss.compare.sweep.layout import (
    LAYERS,
    MARGIN_ALONG,
    TRUST,
    Layout,
    holds_tosses,
    numbers_in,
    tiles,
)
from cointoss.compare.sweep.pieces import Columns
from cointoss.models.errors import ScenarioError
from cointoss.models.fields import FIELDS
from cointoss.models.reading import parse
from cointoss.models.stages import stage

Numbers = NDArray[np.intp]
Tosser = Callable[[Iterable[Numbers]], Iterator[tuple[Numbers, Columns]]]
"""Makes the tosses with these numbers, each part within a tile, and yields the parts, whole or cut, in any
order."""
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
_NAMES = {*LAYERS, *NUMBERS, *FIELDS}
"""What an array of a store may be called."""


@dataclass(frozen=True, kw_only=True)
class Store:
    """A store on disk whose arrays are decoded by our codecs alone."""

    path: Path
    attributes: dict[str, Any]
    arrays: dict[str, Any]
    """The arrays of Zarr by name, of those that may be a store's."""

    @classmethod
    def at(cls, path: Path, mode: Literal["r", "r+"]) -> "Store":
        """Open a store for reading alone or to be filled; Zarr raises errors of any kind.

        Raises:
            DamagedError: naming a file or an array that is not as in a store of cointoss.
        """
        require_plain(path)
        group = zarr.open_group(path, mode=mode, zarr_format=3)
        if group.metadata.consolidated_metadata is None:
            raise DamagedError(f"{DESCRIPTION}: no consolidated_metadata, as in a store of tosses of 0.1.0")
        arrays = {name: array for name, array in group.arrays() if name in _NAMES}
        if "outcome" not in arrays:
            raise DamagedError("array outcome missing")
        for name, array in arrays.items():
            require_array(name, array, math.prod(arrays["outcome"].shape))
        return cls(path=path, attributes=dict(group.attrs), arrays=arrays)

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of its dimensions."""
        return self.arrays["outcome"].shape

    @property
    def tiles(self) -> list[tuple[slice, ...]]:
        """All tiles."""
        return list(tiles(self.shape, self.arrays["outcome"].chunks))

    @property
    def layers(self) -> list[str]:
        """The names of what is known of each toss."""
        return [name for name in LAYERS if name in self.arrays]

    @property
    def is_whole(self) -> bool:
        """Whether every tile was tossed, and none is damaged."""
        return not any(self.missing(tile).size for tile in self.tiles)

    def tossed(self, tile: tuple[slice, ...]) -> NDArray[np.bool_]:
        """Return what of a tile is on disk, over the tile.

        Raises:
            DamagedError: naming a file that does not hold what it should.
        """
        if not all((self.path / file).exists() for file in self._files("outcome", tile)):
            return np.zeros([part.stop - part.start for part in tile], dtype=bool)
        parts = [holds_tosses(name, self.read(tile, name)) for name in self.layers]
        for name, holds in zip(self.layers, parts, strict=True):
            lost = [file for file in self._files(name, tile) if not (self.path / file).exists()]
            if lost and not holds.any():  # the outcome is written last
                raise DamagedError(f"{lost[0]}: lost")
        return np.logical_and.reduce(parts)

    def missing(self, tile: tuple[slice, ...]) -> NDArray[np.intp]:
        """Return the numbers of what of a tile is not on disk, or damaged, in the order of a C array."""
        try:
            there = self.tossed(tile)
        except DamagedError:
            there = False
        numbers = numbers_in(tile, self.shape)
        return numbers[~np.broadcast_to(there, numbers.shape)]

    def read(self, part: tuple[slice, ...], name: str = "outcome") -> NDArray[Any]:
        """Return a part of an array, such as a tile; where a file is not there, what stands for no toss.

        Raises:
            DamagedError: naming the file, also of a coordinate that is not there.
        """
        array, file = self.arrays[name], Path(name)
        try:
            for file in self._files(name, part):
                if name not in LAYERS or (self.path / file).exists():
                    require_chunk(self.path / file, array.dtype.itemsize * math.prod(array.chunks))
            return array[part]
        except FileNotFoundError:
            raise DamagedError(f"{file}: lost") from None
        except OSError:
            raise
        except (
            Exception
        ) as error:  # a checksum is wrong, or a file breaks off; each codec fails in its own way
            raise DamagedError(f"{file}: {error}") from None

    def whole(self, name: str) -> NDArray[Any]:
        """Return all values of an array, or of a coordinate by its field."""
        return self.read(tuple(slice(0, count) for count in self.arrays[name].shape), name)

    def counts(self, name: str, most: int) -> NDArray[np.int64]:
        """Return how often an array has 0, 1, ..., without the whole array in memory, (most,).

        Args:
            name: of an array of whole numbers.
            most: different numbers; a larger one, as a stranger may have made, counts as the last.
        """
        parts = (np.minimum(self.read(tile, name).ravel(), most - 1) for tile in self.tiles)
        return sum((np.bincount(part, minlength=most) for part in parts), np.zeros(most, dtype=np.int64))

    def write(self, numbers: NDArray[np.intp], layers: Columns) -> None:
        """Keep what is known of a tile, or of a part of one.

        Args:
            numbers: of the tosses, in one tile.
            layers: by name, (n,) each; those are kept that the store has.

        Raises:
            UnwritableError: naming the store and why, for every error of the system.
        """
        at = np.unravel_index(numbers, self.shape)
        lengths = self.arrays["outcome"].chunks
        tile = tuple(
            slice(one[0] // length * length, min((one[0] // length + 1) * length, size))
            for one, length, size in zip(at, lengths, self.shape, strict=True)
        )
        inside = tuple(one - part.start for one, part in zip(at, tile, strict=True))
        with naming(self.path):
            # The outcome last: where it is, the tile is whole.
            for name in sorted(self.layers, key=lambda name: name == "outcome"):
                self._put(name, tile, inside, layers[name])

    def _put(self, name: str, tile: tuple[slice, ...], inside: tuple[Any, ...], values: NDArray[Any]) -> None:
        """Write a part of a tile; a file around it that is damaged holds nothing else."""
        array = self.arrays[name]
        shape = [part.stop - part.start for part in tile]
        known = np.full(shape, array.fill_value, array.dtype)
        if len(values) < math.prod(shape):
            with suppress(DamagedError):
                known = self.read(tile, name)
        known[inside] = values
        array[tile] = known

    def _files(self, name: str, part: tuple[slice, ...]) -> Iterator[Path]:
        """Yield the files of the chunks of a part of an array, as they are named in the store."""
        array = self.arrays[name]
        spans = zip(part, array.chunks, strict=True)
        for place in product(*(range(one.start // side, -(-one.stop // side)) for one, side in spans)):
            yield Path(name, array.metadata.encode_chunk_key(place))


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
            with aside_in(target.parent):
                pass
        elif not is_map(target):
            raise UnwritableError(f"{path}: is no map; accepted: a new name, or a map of cointoss")
        elif not (resume or overwrite):
            raise UnwritableError(
                f"{path}: exists; accepted: a new name, `resume` to continue it, or `overwrite` to replace it"
            )
        elif overwrite and (foreign := {one.name for one in target.iterdir()} - {DESCRIPTION, *_NAMES}):
            raise UnwritableError(
                f"{path}: holds {min(foreign)}, which is no part of a map; accepted: a new name"
            )


def there(path: Path, layout: Layout) -> Store | None:
    """Return the store at a path, to be read, if there is one.

    Raises:
        UnwritableError: naming the path and what is not the same, for one of another layout.
    """
    with naming(path):
        target = Path(os.path.realpath(path))
        return _same(path, target, "r", layout) if is_map(target) else None


@contextmanager
def opened(path: Path, layout: Layout, *, overwrite: bool) -> Iterator[Store]:
    """Open a store for this process alone: a new one, or what is there of it; a whole one is only read.

    Args:
        path: of the store; checked by `require_place`.
        layout: what it is made of.
        overwrite: whether a store that is there is replaced.

    Raises:
        UnwritableError: naming the path and why: another process is at it, or it is another one.
    """
    target = Path(os.path.realpath(path))
    if not overwrite and (found := there(path, layout)) is not None and found.is_whole:
        yield found
        return
    with ExitStack() as kept:
        with naming(path):
            kept.enter_context(_locked(path, target))
            if overwrite and is_map(target):
                with aside_in(target.parent) as aside:  # so that no half of it is left under its name
                    target.rename(aside / target.name)
            if not is_map(target):
                with written_whole(target) as aside:
                    _write_empty(aside, layout)
            store = _same(path, target, "r+", layout)
            for left in target.rglob("*.partial"):  # by a process that was killed
                left.unlink()
        yield store


def fill(store: Store, tosser: Tosser, *, shown: bool | None = None) -> None:
    """Toss what a store lacks and keep each part as soon as it is tossed; an interruption says what is kept.

    Raises:
        UnwritableError: naming the store and why.
        ScenarioError, UnsupportedError: for what can't be tossed.
    """
    whole, name = math.prod(store.shape), store.path.name
    left = [tile for tile in store.tiles if store.missing(tile).size]
    kept = whole - sum(int(store.missing(tile).size) for tile in left)
    with (
        saying(lambda _: f"{name}: {kept} of {whole} tosses are saved; `resume` continues"),
        stage(name, "tosses", total=whole, done=kept, shown=shown) as progress,
    ):
        for numbers, layers in tosser(map(store.missing, left)):
            store.write(numbers, layers)
            kept += len(numbers)
            progress(kept, whole)


def _write_empty(folder: Path, layout: Layout) -> None:
    group = zarr.create_group(folder, zarr_format=3, attributes=layout.attributes)
    for name, layer in layout.layers.items():
        group.create_array(
            name,
            shape=layout.batch.shape,
            chunks=layout.tile,
            dtype=layer.kind,
            fill_value=layer.missing,
            dimension_names=list(layout.batch.sizes),
            # A tile that breaks off must not pass for one.
            compressors=ZstdCodec(checksum=True),
            attributes={**layer.attributes, "coordinates": " ".join(layout.batch.coordinates)},
        )
    for field, (dims, values, attributes) in layout.batch.coordinates.items():
        group.create_array(
            field,
            data=values,
            chunks=values.shape,
            # Zeros are the fill value, and a file that is not there is one that was lost.
            config={"write_empty_chunks": True},
            compressors=ZstdCodec(checksum=True),
            dimension_names=list(dims),
            attributes=attributes,
        )
    # Not yet in the specification of Zarr 3, but xarray asks for it.
    with warnings.catch_warnings(action="ignore", category=ZarrUserWarning):
        zarr.consolidate_metadata(group.store)


def _same(path: Path, target: Path, mode: Literal["r", "r+"], layout: Layout) -> Store:
    """Open a store of this layout.

    A store of another layout or of other versions raises an error: its tosses would be of two kinds.
    """
    try:
        found = Store.at(target, mode)
        unlike = _unlike(found, layout, path)
    except Exception as error:  # zarr raises errors of any kind
        if isinstance(error, OSError) and error.errno is not None:  # of the system; zarr's own have no number
            raise
        raise UnwritableError(f"{path}: is no map of cointoss ({error}); {_WAYS_OUT}") from None
    if unlike is None:
        return replace(found, path=path)
    kind = "map" if "cointoss_map" in layout.attributes else "store of tosses"
    raise UnwritableError(f"{path}: is a {kind} with another {unlike}; {_WAYS_OUT}")


def _unlike(found: Store, layout: Layout, path: Path) -> str | None:
    """Return how a store differs from a layout, in words; None where it does not."""
    stored, due = found.attributes, layout.attributes
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
    for field, (dims, values, _) in reversed(layout.batch.coordinates.items()):
        array = found.arrays.get(field)
        is_same = array is not None and _shape_of(array) == (values.shape, values.dtype, dims)
        if not (is_same and np.array_equal(found.whole(field), values, equal_nan=values.dtype.kind == "f")):
            return f"grid in {dims[0]}"
    shape, dims = layout.batch.shape, tuple(layout.batch.sizes)
    arrays = {name: (shape, np.dtype(layer.kind), dims) for name, layer in layout.layers.items()}
    there = {
        name: _shape_of(found.arrays[name]) for name in found.arrays.keys() - layout.batch.coordinates.keys()
    }
    if wrong := sorted(name for name in arrays | there if arrays.get(name) != there.get(name)):
        return f"set of arrays, for {', '.join(wrong)}"
    made_by, ours = (
        {name: one for name, one in each["versions"].items() if name not in _READERS}
        for each in (stored, due)
    )
    return None if made_by == ours else f"set of versions, {json.dumps(made_by)}"


def _shape_of(array: Any) -> tuple[tuple[int, ...], np.dtype[Any], tuple[str, ...] | None]:
    """Return the shape, the type and the dimensions of an array of Zarr."""
    return array.shape, array.dtype, array.metadata.dimension_names


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
        try:
            yield
        finally:
            # While the lock is held; Windows removes its file when it is released.
            with suppress(OSError):
                lock.unlink()
