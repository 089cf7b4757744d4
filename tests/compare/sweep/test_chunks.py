"""Chunks of a map from a stranger: none is decoded whose size is not the one that it must have."""

import numcodecs
import numcodecs.abc
import numpy as np
import pytest

import cointoss
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import grid
from cointoss.compare.sweep.layout import layout_of_map
from cointoss.compare.sweep.reading import tossed_map_at
from cointoss.compare.sweep.store import opened
from tests.helpers.basin_runs import SCENARIO, sweep_of
from tests.helpers.strange_maps import AXES, CHUNKS, GIGABYTES, X, Y, is_refused


def frame(size, length=8):
    """Return the beginning of a Zstandard frame that says that it holds so many bytes."""
    flags = {0: 0x00, 2: 0x60, 4: 0xA0, 8: 0xE0}[length]
    window = b"\x58" if length == 0 else b""
    return b"\x28\xb5\x2f\xfd" + bytes([flags]) + window + size.to_bytes(length, "little")


def bombs(size):
    """Return chunks that decode to more than `size` bytes, or to nobody knows how many."""
    pack = numcodecs.Zstd(checksum=True).encode
    return {
        "says so": frame(GIGABYTES) + b"\x01\x00\x00",
        "packed": pack(bytes(size + (1 << 24))),
        "does not say": frame(0, length=0) + b"\x01\x00\x00",
        "too long": pack(bytes(size)) + bytes(2 * size + 1024),
        "another": pack(bytes(size - 1)),
        "skipped": b"\x50\x2a\x4d\x18\x04\x00\x00\x00abcd" + pack(bytes(size)),
        "empty": b"",
        "short": frame(size)[:8],
    }


@pytest.fixture
def decoded(monkeypatch):
    """The chunks that are decoded."""
    given, decode = [], numcodecs.zstd.Zstd.decode
    monkeypatch.setattr(
        numcodecs.zstd.Zstd, "decode", lambda codec, buf: given.append(bytes(buf)) or decode(codec, buf)
    )
    return given


@pytest.mark.parametrize("kind", bombs(100))
def test_a_chunk_that_decodes_to_another_size_is_not_decoded(path, decoded, kind):
    (path / X / CHUNKS[X]).write_bytes(bombs(96)[kind])
    is_refused(path, f"{X}/c/0: does not decode to 96 bytes")
    assert not decoded


@pytest.mark.parametrize("name", CHUNKS)
def test_values_that_are_lost_are_no_zeros(path, name):
    """Zarr reads what is lost as its fill value; of a tile, that is one not tossed yet."""
    (path / name / CHUNKS[name]).unlink()
    if name in (X, Y):
        is_refused(path, f"({name}/c/0: lost)")
    else:
        assert set(cointoss.read_map(path).cointoss.counts) == {"not_tossed"}


@pytest.mark.parametrize("kind", bombs(100))
@pytest.mark.parametrize("name", ["outcome", "impacts", "margin"])
def test_a_tile_that_decodes_to_another_size_is_not_tossed_yet(path, decoded, name, kind):
    bomb = bombs(120 * {"outcome": 1, "impacts": 4, "margin": 8}[name])[kind]
    (path / name / CHUNKS[name]).write_bytes(bomb)
    assert set(cointoss.read_map(path).cointoss.counts) == {"not_tossed"}
    assert decoded
    assert bomb not in decoded


def test_a_second_frame_is_not_decoded(path):
    pack = numcodecs.Zstd(checksum=True).encode
    whole = pack(bytes(120))
    (path / "outcome" / CHUNKS["outcome"]).write_bytes(whole)
    assert set(cointoss.read_map(path).cointoss.counts) == {"undecided"}
    (path / "outcome" / CHUNKS["outcome"]).write_bytes(whole + pack(bytes(1 << 20)))
    assert set(cointoss.read_map(path).cointoss.counts) == {"not_tossed"}


@pytest.mark.parametrize("tile", [25, 1 << 14])
def test_maps_of_all_tiles_are_read(tmp_path, monkeypatch, tile):
    monkeypatch.setitem(grid.TILE_TOSSES, Engine.ANALYTIC, tile)
    sweep = sweep_of(*AXES, after=3)
    with opened(tmp_path / "map.zarr", layout_of_map(sweep, SCENARIO), overwrite=False) as map_:
        for number, part in enumerate(map_.tiles):
            numbers = map_.missing(part)
            filled = np.full(len(numbers), number % 5)
            map_.write(numbers, {"outcome": filled.astype(np.int8), "impacts": filled.astype(np.int32)})
    read = tossed_map_at(tmp_path / "map.zarr")
    assert read.sweep == sweep
    assert -1 not in read.outcome
