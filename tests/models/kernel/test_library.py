"""An engine's library is built once, loaded whole or not at all, and called with rows of numbers."""

import ctypes
import math
import os
import shutil
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cointoss.models.kernel import base_folder, building
from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.building import build_once, library_file
from cointoss.models.kernel.digests import digest_of
from cointoss.models.kernel.manifest import MANIFEST, SYSTEM
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
def cached(monkeypatch, tmp_path, folder):
    """The manifest and the library, in a copy of that folder as a user's own."""
    shutil.copytree(folder, tmp_path / "engines")
    monkeypatch.setattr(building, "base_folder", lambda: tmp_path)
    (manifest,) = (tmp_path / "engines").glob(f"*{MANIFEST}")
    return manifest, manifest.with_suffix("")


@pytest.fixture
def engine(monkeypatch, cached):
    """The library, loaded."""
    monkeypatch.setattr(entries.engine, "_file", cached[1])
    monkeypatch.setattr(entries.engine, "loaded", ctypes.CDLL(str(cached[1])))
    return entries.engine


@pytest.mark.slow
@pytest.mark.usefixtures("engine")
def test_an_entry_takes_and_returns_values_of_every_kind():
    rows = np.ones((2, 3))
    found = powers(Law(2.0, 0.5), np.array([1.0, 2.0, 3.0]), rows, 1)
    assert np.array_equal(found.numbers, [0.5, 2, 4.5])
    assert np.array_equal(rows, [[0, 0, 0], [0.5, 2, 4.5]])
    assert (found.side, found.is_whole, found.place) == (Side.RIGHT, True, (1.5, 2.0, 3.0))
    assert [type(found.side), type(found.is_whole)] == [Side, bool]
    found = powers(times=0, rows=rows, given=np.array([3.0, 1.0, 1.0]), law=Law(None, 0.5))
    assert (found.numbers[0], found.side, found.is_whole) == (1.5, Side.LEFT, False)
    sines, signs = turned(np.array([0.5, -0.5]))
    assert np.allclose(sines, [math.sin(0.5), -math.sin(0.5)], rtol=1e-15, atol=0)
    assert np.array_equal(signs, [True, False])


LIST: Any = [2.0, 0.5]


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize(
    ("entry", "given", "error", "says"),
    [
        (powers, (Law(2.0, 0.5), np.ones(3), np.ones((2, 3)), -1), ValueError, "^fewer than none$"),
        (powers, (LIST, np.ones(3), np.ones((2, 3)), 1), TypeError, "^a list; accepted: a tuple$"),
        (turned, (np.ones(6)[::2],), TypeError, "accepted: float64, of 1 axes, contiguous"),
        (turned, (np.ones(3, np.float32),), TypeError, "accepted: float64, of 1 axes, contiguous"),
        (turned, (np.ones((3, 1)),), TypeError, "accepted: float64, of 1 axes, contiguous"),
    ],
    ids=range(5),
)
def test_an_entry_raises_what_its_function_raises_and_refuses_other_kinds(entry, given, error, says):
    with pytest.raises(error, match=says):
        entry(*given)


def test_an_entry_of_another_version_is_not_called(engine, monkeypatch):
    monkeypatch.setitem(engine._forms, "turned", "qqq d")
    monkeypatch.setattr(turned, "_code", {})
    with pytest.raises(EngineMissingError, match="turned is of another version; install cointoss-dynamics"):
        turned(np.ones(3))


def test_the_memory_of_a_returned_array_is_given_back(engine, monkeypatch):
    given, release = [], engine.release
    monkeypatch.setattr(engine, "release", lambda address: given.append(address) or release(address))
    turned(np.ones(3))
    assert [bool(address) for address in given] == [True, True]


def test_a_library_of_these_sources_is_found_and_kept_and_one_that_nobody_uses_removed(cached):
    manifest, file = cached
    os.utime(manifest, (0, 0))
    assert library_file(MODULE) == file
    building.remove_unused(manifest.parent)
    assert file.exists()
    os.utime(manifest, (0, 0))
    building.remove_unused(manifest.parent)
    assert not [*manifest.parent.glob("*.so*")]


HARMS = {
    "stale": lambda made, _: made.write_bytes(made.read_bytes().replace(b'.py": "', b'.py": "0', 1)),
    "cut": lambda _, file: file.write_bytes(file.read_bytes()[:-1]),
    "missing": lambda _, file: file.unlink(),
    "open to others": lambda _, file: file.chmod(0o666),
    "with a manifest open to others": lambda made, _: made.chmod(0o622),
    "with no manifest": lambda made, _: made.write_text("{"),
}


@pytest.mark.parametrize("harm", HARMS.values(), ids=HARMS)
def test_a_library_that_is_stale_damaged_or_anothers_is_not_loaded_but_built_again(cached, monkeypatch, harm):
    harm(*cached)
    asked: list[object] = []
    monkeypatch.setattr(building, "build_once", lambda *given: asked.append(given))
    with pytest.raises(EngineMissingError, match="of other sources"):
        library_file(MODULE)
    assert asked == [(MODULE, cached[0].parent, [SYSTEM])]


def test_a_wheel_carries_a_library_for_its_system(cached, monkeypatch, tmp_path):
    there = tmp_path / f"small-{SYSTEM}.so"
    monkeypatch.setattr(building, "CARRIED", tmp_path)
    shutil.copy(cached[0], f"{there}.json")
    shutil.copy(cached[1], there)
    there.chmod(0o666)  # pip has installed it, and whoever may write there could change Python's code as well
    assert library_file(MODULE) == there
    there.write_bytes(b"")
    with pytest.raises(EngineMissingError, match=r"is damaged; install cointoss-dynamics again$"):
        library_file(MODULE)
    Path(f"{there}.json").rename(tmp_path / f"small-plan9-mips{MANIFEST}")
    with pytest.raises(EngineMissingError, match=rf"no small engine for {SYSTEM}; there is: plan9-mips$"):
        library_file(MODULE)


@pytest.mark.slow
def test_processes_that_start_at_once_build_it_once(tmp_path):
    program = f"from {MODULE} import turned; import numpy as np; print(turned(np.ones(1))[0][0])"
    environment = {**HERE, "COINTOSS_CACHE": str(tmp_path)}
    with started("-c", program, env=environment) as one, started("-c", program, env=environment) as other:
        (out_1, said_1), (out_2, said_2) = (process.communicate() for process in (one, other))
    assert out_1 == out_2 == f"{math.sin(1.0)!r}\n"
    assert said_1 == said_2 == "", "what is quick says nothing"
    assert len([*(tmp_path / "engines").glob(f"*{MANIFEST}")]) == 1


def left_by_an_interrupted_build(cache):
    """Return the suffixes of what a process leaves that Ctrl-C ends while it builds, beside its lock."""
    engines, program = cache / "engines", f"from {MODULE} import engine; engine.loaded"
    with started("-c", program, env={**HERE, "COINTOSS_CACHE": str(cache)}) as process:
        wait_until(process, lambda: engines.is_dir() and any(engines.iterdir()))
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
    assert "KeyboardInterrupt" in error
    return {file.suffix for file in engines.iterdir()} - {".lock"}


def test_ctrl_c_while_building_leaves_nothing(tmp_path):
    """On a busy machine the signal may come when the small engine is built: then it is there as a whole."""
    left = [left_by_an_interrupted_build(tmp_path / str(number)) for number in range(3)]
    assert all(each in (set(), {".so", ".json"}) for each in left)
    assert set() in left


@pytest.mark.parametrize(
    ("arrange", "told"),
    [
        (lambda patch, _: patch.setattr(building, "find_spec", lambda _: None), "no numba, llvmlite, "),
        (lambda patch, _: patch.setattr(sys, "executable", shutil.which("false")), "built: exit status 1"),
        (lambda _, folder: folder.write_text(""), "could not be built: .*File exists"),
    ],
)
def test_what_cannot_be_built_is_told_in_a_line(tmp_path, monkeypatch, arrange, told):
    arrange(monkeypatch, tmp_path / "engines")
    with pytest.raises(EngineMissingError, match=told) as raised:
        build_once(MODULE, tmp_path / "engines")
    assert "\n" not in str(raised.value)


def test_the_folder_is_the_users_own(tmp_path, monkeypatch):
    chosen = tmp_path / "chosen"
    monkeypatch.setenv("COINTOSS_CACHE", str(chosen))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "caches"))
    find = base_folder.base_folder.__wrapped__
    assert find() == chosen
    assert chosen.stat().st_mode & 0o777 == 0o700
    chosen.chmod(0o777)
    (tmp_path / "file").write_text("")
    for refused in (chosen, tmp_path / "file"):
        monkeypatch.setenv("COINTOSS_CACHE", str(refused))
        with pytest.raises(
            EngineMissingError, match=f"^COINTOSS_CACHE = '{refused}': accepted: a folder in which "
        ):
            find()
    monkeypatch.delenv("COINTOSS_CACHE")
    assert find() == tmp_path / "caches" / "cointoss"


def test_what_is_no_file_is_not_read():
    """A library that is a link to /dev/zero would never be read to its end."""
    assert digest_of(Path(os.devnull)) == ""
