"""A map from a stranger: what cointoss did not write is refused in one line, and nothing of it is run."""

import json
import os
import pickle
import shutil
from functools import partial

import numcodecs
import numcodecs.abc
import numpy as np
import pytest

import cointoss
from tests.helpers.command_line import refused
from tests.helpers.pickles import Runs
from tests.helpers.strange_maps import (
    CHUNKS,
    GIGABYTES,
    X,
    Y,
    asked_of,
    described,
    not_read,
    regular,
    rewritten,
)


def in_format_2(path):
    """Replace the arrays by those of Zarr's format 2, a chunk of which makes a folder if unpickled."""
    for name, count in ((X, 12), (Y, 10)):
        shutil.rmtree(path / name)
        (path / name).mkdir()
        array = {"zarr_format": 2, "shape": [count], "chunks": [count], "fill_value": 0.0, "order": "C"}
        array |= {"dtype": "|O", "compressor": None, "filters": [{"id": "vlen-utf8"}, {"id": "pickle"}]}
        (path / name / ".zarray").write_text(json.dumps(array))
        (path / name / "0").write_bytes(pickle.dumps(Runs(path.parent / "run")))
    (path / ".zgroup").write_text('{"zarr_format": 2}')


@pytest.mark.parametrize(("beside", "said"), [(True, "lost"), (False, "is no map of cointoss")])
def test_a_codec_that_runs_what_it_decodes_is_not_run(path, beside, said):
    in_format_2(path)
    if not beside:  # a description of format 3
        (path / "zarr.json").unlink()
    not_read(path, said)
    assert "accepted" in refused(*asked_of(path, "--margin", "height", "--resume"))
    assert not (path.parent / "run").exists()


BYTES = {"name": "bytes", "configuration": {"endian": "little"}}
ZSTD = {"name": "zstd", "configuration": {"level": 0, "checksum": True}}
SHARDS = {
    "name": "sharding_indexed",
    "configuration": {"chunk_shape": [1], "codecs": [BYTES], "index_codecs": [BYTES]},
}
CODECS = {
    "pickle": [{"name": "numcodecs.pickle", "configuration": {}}],
    "pickle after bytes": [BYTES, {"name": "numcodecs.pickle"}],
    "module": [{"name": "os.system", "configuration": {"command": "true"}}],
    "text": [{"name": "vlen-utf8"}, ZSTD],
    "shards": [SHARDS],
    "gzip": [BYTES, {"name": "gzip", "configuration": {"level": 1}}],
    "blosc": [BYTES, {"name": "blosc", "configuration": {"cname": "lz4"}}],
    "delta": [{"name": "numcodecs.delta", "configuration": {"dtype": "<f8"}}, BYTES, ZSTD],
    "transposed": [{"name": "transpose", "configuration": {"order": [0]}}, BYTES, ZSTD],
    "twice packed": [BYTES, ZSTD, ZSTD],
    "not packed": [BYTES],
    "more settings": [BYTES, {"name": "zstd", "configuration": {**ZSTD["configuration"], "id": "pickle"}}],
    "none": [],
    "nothing": None,
}
"""What numbers may not be decoded by, which would do harm or take any size."""


def outside(path, file):
    """Move a file or a folder out of the map, and link to it."""
    (path / file).symlink_to((path / file).rename(path.parent / "elsewhere"))


def piped(path, file):
    (path / file).unlink()
    os.mkfifo(path / file)


def said(**attributes):
    """Return what changes the attributes of a map."""
    return lambda path: rewritten(path, lambda all_: all_["attributes"].update(attributes))


def lacking(*names):
    """Return what takes an entry out of the description of a map."""

    def take(all_):
        for name in names[:-1]:
            all_ = all_[name]
        del all_[names[-1]]

    return lambda path: rewritten(path, take)


NO_MAP = "is no map of cointoss ("
STRANGE = {
    **{
        f"{kind}, {name}": (NO_MAP, partial(described, name=name, codecs=codecs))
        for kind, codecs in CODECS.items()
        for name in (X, "outcome")
    },
    "text": (NO_MAP, lambda path: described(path, X, data_type="string")),
    "dates": (NO_MAP, lambda path: described(path, X, data_type="numpy.datetime64")),
    "long axis": (NO_MAP, lambda path: described(path, X, shape=[GIGABYTES], chunk_grid=regular(GIGABYTES))),
    "large map": ("pixels; accepted", lambda path: described(path, "outcome", shape=[GIGABYTES, GIGABYTES])),
    "another map": (NO_MAP, lambda path: described(path, "impacts", shape=[10, 11])),
    "large chunk": ("chunks of", lambda path: described(path, X, chunk_grid=regular(GIGABYTES))),
    "large tile": ("chunks of", lambda path: described(path, "outcome", chunk_grid=regular(GIGABYTES, 12))),
    "large layer": (
        "chunks of",
        lambda path: described(path, "impacts", shape=[10, 13], chunk_grid=regular(10, 13)),
    ),
    "longer axis": ("chunks of", lambda path: described(path, X, shape=[121], chunk_grid=regular(121))),
    "wide numbers": (
        "chunks of",
        lambda path: described(
            path,
            "impacts",
            data_type={"name": "null_terminated_bytes", "configuration": {"length_bytes": 9}},
            fill_value="",
        ),
    ),
    "negative": (NO_MAP, lambda path: described(path, X, shape=[-1])),
    "two axes": (NO_MAP, lambda path: described(path, X, shape=[3, 4])),
    "grid": (NO_MAP, lambda path: described(path, X, chunk_grid={"name": "rectilinear"})),
    "keys": ("0: lost", lambda path: described(path, X, chunk_key_encoding={"name": "v2"})),
    "format": (NO_MAP, lambda path: described(path, X, zarr_format=2)),
    "group": (NO_MAP, lambda path: described(path, X, node_type="group")),
    "dimension": (NO_MAP, lambda path: described(path, X, dimension_names=["z"])),
    "same dimension": (NO_MAP, lambda path: described(path, X, dimension_names=["y"])),
    "no outcome": ("array outcome missing", lacking("consolidated_metadata", "metadata", "outcome")),
    "no margin": ("margin", lacking("consolidated_metadata", "metadata", "margin")),
    "no axis": (NO_MAP, lacking("consolidated_metadata", "metadata", X)),
    "no consolidated": ("zarr.json: no consolidated_metadata, as", lacking("consolidated_metadata")),
    "format 9": (NO_MAP, lambda path: rewritten(path, lambda all_: all_.update(zarr_format=9))),
    "nothing": (NO_MAP, lambda path: (path / "zarr.json").write_text("{}")),
    "a broken description": (NO_MAP, lambda path: (path / "zarr.json").write_text("{")),
    "a deep one": (NO_MAP, lambda path: (path / "zarr.json").write_text(500_000 * "[" + 500_000 * "]")),
    "a long one": ("more than", lambda path: (path / "zarr.json").write_bytes(b" " * (2 << 20))),
    "a linked one": ("zarr.json: neither a", lambda path: outside(path, "zarr.json")),
    "a linked array": (f"{X}: neither a", lambda path: outside(path, X)),
    "linked chunks": ("outcome/c: neither a", lambda path: outside(path, "outcome/c")),
    "a linked chunk": ("outcome/c/0/0: neither a", lambda path: outside(path, "outcome/c/0/0")),
    "a link to nothing": ("more: neither a", lambda path: (path / "more").symlink_to("/nowhere")),
    "a pipe": ("outcome/c/0/0: neither a", lambda path: piped(path, "outcome/c/0/0")),
    "a pipe that describes": ("zarr.json: neither a", lambda path: piped(path, "zarr.json")),
    "engine": ("(engine: 'abacus', accepted: analytic, mujoco)", said(engine="abacus")),
    "no engine": ("attribute engine = None", lacking("attributes", "engine")),
    "after": ('attribute after = "two"', said(after="two")),
    "scenario": ("gravity = -1: accepted: a number", said(scenario="gravity = -1")),
    "no scenario": ("attribute scenario = 7", said(scenario=7)),
    "settings": ("(contact_steps: given -1", said(engine_settings={"contact_steps": -1})),
    "many steps": ("(contact_steps = 1000", said(engine_settings={"contact_steps": 10**30})),
    "a text in settings": (NO_MAP, said(engine_settings={"contact_tolerance": "1"})),
    "a list of settings": ("attribute engine_settings = ", said(engine_settings=[])),
    "margin": (NO_MAP, said(margin_along=7)),
    "another format": ("(attribute cointoss_map = 2, not 1)", said(cointoss_map=2)),
    "versions": ('attribute versions = "1"', said(versions="1")),
}


@pytest.mark.filterwarnings("ignore:Numcodecs codecs are not in the Zarr")
@pytest.mark.parametrize("name", STRANGE)
def test_a_map_that_is_not_ours_is_refused(path, name):
    what, change = STRANGE[name]
    change(path)
    not_read(path, what)
    assert "accepted: " in refused(*asked_of(path, "--margin", "height", "--resume"))


@pytest.mark.parametrize("name", ["a pipe that describes", "a deep one", "a long one"])
def test_what_describes_no_map_is_not_replaced(path, name):
    STRANGE[name][1](path)
    why = "is no map; accepted: a new name, or a map of cointoss"
    assert refused(*asked_of(path, "--overwrite")) == f"cointoss: {path}: {why}\n"


def test_tiles_without_number_are_refused_at_once(path):
    for name, ends in ((X, (20, 60)), (Y, (0.2, 0.6))):
        described(path, name, shape=[5_000], chunk_grid=regular(5_000))
        values = np.linspace(*ends, 5_000)
        (path / name / CHUNKS[name]).write_bytes(numcodecs.Zstd(checksum=True).encode(values.tobytes()))
    for name in ("outcome", "impacts", "margin"):
        described(path, name, shape=[5_000, 5_000], chunk_grid=regular(1, 1))
    not_read(path, "has tiles of 1 by 1 pixels; accepted: a map of at most 1e+06 tiles")


def test_what_lies_beside_the_arrays_is_not_looked_at(path):
    before = cointoss.read_map(path)
    (path / "README.txt").write_text("a map of mine")
    (path / X / ".zarray").write_text("{")
    (path / "more").mkdir()
    (path / "more" / "zarr.json").write_text("{")
    assert cointoss.read_map(path).identical(before)


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
        "second frame": pack(bytes(size)) + pack(os.urandom(1 << 16)),
        "another": pack(bytes(size - 1)),
        "skipped": b"\x50\x2a\x4d\x18\x04\x00\x00\x00abcd" + pack(bytes(size)),
        "empty": b"",
        "short": frame(size)[:8],
    }


@pytest.mark.parametrize("kind", bombs(100))
@pytest.mark.parametrize(("name", "size"), [(X, 96), ("outcome", 120), ("impacts", 480), ("margin", 960)])
def test_a_chunk_that_decodes_to_another_size_is_not_decoded(path, monkeypatch, name, size, kind):
    bomb, given, decode = bombs(size)[kind], [], numcodecs.zstd.Zstd.decode
    monkeypatch.setattr(
        numcodecs.zstd.Zstd, "decode", lambda codec, buf: given.append(bytes(buf)) or decode(codec, buf)
    )
    (path / name / CHUNKS[name]).write_bytes(bomb)
    not_read(path, f"({name}/{CHUNKS[name]}: does not decode to {size} bytes)")
    assert bomb not in given


@pytest.mark.parametrize("name", CHUNKS)
def test_values_that_are_lost_are_no_zeros(path, name):
    """Zarr reads what is lost as its fill value; an outcome that is not there is one not tossed yet."""
    (path / name / CHUNKS[name]).unlink()
    if name == "outcome":
        assert set(cointoss.read_map(path).cointoss.counts) == {"not_tossed"}
    else:
        not_read(path, f"({name}/{CHUNKS[name]}: lost)")
