"""What a card tosses, for which a stand-in does: the same results, who tossed them, and what is refused."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

import cointoss
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import layout, pieces
from cointoss.models.devices import DeviceError, DeviceWarning
from cointoss.models.processor import LEAST_TOSSES
from cointoss.models.records import UnsupportedError
from tests.helpers.basin_runs import AXES, SMALL, assert_same, basin, pixels
from tests.helpers.cards import with_card, without_card
from tests.helpers.command_line import cointoss as command
from tests.helpers.command_line import refused

CASE = cointoss.load("fig24a").replace("ending.max_impacts", 2)
WINDOW = {"height": (0.2, 0.6), "spin": (20, 60)}
AIR = {"air.exponent": [0.0, 0.5], "air.normal": 0.1}
FEW = {"height": "0.2:0.6:30"}
MANY = {"height": "0.2:0.6:60", "spin": "20:60:70"}
HEARD = cointoss.Observed(touch_times=[0.3], touch_sd=1e-4)
BY_MUJOCO = r"^`device` cuda: accepted by the MuJoCo engine: cpu, auto$"
REFUSED: dict[str, tuple[Callable[[Any], Any], str]] = {
    "air": (
        lambda out: cointoss.toss_many(CASE, AIR, device="cuda", out=out),
        "^air.exponent = 0.5: accepted with `device` cuda: 0;",
    ),
    "many": (lambda out: cointoss.toss_many(CASE, FEW, engine="mujoco", device="cuda", out=out), BY_MUJOCO),
    "shares": (lambda _: cointoss.shares(CASE, engine="mujoco", device="cuda"), BY_MUJOCO),
    "both": (lambda _: cointoss.shares(CASE, engine="both", device="cuda"), BY_MUJOCO),
    "find": (
        lambda _: cointoss.find(CASE, WINDOW, sequence="HT", device="cuda"),
        "^`device` cuda: accepted for a sequence without",
    ),
    "fit": (
        lambda _: cointoss.fit(HEARD, CASE, {"height": (0.2, 0.6)}, device="cuda"),
        "^`device` cuda: accepted by a fit: cpu, auto$",
    ),
}
"""What no card tosses, and what is said of it; each is given a place for a store."""


@pytest.mark.parametrize("name", REFUSED)
def test_what_no_card_tosses_is_refused_before_the_first_toss(monkeypatch, tmp_path, name):
    card, (call, words) = with_card(monkeypatch), REFUSED[name]
    with pytest.raises(UnsupportedError, match=words):
        call(tmp_path / "none.zarr")
    assert not (tmp_path / "none.zarr").exists()
    assert not card.given


@pytest.mark.parametrize("call", [partial(cointoss.toss_many, CASE, FEW), partial(cointoss.shares, CASE)])
@pytest.mark.parametrize(
    ("device", "kind", "says"),
    [
        ("cuda", DeviceError, "no NVIDIA driver was found"),
        ("gpu", ValueError, r"^device: 'gpu', accepted: cpu, cuda, auto$"),
    ],
)
def test_without_a_card_it_is_refused_and_so_is_another_device(monkeypatch, call, device, kind, says):
    without_card(monkeypatch)
    with pytest.raises(kind, match=says):
        call(device=device)


@pytest.mark.parametrize("line", [("shares", "fig24a", "--tosses", 300), ("lab",)], ids=str)
def test_without_a_card_a_command_refuses_one_in_its_own_words(monkeypatch, line):
    without_card(monkeypatch)
    told = refused(*line, "--device", "cuda")
    assert told == "cointoss: --device cuda: no NVIDIA driver was found; accepted: cpu, auto\n"


@pytest.fixture
def coin(tmp_path):
    path = tmp_path / "coin.toml"
    path.write_text(CASE.to_toml(), encoding="utf-8")
    return path


def assert_same_tosses(found, due, card):
    """See that a card's results are the processor's, and say who tossed and what was handed over."""
    assert found.drop_attrs(deep=False).identical(due.drop_attrs(deep=False))
    assert due.attrs == due.attrs | {"device": "cpu", "handed_over": 0}
    assert found.attrs == due.attrs | {"device": "Stand-in", "handed_over": sum(n // 3 for n in card.given)}


def test_shares_on_a_card_are_those_of_the_cpu_and_the_command_prints_the_same(monkeypatch, coin):
    asked, printed = {"vary": {"restitution": "0.2:0.8:2"}, "tosses": 150}, ("shares", coin, "--tosses", 300)
    card, due = with_card(monkeypatch), command(*printed)
    found, by_cpu = (cointoss.shares(CASE, **asked, device=one) for one in ("cuda", "cpu"))
    assert sum(card.given) == 300
    assert_same_tosses(found, by_cpu, card)
    card.given.clear()
    told = command(*printed, "--device", "cuda")
    assert told.stdout == due.stdout
    handed = sum(n // 3 for n in card.given)
    assert told.stderr == f"cointoss: tossed by Stand-in, {handed} of 300 tosses handed over to the CPU\n"


def test_a_card_tosses_to_the_outcome_that_is_sought(monkeypatch, coin):
    card, asked = with_card(monkeypatch), {"outcome": "heads", "sequence": "H", "tosses": 500}
    due = cointoss.find(CASE, WINDOW, **asked)
    assert not card.given
    found = cointoss.find(CASE, WINDOW, **asked, device="cuda")
    assert (found.scenario, found.rooms) == (due.scenario, due.rooms)
    assert found.target.processor.tossed == sum(card.given) > 0
    words = ("find", coin, "--vary", "height=0.2:0.6", "--outcome", "heads", "--tosses", 200)
    here, there = (command(*words, "--device", one) for one in ("cpu", "cuda"))
    assert here.stdout == there.stdout
    assert there.stderr.startswith("cointoss: tossed by Stand-in, ")


def test_a_fit_is_made_by_the_cpu(monkeypatch):
    card, flat = with_card(monkeypatch), cointoss.load("fig24a").replace("air", {})
    times = cointoss.toss(flat).impacts.time[:3]
    observed = cointoss.Observed(touch_times=times, touch_sd=1e-4)
    asked: dict[str, Any] = {"vary": {"restitution": (0.7, 0.9)}, "starts": 16}
    found, due = (cointoss.fit(observed, flat, **asked, device=one) for one in ("auto", "cpu"))
    assert found.values == due.values
    assert not card.given


@pytest.mark.parametrize("device", ["cuda", "auto"])
def test_a_batch_on_a_card_is_that_of_the_cpu(monkeypatch, tmp_path, device):
    monkeypatch.setattr(pieces, "LEAST_ON_CARD", 1000)
    card, due = with_card(monkeypatch), cointoss.toss_many(CASE, MANY)
    found = cointoss.toss_many(CASE, MANY, device=device)
    assert_same_tosses(found, due, card)
    # Pieces are large from the second on.
    first, *others, _ = card.given
    assert (first, sum(card.given)) == (pieces.FIRST, 4200)
    assert min(others) >= 1000
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
    monkeypatch.setitem(layout.TILE_TOSSES, Engine.ANALYTIC, SMALL)
    basin(coin, *AXES, "--out", tmp_path / "cpu.zarr")
    due, out = pixels(tmp_path / "cpu.zarr"), tmp_path / "card.zarr"
    with_card(monkeypatch, calls=3)
    told = refused("basin", coin, *AXES, "--out", out, "--device", "cuda")
    assert told == "cointoss: --device cuda: the card was lost; accepted: cpu, auto\n"
    assert np.sum(pixels(out)["outcome"] >= 0) == 3 * SMALL
    answered = basin(coin, *AXES, "--out", out, "--resume")
    assert (answered.exit_code, answered.stderr.count("\n")) == (0, 0)
    assert_same(out, due)


@pytest.mark.usefixtures("here")
def test_a_command_says_which_card_tossed_and_prints_the_same(monkeypatch, coin):
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
    with pytest.warns(DeviceWarning) as warned:
        found = cointoss.toss_many(CASE, MANY, device="auto")
    assert len(warned) == 1
    due = cointoss.toss_many(CASE, MANY)
    assert found.drop_attrs(deep=False).identical(due.drop_attrs(deep=False))
