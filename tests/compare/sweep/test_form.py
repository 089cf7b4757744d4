"""A map from a stranger: what cointoss did not write is refused in one line before anything is decoded."""

import json
import os
import pickle
import shutil
from typing import Any

import numcodecs
import numcodecs.abc
import numpy as np
import pytest
import zarr

from cointoss.compare.sweep.reading import tossed_map_at
from tests.helpers.command_line import refused
from tests.helpers.pickles import Runs
from tests.helpers.strange_maps import AXES, CHUNKS, GIGABYTES, NO_MAP, X, Y, described, is_refused, regular


@pytest.fixture
def opened_by_zarr(monkeypatch):
    """The folders that Zarr is asked to open."""
    asked, open_group = [], zarr.open_group
    monkeypatch.setattr(zarr, "open_group", lambda *a, **k: asked.append(a) or open_group(*a, **k))
    return asked


class Unpickler(numcodecs.abc.Codec):
    """A codec that runs what it decodes, as those of any package may that is installed."""

    codec_id = "unpickler"

    def encode(self, buf):
        return buf

    def decode(self, buf, out=None):
        return pickle.loads(bytes(buf)) if out is None else out


def in_format_2(path, **codecs):
    """Replace a map by one of Zarr's format 2 whose first chunk is a pickle that makes a folder."""
    attributes = json.loads((path / "zarr.json").read_text())["attributes"]
    shutil.rmtree(path)
    for name, count in ((X, 12), (Y, 10)):
        (path / name).mkdir(parents=True)
        array = {"zarr_format": 2, "shape": [count], "chunks": [count], "fill_value": 0.0, "order": "C"}
        array |= {"dtype": "<f8", "filters": None, "compressor": None, **codecs}
        (path / name / ".zarray").write_text(json.dumps(array))
        (path / name / ".zattrs").write_text("{}")
        (path / name / "0").write_bytes(pickle.dumps(Runs(path.parent / "run")))
    (path / ".zgroup").write_text('{"zarr_format": 2}')
    (path / ".zattrs").write_text(json.dumps(attributes))


@pytest.mark.parametrize(
    "codecs",
    [
        {"compressor": {"id": "unpickler"}},
        {"compressor": {"id": "pickle"}},
        {"dtype": "|O", "filters": [{"id": "vlen-utf8"}, {"id": "pickle"}]},
    ],
)
@pytest.mark.parametrize("beside", [False, True])
def test_a_codec_that_runs_what_it_decodes_is_not_run(path, opened_by_zarr, codecs, beside):
    numcodecs.register_codec(Unpickler)
    described = (path / "zarr.json").read_bytes()
    in_format_2(path, **codecs)
    run = path.parent / "run"
    if codecs == {"compressor": {"id": "unpickler"}}:
        group: Any = zarr.open_group(path, mode="r")
        with pytest.raises(Exception, match=r".*"):
            group[X][:]
        assert run.exists(), "the folder does no harm where Zarr alone opens it"
        run.rmdir()
        opened_by_zarr.clear()
    if beside:  # a description of format 3
        (path / "zarr.json").write_bytes(described)
    assert ("is no map of cointoss" if beside else "is no map;") in is_refused(path)
    assert not run.exists()
    assert not opened_by_zarr


BYTES = {"name": "bytes", "configuration": {"endian": "little"}}
ZSTD = {"name": "zstd", "configuration": {"level": 0, "checksum": True}}
SHARDS = {
    "name": "sharding_indexed",
    "configuration": {"chunk_shape": [1], "codecs": [BYTES], "index_codecs": [BYTES]},
}
CODECS = {
    "pickle": [{"name": "numcodecs.pickle", "configuration": {}}],
    "pickle after bytes": [BYTES, {"name": "numcodecs.pickle"}],
    "unpickler": [BYTES, {"name": "unpickler"}],
    "module": [{"name": "os.system", "configuration": {"command": "true"}}],
    "json": [{"name": "numcodecs.json2"}],
    "text": [{"name": "vlen-utf8"}, ZSTD],
    "shards": [SHARDS],
    "gzip": [BYTES, {"name": "gzip", "configuration": {"level": 1}}],
    "blosc": [BYTES, {"name": "blosc", "configuration": {"cname": "lz4"}}],
    "transposed": [{"name": "transpose", "configuration": {"order": [0]}}, BYTES, ZSTD],
    "twice packed": [BYTES, ZSTD, ZSTD],
    "big-endian": [{"name": "bytes", "configuration": {"endian": "big"}}, ZSTD],
    "more settings": [BYTES, {"name": "zstd", "configuration": {**ZSTD["configuration"], "id": "pickle"}}],
    "by name alone": ["bytes", "zstd"],
    "none": [],
    "nothing": None,
}


@pytest.mark.parametrize("codecs", CODECS.values(), ids=CODECS.keys())
@pytest.mark.parametrize("name", [X, "outcome"])
def test_codecs_that_are_not_ours_are_refused(path, opened_by_zarr, name, codecs):
    described(path, name)(codecs=codecs)
    assert f"array {name}: codecs " in is_refused(path, f"array {name}: codecs ")
    assert not opened_by_zarr


ENTRIES = {
    "text": (X, {"data_type": "string"}),
    "object": (X, {"data_type": "object"}),
    "structure": (X, {"data_type": {"name": "structured", "configuration": {"fields": []}}}),
    "dates": (X, {"data_type": "numpy.datetime64"}),
    "single": (Y, {"data_type": "float32"}),
    "wide": ("outcome", {"data_type": "int16"}),
    "long axis": (X, {"shape": [GIGABYTES], "chunk_grid": regular(GIGABYTES)}),
    "large map": ("outcome", {"shape": [GIGABYTES, GIGABYTES]}),
    "another map": ("impacts", {"shape": [10, 11]}),
    "large chunk of an axis": (X, {"chunk_grid": regular(GIGABYTES)}),
    "large tile": ("outcome", {"chunk_grid": regular(GIGABYTES, 12)}),
    "negative": (X, {"shape": [-1]}),
    "none": (X, {"shape": [0]}),
    "one value": (X, {"shape": [1], "chunk_grid": regular(1)}),
    "true": (X, {"shape": [True], "chunk_grid": regular(True)}),
    "fraction": (X, {"shape": [12.0]}),
    "two axes": (X, {"shape": [3, 4]}),
    "grid": (X, {"chunk_grid": {"name": "rectilinear"}}),
    "keys": (X, {"chunk_key_encoding": {"name": "v2", "configuration": {"separator": "."}}}),
    "separator": (X, {"chunk_key_encoding": {"name": "default", "configuration": {"separator": "/../"}}}),
    "transformers": (X, {"storage_transformers": [{"name": "pickle"}]}),
    "format": (X, {"zarr_format": 2}),
    "group": (X, {"node_type": "group"}),
    "dimension": (X, {"dimension_names": ["z"]}),
    "same dimension": (X, {"dimension_names": ["y"]}),
    "fill": ("outcome", {"fill_value": 1}),
    "more": (X, {"must_understand": False}),
    "scaled": ("outcome", {"attributes": {"scale_factor": 2}}),
}


@pytest.mark.parametrize(("name", "entries"), ENTRIES.values(), ids=ENTRIES.keys())
def test_arrays_that_are_not_ours_are_refused(path, opened_by_zarr, name, entries):
    described(path, name)(**entries)
    is_refused(path)
    assert not opened_by_zarr


def outside(path, file):
    """Move a file or a folder out of the map, and link to it."""
    target = path.parent / "elsewhere"
    (path / file).rename(target)
    (path / file).symlink_to(target)


def piped(path, file):
    (path / file).unlink()
    os.mkfifo(path / file)


def rewritten(path, change):
    whole = json.loads((path / "zarr.json").read_text())
    change(whole)
    (path / "zarr.json").write_text(json.dumps(whole))


def nested(count):
    return count * "[" + count * "]"


def without(path, name):
    """Take an array out of what the map says that it has."""
    rewritten(path, lambda all_: all_["consolidated_metadata"]["metadata"].pop(name))


FOLDERS = {
    "outcome: no zarr.json": lambda path: shutil.rmtree(path / "outcome"),
    "margin: no zarr.json": lambda path: (path / "margin" / "zarr.json").unlink(),
    f"{X}: no zarr.json": lambda path: shutil.rmtree(path / X),
    "outcome/zarr.json: Expecting": lambda path: (path / "outcome" / "zarr.json").write_text("{"),
    "array outcome: described otherwise": lambda path: (path / "outcome" / "zarr.json").write_text("{}"),
    "outcome/zarr.json: ": lambda path: (path / "outcome" / "zarr.json").write_bytes(b"\xff\xfe"),
    "array outcome missing": lambda path: without(path, "outcome"),
    "array margin missing": lambda path: without(path, "margin"),
    "fields of its axes: ['release.position.z'], not two": lambda path: without(path, X),
    "zarr_format = 9, not 3": lambda path: rewritten(path, lambda all_: all_.update(zarr_format=9)),
    "a linked array": lambda path: outside(path, X),
    "a linked description": lambda path: outside(path, "zarr.json"),
    "a linked description of an array": lambda path: outside(path, f"{X}/zarr.json"),
    "linked chunks": lambda path: outside(path, "outcome/c"),
    "a linked chunk": lambda path: outside(path, "outcome/c/0/0"),
    "a link to nothing": lambda path: (path / "more").symlink_to("/nowhere"),
    "a pipe": lambda path: piped(path, "outcome/c/0/0"),
    "a pipe that describes": lambda path: piped(path, f"{X}/zarr.json"),
    "deep folders": lambda path: (path / "a/b/c/d").mkdir(parents=True),
    "long": lambda path: (path / X / "zarr.json").write_bytes(b" " * (2 << 20)),
    "long attributes": lambda path: rewritten(
        path, lambda all_: all_["attributes"].update(a="a" * (2 << 20))
    ),
    "deep": lambda path: (path / X / "zarr.json").write_text(nested(500_000)),
    "less deep": lambda path: (path / X / "zarr.json").write_text(f'{{"attributes": {nested(800)}}}'),
    "a list": lambda path: (path / X / "zarr.json").write_text("[]"),
    "a long number": lambda path: (path / X / "zarr.json").write_text(5000 * "9"),
    "other consolidated": lambda path: rewritten(
        path, lambda all_: all_["consolidated_metadata"]["metadata"][X].update(codecs=CODECS["pickle"])
    ),
    "consolidated beyond the folder": lambda path: rewritten(
        path, lambda all_: all_["consolidated_metadata"]["metadata"].update({"../elsewhere": {}})
    ),
    "no consolidated": lambda path: rewritten(path, lambda all_: all_.pop("consolidated_metadata")),
    "consolidated of another kind": lambda path: rewritten(
        path, lambda all_: all_.update(consolidated_metadata=[{}])
    ),
}


@pytest.mark.parametrize("name", FOLDERS)
def test_folders_that_are_not_ours_are_refused(path, opened_by_zarr, name):
    """What a name with a colon or an equals sign says is in the answer."""
    FOLDERS[name](path)
    is_refused(path, name if any(sign in name for sign in (":", "=", "missing")) else NO_MAP)
    assert not opened_by_zarr


GONE = object()
ATTRIBUTES = {
    "(engine: 'abacus', accepted: analytic, mujoco)": {"engine": "abacus"},
    "attribute engine = None": {"engine": None},
    'attribute after = "two"': {"after": "two"},
    "(after = True)": {"after": True},
    "attribute after missing": {"after": GONE},
    "gravity = -1: accepted: a number": {"scenario": "gravity = -1"},
    "attribute scenario = 7": {"scenario": 7},
    "(contact_steps: given -1": {"engine_settings": {"contact_steps": -1}},
    "(contact_steps = 1000": {"engine_settings": {"contact_steps": 10**30}},
    NO_MAP: {"engine_settings": {"contact_tolerance": "1"}},
    "attribute engine_settings = ": {"engine_settings": []},
    "attribute margin_along = 7": {"margin_along": 7},
    "attribute trust = 1": {"trust": 1},
    "array outcome_certain missing": {"trust": True},
    "array trusted_impacts missing": {"trust": True, "after": 3},
    "(attribute cointoss_map = 2, not 1)": {"cointoss_map": 2},
    "attribute versions missing": {"versions": GONE},
    'attribute versions = "1"': {"versions": "1"},
}


@pytest.mark.parametrize("said", ATTRIBUTES)
def test_attributes_that_are_not_ours_are_refused(path, said):
    def change(all_):
        given = {**all_["attributes"], **ATTRIBUTES[said]}
        all_["attributes"] = {name: value for name, value in given.items() if value is not GONE}

    rewritten(path, change)
    is_refused(path, said)


@pytest.mark.parametrize("damage", ["pipe", "deep", "long"])
def test_what_describes_no_map_is_not_replaced(path, damage):
    {
        "pipe": lambda: piped(path, "zarr.json"),
        "deep": lambda: (path / "zarr.json").write_text(nested(500_000)),
        "long": lambda: (path / "zarr.json").write_bytes(b" " * (2 << 20)),
    }[damage]()
    asked = path.parent / "coin.toml", "--x", AXES[0], "--y", AXES[1], "--out", path
    said = f"cointoss: {path}: is no map; accepted: a new name, or a map of cointoss\n"
    assert refused("basin", *asked, "--overwrite") == is_refused(path) == said


def test_tiles_without_number_are_refused_at_once(path):
    for name, count in ((X, 5_000), (Y, 5_000)):
        described(path, name)(shape=[count], chunk_grid=regular(count))
        values = np.linspace(*((20, 60) if name == X else (0.2, 0.6)), count)
        (path / name / CHUNKS[name]).write_bytes(numcodecs.Zstd(checksum=True).encode(values.tobytes()))
    for name in ("outcome", "impacts", "margin"):
        described(path, name)(shape=[5_000, 5_000], chunk_grid=regular(1, 1))
    is_refused(path, "has tiles of 1 by 1 pixels; accepted: a map of at most 1e+06 tiles")


def test_what_lies_beside_the_arrays_is_not_looked_at(path):
    before = tossed_map_at(path)
    (path / "README.txt").write_text("a map of mine")
    (path / ".zattrs").write_text("{}")
    (path / X / ".zarray").write_text("{")
    (path / "more").mkdir()
    (path / "more" / "zarr.json").write_text("{")
    after = tossed_map_at(path)
    assert after.sweep == before.sweep
    for name, array in before.layers.items():
        assert np.array_equal(after.layers[name], array)
