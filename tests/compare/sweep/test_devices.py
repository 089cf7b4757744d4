"""Batches and maps on a card, for which a stand-in tosses: the same results, and who tossed them."""

import numpy as np
import pytest

import cointoss
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import grid, pieces
from cointoss.models.devices import DeviceWarning
from cointoss.models.processor import LEAST_TOSSES
from tests.helpers.basin_runs import AXES, SMALL, assert_same, basin, pixels
from tests.helpers.cards import with_card, without_card
from tests.helpers.command_line import refused

CASE = cointoss.load("fig24a").replace("ending.max_impacts", 2)
FEW = {"height": "0.2:0.6:30"}
MANY = {"height": "0.2:0.6:60", "spin": "20:60:70"}
HELD = ("device", "handed_over")


@pytest.fixture
def coin(tmp_path):
    path = tmp_path / "coin.toml"
    path.write_text(CASE.to_toml(), encoding="utf-8")
    return path


def assert_same_tosses(found, due):
    assert found.drop_attrs(deep=False).identical(due.drop_attrs(deep=False))


@pytest.mark.parametrize("device", ["cuda", "auto"])
def test_a_batch_on_a_card_is_that_of_the_cpu(monkeypatch, tmp_path, device):
    monkeypatch.setattr(pieces, "LEAST_ON_CARD", 1000)
    card, due = with_card(monkeypatch), cointoss.toss_many(CASE, MANY)
    assert (due.attrs["device"], due.attrs["handed_over"]) == ("cpu", 0)
    found = cointoss.toss_many(CASE, MANY, device=device)
    assert_same_tosses(found, due)
    # Pieces are large from the second on.
    first, *others, _ = card.given
    assert first == pieces.FIRST
    assert others
    assert min(others) >= 1000
    assert sum(card.given) == 4200
    assert (found.attrs["device"], found.attrs["handed_over"]) == (
        "Stand-in",
        sum(n // 3 for n in card.given),
    )
    assert {name: one for name, one in found.attrs.items() if name not in HELD} == {
        name: one for name, one in due.attrs.items() if name not in HELD
    }
    kept = cointoss.toss_many(CASE, FEW, device=device, out=tmp_path / "kept.zarr")
    assert kept.attrs["device"] == ("Stand-in" if device == "cuda" else "cpu")


def test_auto_is_the_cpu_for_few_tosses_by_mujoco_and_without_a_card(monkeypatch):
    card = with_card(monkeypatch)
    assert LEAST_TOSSES > 30
    assert cointoss.toss_many(CASE, FEW, device="auto").attrs["device"] == "cpu"
    with monkeypatch.context() as patched:
        patched.setattr("cointoss.models.processor.LEAST_TOSSES", 1)
        found = cointoss.toss_many(CASE, {"height": "0.2:0.21:2"}, engine="mujoco", device="auto")
        assert found.attrs["device"] == "cpu"
    assert not card.given
    asked = without_card(monkeypatch)
    assert cointoss.toss_many(CASE, MANY, device="auto").attrs["device"] == "cpu"
    assert len(asked) == 1


def test_a_map_whose_card_is_lost_keeps_its_tiles_and_goes_on_by_the_cpu(monkeypatch, coin, tmp_path):
    monkeypatch.setitem(grid.TILE_TOSSES, Engine.ANALYTIC, SMALL)
    basin(coin, *AXES, "--out", tmp_path / "cpu.zarr")
    due, out = pixels(tmp_path / "cpu.zarr"), tmp_path / "card.zarr"
    with_card(monkeypatch, calls=3)
    told = refused("basin", coin, *AXES, "--out", out, "--device", "cuda")
    assert told == "cointoss: --device cuda: the card was lost; accepted: cpu, auto\n"
    assert np.sum(pixels(out)["outcome"] >= 0) == 3 * SMALL
    answered = basin(coin, *AXES, "--out", out, "--resume")
    assert (answered.exit_code, answered.stderr.count("\n")) == (0, 0)
    assert_same(out, due)


def test_a_command_says_which_card_tossed_and_prints_the_same(monkeypatch, coin, tmp_path):
    monkeypatch.chdir(tmp_path)
    card, asked = with_card(monkeypatch), (coin, "--x", "spin=20:60:100", "--y", "height=0.2:0.6:60")
    due = basin(*asked, "--out", "map.zarr")
    found = basin(*asked, "--out", "map.zarr", "--overwrite", "--device", "auto")
    assert found.stdout == due.stdout
    handed = sum(n // 3 for n in card.given)
    said = f"cointoss: map.zarr: tossed by Stand-in, {handed:,d} of 6,000 tosses handed over to the CPU\n"
    assert found.stderr == said
    with_card(monkeypatch, calls=1)
    lost = basin(*asked, "--out", "map.zarr", "--overwrite", "--device", "auto")
    assert (lost.exit_code, lost.stdout) == (0, due.stdout)
    first, second = lost.stderr.splitlines()
    assert first == f"cointoss: {coin}: device: the card was lost; the CPU tosses what is left"
    assert second.startswith("cointoss: map.zarr: tossed by Stand-in, ")


def test_a_card_that_is_lost_is_warned_of_once(monkeypatch):
    with_card(monkeypatch, calls=1)
    due = cointoss.toss_many(CASE, MANY)
    with pytest.warns(DeviceWarning) as warned:
        found = cointoss.toss_many(CASE, MANY, device="auto")
    assert len(warned) == 1
    assert_same_tosses(found, due)
