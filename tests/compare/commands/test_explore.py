"""`cointoss explore`, and `lab` of a map: what it refuses, where it listens, and how it ends."""

import json
import shutil
import signal
import socket
import webbrowser
from base64 import b64decode
from unittest.mock import Mock

import numpy as np
import pytest

from cointoss import read_map
from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import BackEndError
from cointoss.compare.lab import static
from cointoss.compare.lab.saved import saved_map
from cointoss.compare.lab.served import ServedLab
from cointoss.compare.sweep import reading
from tests.helpers.cards import without_card
from tests.helpers.command_line import cointoss, refused
from tests.helpers.explored import got, small_map
from tests.helpers.processes import answered, ask, started


@pytest.fixture
def copy(map_path, tmp_path):
    """A copy of the map to be damaged."""
    return shutil.copytree(map_path, tmp_path / "map.zarr")


def changed(path, **attributes):
    description = json.loads((path / "zarr.json").read_text())
    description["attributes"].update(attributes)
    (path / "zarr.json").write_text(json.dumps(description))


BY_MUJOCO = {"engine": Engine.MUJOCO, "engine_settings": Engine.MUJOCO.package.MANY.as_dict()}
CUDA = ("--device", "cuda")


@pytest.mark.parametrize(
    ("attributes", "most", "options", "told"),
    [
        ({"name": 7}, 432, (), "is no map of cointoss (name = "),
        ({"name": 300 * "a"}, 432, (), "is no map of cointoss (name = "),
        ({}, 431, (), "has 24 by 18 pixels; accepted: a map of at most 431 pixels"),
        ({}, 432, CUDA, ": --device cuda: no NVIDIA driver was found; accepted: cpu, auto\n"),
        (BY_MUJOCO, 432, CUDA, "map.zarr: --device cuda: accepted by the MuJoCo engine: cpu, auto\n"),
    ],
)
def test_a_map_that_cannot_be_shown_is_refused(copy, monkeypatch, attributes, most, options, told):
    without_card(monkeypatch)
    monkeypatch.setattr(reading, "MOST_READ", most)
    monkeypatch.setattr(ServedLab, "serve_forever", lambda _: None)
    changed(copy, **attributes)
    assert told in refused("explore", copy, "--no-browser", *options)


def test_a_map_by_mujoco_is_not_to_blame_for_a_back_end_that_is_missing(copy, monkeypatch):
    changed(copy, engine=Engine.MUJOCO)
    monkeypatch.setattr(reading, "require_mujoco", Mock(side_effect=BackEndError("MuJoCo can't be used")))
    assert refused("explore", copy) == "cointoss: MuJoCo can't be used\n"


@pytest.mark.parametrize("tile", [None, 7, 10])
def test_of_a_large_map_every_so_many_th_pixel_is_shown(map_path, tmp_path, monkeypatch, tile):
    full, path = read_map(map_path), map_path
    if tile is not None:  # whose sides the stride crosses
        monkeypatch.setattr("cointoss.compare.sweep.layout.TILE_TOSSES", dict.fromkeys(Engine, tile))
        path = small_map(tmp_path)
    part = read_map(path, most=100)
    assert (full.attrs["stride"], part.attrs["stride"]) == (1, 3)
    assert part.equals(full.isel(x=slice(None, None, 3), y=slice(None, None, 3)))


def test_an_unfinished_map_is_shown_as_far_as_it_is(tmp_path, monkeypatch):
    monkeypatch.setattr("cointoss.compare.sweep.layout.TILE_TOSSES", dict.fromkeys(Engine, 64))
    path = small_map(tmp_path)
    before = read_map(path).cointoss.codes
    next(part for part in (path / "outcome" / "c").rglob("*") if part.is_file()).unlink()
    found = read_map(path)
    outcome = found.cointoss.codes
    assert 0 < (outcome == -1).mean() < 0.8
    assert np.array_equal(outcome[outcome != -1], before[outcome != -1])
    held = np.frombuffer(b64decode(saved_map(found, "map.zarr")["arrays"]["outcome"]), np.int8)
    assert np.array_equal(held, outcome.ravel())


def test_a_port_in_use_is_refused(map_path):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        said = refused("explore", map_path, "--port", port)
    assert f"--port {port}: another program listens there; accepted: another port" in said


@pytest.mark.parametrize(
    ("words", "opens", "asked"),
    [
        ("explore MAP", True, 1),
        ("lab MAP", False, 1),
        ("lab MAP --no-browser", True, 0),
        ("lab --device auto", True, 1),
    ],
)
def test_the_address_is_printed_and_opened(map_path, monkeypatch, words, opens, asked):
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or opens)
    monkeypatch.setattr(ServedLab, "serve_forever", lambda _: None)
    answered = cointoss(*(map_path if word == "MAP" else word for word in words.split()))
    assert answered.exit_code == 0
    assert answered.stdout.startswith("http://127.0.0.1:")
    assert len(opened) == asked
    assert ("no browser was found" in answered.stderr) == (not opens)


@pytest.mark.parametrize("words", ["lab MAP --out PAGE", "lab MAP --out=PAGE", "explore MAP --static PAGE"])
def test_a_page_of_a_map_is_written_to_a_file(map_path, tmp_path, monkeypatch, words):
    monkeypatch.setattr(static, "write_static", lambda path, out: out.write_text(path.name))
    target = tmp_path / "map.html"
    cointoss(*words.replace("MAP", str(map_path)).replace("PAGE", str(target)).split())
    assert target.read_text() == map_path.name


def test_ctrl_c_ends_it(map_path):
    script = "from cointoss.compare.cli import main; main()"
    with started("-c", script, "explore", map_path, "--no-browser") as process:
        assert process.stdout
        port = int(process.stdout.readline().rstrip("/\n").rpartition(":")[2])
        assert got(port, "/")[0] == 200
        ask(process, signal.SIGINT)
        _, said = answered(process)
    assert (process.returncode, said) == (130, "cointoss: interrupted by SIGINT\n")
