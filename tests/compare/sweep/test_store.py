"""A map on disk: it survives whatever ends the process, and belongs to one process and one sweep."""

import errno
import os
import shutil
from dataclasses import replace
from itertools import count
from typing import Any

import numpy as np
import pytest
import zarr
from zarr.storage import LocalStore

from cointoss import analytic, read_map
from cointoss.compare.engines import Engine
from cointoss.compare.output.files import UnwritableError
from cointoss.compare.sweep import layout as module
from cointoss.compare.sweep import pieces, store
from cointoss.compare.sweep.store import Store, opened, require_place
from tests.helpers.basin_runs import (
    AXES,
    SCENARIO,
    SMALL,
    TILES,
    assert_same,
    basin,
    begun,
    map_layout,
    pixels,
    wait_for,
    whole_tiles,
)
from tests.helpers.command_line import printed, refused
from tests.helpers.strange_maps import rewritten


@pytest.fixture
def coin(coin, monkeypatch):
    """A scenario's file; the tiles of its maps are small."""
    monkeypatch.setitem(module.TILE_TOSSES, Engine.ANALYTIC, SMALL)
    return coin


def layout(**given):
    """Return the layout of the map, but for what is given."""
    return map_layout(**{"x": AXES[1], "y": AXES[3], **given})


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """The pixels of the map, made at one go in one tile."""
    folder = tmp_path_factory.mktemp("undisturbed")
    (folder / "coin.toml").write_text(SCENARIO)
    assert basin(folder / "coin.toml", *AXES, "--out", folder / "map.zarr").exit_code == 0
    return pixels(folder / "map.zarr")


@pytest.fixture(scope="module")
def in_tiles(tmp_path_factory):
    """The map, made in small tiles; tests copy it."""
    folder = tmp_path_factory.mktemp("in_tiles")
    (folder / "coin.toml").write_text(SCENARIO)
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(module.TILE_TOSSES, Engine.ANALYTIC, SMALL)
        assert basin(folder / "coin.toml", *AXES, "--out", folder / "map.zarr").exit_code == 0
    assert whole_tiles(folder / "map.zarr") == TILES
    return folder / "map.zarr"


def tosses_of(monkeypatch, *made):
    """Count the pixels that a map which is gone on with tosses."""
    tossed, known = [], pieces.columns_of

    def noted(batch, how, numbers, answers):
        tossed.extend(numbers)
        return known(batch, how, numbers, answers)

    with monkeypatch.context() as patched:
        patched.setattr(pieces, "columns_of", noted)
        printed("basin", *made, "--resume")
    return len(tossed)


def test_a_killed_map_is_resumed_to_the_same_pixels(undisturbed, coin, tmp_path, monkeypatch):
    out = tmp_path / "map.zarr"
    with begun(coin, out, most=6) as process:
        wait_for(process, out, 6)
        meanwhile = refused("basin", coin, *AXES, "--out", out, "--resume")
        overwritten = refused("basin", coin, *AXES, "--out", out, "--overwrite")
        process.kill()
    said = f"cointoss: {out}: another process is at this map; accepted: wait for its end\n"
    assert meanwhile == overwritten == said
    done = whole_tiles(out)
    assert 6 <= done < TILES
    left = 1920 - np.sum(pixels(out)["outcome"] >= 0)
    assert tosses_of(monkeypatch, coin, *AXES, "--out", out) == left
    assert_same(out, undisturbed)
    assert not list(out.rglob("*.partial"))
    assert not list(tmp_path.glob(".*.lock"))
    assert tosses_of(monkeypatch, coin, *AXES, "--out", out) == 0


def test_a_new_map_is_known_to_be_empty_without_reading_its_tiles(tmp_path, monkeypatch):
    read, reads = Store.read, []
    monkeypatch.setattr(Store, "read", lambda kept, *asked: reads.append(asked) or read(kept, *asked))
    with opened(tmp_path / "map.zarr", (made := layout()), overwrite=False) as kept:
        assert sum(kept.missing(tile).size for tile in kept.tiles) == len(made.batch)
    assert {name for _, name in reads} == set(made.batch.fields)


def test_a_full_disk_is_one_line_and_what_was_tossed_is_kept(undisturbed, coin, tmp_path, monkeypatch):
    out, room, put = tmp_path / "map.zarr", [20], LocalStore.set

    async def set_while_there_is_room(self, key, value):
        if "/c/" in key and "map.zarr" in str(self.root):
            room[0] -= 1
            if room[0] < 0:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        await put(self, key, value)

    with monkeypatch.context() as patched:
        patched.setattr(LocalStore, "set", set_while_there_is_room)
        said = refused("basin", coin, *AXES, "--out", out)
    assert said == f"cointoss: {out}: can't be written (No space left on device)\n"
    kept = np.sum(pixels(out)["outcome"] >= 0)
    assert 0 < kept < 20 * SMALL
    assert tosses_of(monkeypatch, coin, *AXES, "--out", out) == 1920 - kept
    assert_same(out, undisturbed)


def test_a_disk_that_is_full_at_the_start_leaves_nothing(coin, tmp_path, monkeypatch):
    async def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(LocalStore, "set", full)
    assert "No space left" in basin(coin, *AXES, "--out", tmp_path / "map.zarr").stderr
    assert [path.name for path in tmp_path.iterdir()] == ["coin.toml"]


def test_a_tile_is_whole_when_its_outcome_is_there(tmp_path, monkeypatch):
    path, made, put = tmp_path / "map.zarr", layout(margin="height", trust=True), LocalStore.set
    with opened(path, made, overwrite=False) as kept:
        numbers = kept.missing(kept.tiles[0])
        layers = {name: np.ones(len(numbers), layer.kind) for name, layer in made.layers.items()}
        for room in range(len(layers)):
            writes = count()

            async def ended_after(self, key, value, left=writes, most=room):
                if next(left) == most:
                    raise OSError(errno.EIO, os.strerror(errno.EIO))
                await put(self, key, value)

            monkeypatch.setattr(LocalStore, "set", ended_after)
            with pytest.raises(UnwritableError):
                kept.write(numbers, layers)
            assert set(read_map(path).cointoss.counts) == {"not_tossed"}
            assert len([*path.glob("*/c/0/0")]) == room


def test_a_whole_map_on_a_disk_that_is_read_only_prints_its_shares(in_tiles, coin, monkeypatch):
    def read_only(*_, **__):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(os, "mkdir", read_only)
    monkeypatch.setattr(store, "_locked", read_only)
    usage = shutil.disk_usage(in_tiles)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage._replace(free=0))
    answered = basin(coin, *AXES, "--out", in_tiles, "--resume")
    assert answered.stdout.startswith(f"map        {in_tiles}\n"), answered.stderr


def changed(file, change):
    file.write_bytes(change(file.read_bytes()))


def set_to(value):
    """Return what gives one pixel of an array a number that means nothing."""

    def change(out, name):
        array: Any = zarr.open_group(out, mode="r+", use_consolidated=False)[name]
        array[7, 7] = value if name == "outcome" else -abs(value)

    return change


DAMAGES = {
    "empty": (SMALL, lambda out, name: (out / name / "c/2/0").write_bytes(b"")),
    "cut": (SMALL, lambda out, name: changed(out / name / "c/2/0", lambda whole: whole[: len(whole) // 2])),
    "flipped": (
        SMALL,
        lambda out, name: changed(out / name / "c/2/0", lambda whole: whole[:-5] + b"?" + whole[-4:]),
    ),
    "lost": (SMALL, lambda out, name: (out / name / "c/2/0").unlink()),
    **{f"a pixel with {value}": (1, set_to(value)) for value in (-7, 6, 100)},
}


@pytest.mark.slow_after_first
@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", ["outcome", "impacts"])
def test_what_is_damaged_is_tossed_again(undisturbed, in_tiles, coin, tmp_path, monkeypatch, name, damage):
    out, (again, harm) = shutil.copytree(in_tiles, tmp_path / "map.zarr"), DAMAGES[damage]
    harm(out, name)
    assert tosses_of(monkeypatch, coin, *AXES, "--out", out) == again
    assert_same(out, undisturbed)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"case": SCENARIO.replace("0.6", "0.7")}, "scenario"),
        ({"after": 0}, "number of impacts"),
        ({"x": "release.angular_velocity.eta=20:60:49"}, "grid in x"),
        ({"x": "release.angular_velocity.eta=20:61:48"}, "grid in x"),
        ({"y": "release.position.y=0.2:0.6:40"}, "grid in y"),
        ({"x": AXES[3], "y": AXES[1]}, "grid in x"),
        ({"margin": "height"}, r"quantity of its margins \(`margin`\)"),
        ({"trust": True}, r"set of arrays \(`trust`\)"),
        ({"engine": Engine.MUJOCO}, "engine"),
        ({"settings": replace(analytic.MANY, contact_steps=9)}, "engine's settings, {"),
    ],
)
def test_a_map_of_something_else_is_not_gone_on_with(tmp_path, change, named):
    one, other = tmp_path / "one.zarr", tmp_path / "other.zarr"
    for path, made, asked in ((one, layout(), layout(**change)), (other, layout(**change), layout())):
        with opened(path, made, overwrite=False):
            pass
        with pytest.raises(UnwritableError, match=f"is a map with another {named}"):
            opened(path, asked, overwrite=False).__enter__()
    same = SCENARIO + "# another word for the same coin\n"
    with opened(one, layout(case=same, name="another file"), overwrite=False) as map_:
        assert (map_.attributes["scenario"], map_.attributes["name"]) == (SCENARIO, "")


def test_a_map_of_other_versions_is_not_gone_on_with(in_tiles, coin, tmp_path):
    out = shutil.copytree(in_tiles, tmp_path / "map.zarr")
    rewritten(out, lambda all_: all_["attributes"].update(versions={"cointoss": "0.0.1"}))
    assert "is a map with another set of versions" in refused("basin", coin, *AXES, "--out", out, "--resume")


def test_an_empty_folder_and_a_link_to_one_are_places_for_a_map(tmp_path):
    (tmp_path / "empty.zarr").mkdir()
    (tmp_path / "link.zarr").symlink_to(tmp_path / "empty.zarr")
    for name, overwrite in (("new.zarr", False), ("link.zarr", True)):
        require_place(tmp_path / name, resume=False, overwrite=overwrite)
        with opened(tmp_path / name, layout(), overwrite=overwrite):
            pass
    assert (tmp_path / "link.zarr").is_symlink()
    assert (tmp_path / "empty.zarr" / "outcome").is_dir()
    with pytest.raises(UnwritableError, match="name too long"):
        require_place(tmp_path / (300 * "a" + ".zarr"), resume=True, overwrite=False)


def test_a_grid_beyond_disk_or_memory_is_refused_with_its_need(coin, tmp_path, monkeypatch):
    usage = shutil.disk_usage(tmp_path)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage._replace(free=5_000_000))
    said = refused(
        "basin",
        coin,
        *(axis.replace(":48", ":1200").replace(":40", ":1600") for axis in AXES),
        "--out",
        tmp_path / "map.zarr",
    )
    assert "1200 by 1600 tosses need up to 9.6 MB of disk; accepted: a grid for the 5.0 MB that" in said
    monkeypatch.undo()
    monkeypatch.setattr(os, "sysconf", lambda _: 100)
    said = refused("basin", coin, *AXES, "--out", tmp_path / "map.zarr", "--png", tmp_path / "map.png")
    assert "of memory; accepted: a grid for the 10.0 kB" in said
