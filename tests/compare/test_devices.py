"""Shares and searches on a card, for which a stand-in tosses: the same counts, and what is refused."""

from collections.abc import Callable
from functools import partial
from typing import Any

import pytest

import cointoss
from cointoss.models.devices import DeviceError
from cointoss.models.records import UnsupportedError
from tests.helpers.cards import with_card, without_card
from tests.helpers.command_line import cointoss as command
from tests.helpers.command_line import refused

CASE = cointoss.load("fig24a").replace("ending.max_impacts", 2)
WINDOW = {"height": (0.2, 0.6), "spin": (20, 60)}
AIR = {"air.exponent": [0.0, 0.5], "air.normal": 0.1}
FEW = {"height": "0.2:0.6:30"}
HEARD = cointoss.Observed(touch_times=[0.3], touch_sd=1e-4)
BY_MUJOCO = r"^`device` cuda: accepted by the MuJoCo engine: cpu, auto$"
REFUSED: dict[str, tuple[Callable[[Any], Any], str]] = {
    "air": (
        lambda out: cointoss.toss_many(CASE, AIR, device="cuda", out=out),
        "^air.exponent = 0.5: accepted w",
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
def test_without_a_card_it_is_refused_and_so_is_another_device(monkeypatch, call):
    without_card(monkeypatch)
    with pytest.raises(DeviceError, match="no NVIDIA driver was found"):
        call(device="cuda")
    with pytest.raises(ValueError, match=r"^device: 'gpu', accepted: cpu, cuda, auto$"):
        call(device="gpu")


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


@pytest.mark.slow
@pytest.mark.parametrize("device", ["cuda", "auto"])
def test_shares_on_a_card_are_those_of_the_cpu(monkeypatch, device):
    card, asked = with_card(monkeypatch), {"vary": {"restitution": "0.2:0.8:4"}, "tosses": 1100}
    found, due = (cointoss.shares(CASE, **asked, device=one) for one in (device, "cpu"))
    assert found.drop_attrs(deep=False).identical(due.drop_attrs(deep=False))
    assert sum(card.given) == 4400
    assert (due.attrs["device"], due.attrs["handed_over"]) == ("cpu", 0)
    assert found.attrs["device"] == "Stand-in"
    assert found.attrs["handed_over"] == sum(n // 3 for n in card.given)


def test_the_command_counts_on_a_card_and_prints_the_same(monkeypatch, coin):
    due = command("shares", coin, "--tosses", 300)
    card = with_card(monkeypatch)
    found = command("shares", coin, "--tosses", 300, "--device", "cuda")
    assert found.stdout == due.stdout
    handed = sum(n // 3 for n in card.given)
    assert found.stderr == f"cointoss: tossed by Stand-in, {handed} of 300 tosses handed over to the CPU\n"


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
