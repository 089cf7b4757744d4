"""An engine's library is built once, loaded whole or not at all, and called with rows of numbers."""

import ctypes
import json
import math
import os
import shutil
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cointoss.models.kernel import base_folder, building, library
from cointoss.models.kernel.building import build_once
from cointoss.models.kernel.kinds import kind_of
from cointoss.models.kernel.library import MANIFEST, SYSTEM, EngineMissingError, Library, Made, library_file
from tests.helpers.command_line import HERE
from tests.helpers.processes import started, wait_until
from tests.helpers.small import entries
from tests.helpers.small.entries import Law, Side, powers, turned

MODULE = entries.__name__


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of a library that was built."""
    made = tmp_path_factory.mktemp("cache") / "engines"
    build_once(MODULE, made)
    return made


@pytest.fixture
def cache(monkeypatch, tmp_path, folder):
    """A user's folder with a copy of that library."""
    shutil.copytree(folder, tmp_path / "engines")
    monkeypatch.setattr(library, "base_folder", lambda: tmp_path)
    return tmp_path / "engines"


@pytest.fixture
def engine(monkeypatch, cache):
    """The library, loaded."""
    _, file = made_files(cache)
    monkeypatch.setattr(entries.engine, "_file", file)
    monkeypatch.setattr(entries.engine, "loaded", ctypes.CDLL(str(file)))


def made_files(cache):
    manifest, *others = cache.glob(f"*{MANIFEST}")
    assert not others
    return manifest, manifest.with_suffix("")


@pytest.mark.usefixtures("engine")
def test_an_entry_takes_and_returns_values_of_every_kind():
    rows = np.ones((2, 3))
    found = powers(Law(2.0, 0.5), np.array([1.0, 2.0, 3.0]), rows, 1)
    assert np.array_equal(found.numbers, [0.5, 2, 4.5])
    assert np.array_equal(rows, [[0, 0, 0], [0.5, 2, 4.5]])
    assert (found.side, found.is_whole, found.place) == (Side.RIGHT, True, (1.5, 2.0, 3.0))
    assert type(found.side) is Side
    assert type(found.is_whole) is bool
    found = powers(times=0, rows=rows, given=np.array([3.0, 1.0, 1.0]), law=Law(None, 0.5))
    assert (found.numbers[0], found.side, found.is_whole) == (1.5, Side.LEFT, False)
    sines, signs = turned(np.array([0.5, -0.5]))
    assert np.allclose(sines, [math.sin(0.5), -math.sin(0.5)], rtol=1e-15, atol=0)
    assert np.array_equal(signs, [True, False])


@pytest.mark.usefixtures("engine")
def test_an_entry_raises_what_its_function_raises():
    with pytest.raises(ValueError, match=r"^fewer than none$"):
        powers(Law(2.0, 0.5), np.ones(3), np.ones((2, 3)), -1)


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("given", [np.ones(6)[::2], np.ones(3, np.float32), np.ones((3, 1))])
def test_an_array_of_another_kind_is_refused(given):
    with pytest.raises(TypeError, match="accepted: float64, of 1 axes, contiguous"):
        turned(given)


@pytest.mark.usefixtures("engine")
def test_an_entry_of_another_version_is_not_called(monkeypatch):
    monkeypatch.setitem(entries.engine._forms, "turned", "qqq d")
    monkeypatch.setattr(turned, "_code", {})
    with pytest.raises(
        EngineMissingError, match="turned is of another version; install cointoss-dynamics again"
    ):
        turned(np.ones(3))


@pytest.mark.usefixtures("engine")
def test_the_memory_of_a_returned_array_is_given_back(monkeypatch):
    given, release = [], entries.engine.release
    monkeypatch.setattr(entries.engine, "release", lambda address: given.append(address) or release(address))
    turned(np.ones(3))
    assert len(given) == 2
    assert all(given)


def test_an_annotation_that_is_no_kind_is_refused():
    with pytest.raises(TypeError, match="no kind of rows of numbers"):
        kind_of(str)


def test_a_library_of_these_sources_is_found_and_kept(cache):
    manifest, file = made_files(cache)
    os.utime(manifest, (0, 0))
    assert library_file(MODULE) == file
    assert manifest.stat().st_mtime > 0


def edit(manifest, _):
    made = json.loads(manifest.read_bytes())
    made["sources"][next(iter(made["sources"]))] = "0"
    manifest.write_text(json.dumps(made))


def cut(_, file):
    file.write_bytes(file.read_bytes()[:-1])


def open_to_others(_, file):
    file.chmod(0o666)


def open_manifest(manifest, _):
    manifest.chmod(0o622)


def spoil(manifest, _):
    manifest.write_text("{")


@pytest.mark.parametrize("harm", [edit, cut, open_to_others, open_manifest, spoil])
def test_a_library_that_is_stale_damaged_or_anothers_is_not_loaded(cache, monkeypatch, harm):
    harm(*made_files(cache))
    asked: list[object] = []
    monkeypatch.setattr(building, "build_once", lambda *given: asked.append(given))
    with pytest.raises(EngineMissingError, match="of other sources"):
        library_file(MODULE)
    assert asked == [(MODULE, cache)]


@pytest.mark.parametrize("harm", [cut, lambda _, file: file.unlink()])
def test_a_library_that_is_damaged_or_missing_is_built_again(cache, harm):
    _, file = made_files(cache)
    whole = file.read_bytes()
    harm(*made_files(cache))
    assert library_file(MODULE).read_bytes() == whole


@pytest.mark.usefixtures("engine")
def test_a_list_in_place_of_a_tuple_is_refused():
    law: Any = [2.0, 0.5]
    with pytest.raises(TypeError, match=r"^a list; accepted: a tuple$"):
        powers(law, np.ones(3), np.ones((2, 3)), 1)


def test_a_wheel_carries_a_library_for_its_system(cache, monkeypatch):
    manifest, file = made_files(cache)
    carried = cache.with_name("carried")
    carried.mkdir()
    monkeypatch.setattr(library, "CARRIED", carried)
    there = carried / f"small-{SYSTEM}.so"
    shutil.copy(file, there)
    shutil.copy(manifest, f"{there}.json")
    there.chmod(0o666)  # pip has installed it, and whoever may write there could change Python's code as well
    assert library_file(MODULE) == there
    there.write_bytes(b"")
    with pytest.raises(EngineMissingError, match=r"is damaged; install cointoss-dynamics again$"):
        library_file(MODULE)
    Path(f"{there}.json").rename(carried / f"small-plan9-mips{MANIFEST}")
    with pytest.raises(EngineMissingError, match=rf"no small engine for {SYSTEM}; there is: plan9-mips$"):
        library_file(MODULE)


def test_processes_that_start_at_once_build_it_once(tmp_path):
    program = f"from {MODULE} import turned; import numpy as np; print(turned(np.ones(1))[0][0])"
    environment = {**HERE, "COINTOSS_CACHE": str(tmp_path)}
    with started("-c", program, env=environment) as one, started("-c", program, env=environment) as other:
        found = [process.communicate() for process in (one, other)]
    assert {out for out, _ in found} == {f"{math.sin(1.0)!r}\n"}
    told = sorted(
        line.partition(":")[2].rpartition(":")[0] for _, error in found for line in error.splitlines()
    )
    assert set(told) == {
        " building the small engine, once",
        " waiting for another process, which builds the small engine",
    }
    assert len(list((tmp_path / "engines").glob(f"*{MANIFEST}"))) == 1


def test_ctrl_c_while_building_leaves_nothing(tmp_path):
    program = f"from {MODULE} import engine; engine.loaded"
    with started("-c", program, env={**HERE, "COINTOSS_CACHE": str(tmp_path)}) as process:
        wait_until(process, lambda: (tmp_path / "engines").is_dir() and any((tmp_path / "engines").iterdir()))
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
    assert "KeyboardInterrupt" in error
    assert not [file for file in (tmp_path / "engines").iterdir() if not file.name.endswith(".lock")]


@pytest.mark.parametrize(
    ("arrange", "told"),
    [
        (
            lambda patch: patch.setattr(building, "find_spec", lambda _: None),
            "no numba, llvmlite, ziglang to build it",
        ),
        (
            lambda patch: patch.setattr(sys, "executable", shutil.which("false")),
            "could not be built: exit status 1",
        ),
    ],
)
def test_what_cannot_be_built_is_told_in_a_line(tmp_path, monkeypatch, arrange, told):
    arrange(monkeypatch)
    with pytest.raises(EngineMissingError, match=told) as raised:
        build_once(MODULE, tmp_path / "engines")
    assert "\n" not in str(raised.value)


def test_a_full_disk_is_told_in_a_line(tmp_path):
    (tmp_path / "engines").write_text("")
    with pytest.raises(EngineMissingError, match=r"could not be built: .*File exists"):
        build_once(MODULE, tmp_path / "engines")


def test_libraries_that_nobody_uses_are_removed(cache):
    manifest, file = made_files(cache)
    building.remove_unused(cache)
    assert file.exists()
    os.utime(manifest, (0, 0))
    building.remove_unused(cache)
    assert not [*cache.glob("*.so*")]


def test_the_folder_is_the_users_own(tmp_path, monkeypatch):
    chosen: Any = tmp_path / "chosen"
    monkeypatch.setenv("COINTOSS_CACHE", str(chosen))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "caches"))
    find = base_folder.base_folder.__wrapped__
    assert find() == chosen
    assert chosen.stat().st_mode & 0o777 == 0o700
    chosen.chmod(0o777)
    assert find() == tmp_path / "caches" / "cointoss"


def test_an_engine_that_is_not_there_says_so_to_the_command_line(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["", MODULE])
    monkeypatch.setattr(
        library, "library_file", lambda _: (_ for _ in ()).throw(EngineMissingError("no engine"))
    )
    assert building.main() == 2
    assert capsys.readouterr().err == "cointoss: no engine\n"


def test_a_library_is_loaded_when_it_is_first_called():
    assert "loaded" not in vars(Library("tests.helpers.small.entries"))
    assert Made.read(Path("nowhere")) is None
