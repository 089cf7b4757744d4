"""Shares and searches on a card, for which a stand-in tosses: the same counts, and what is refused."""

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


def test_shares_refuse_a_card_before_the_first_toss(monkeypatch):
    card = with_card(monkeypatch)
    for engine in ("mujoco", "both"):
        with pytest.raises(UnsupportedError, match=r"^`device` cuda: accepted by the MuJoCo engine:"):
            cointoss.shares(CASE, engine=engine, device="cuda")
    assert not card.given
    without_card(monkeypatch)
    with pytest.raises(DeviceError, match="no NVIDIA driver was found"):
        cointoss.shares(CASE, device="cuda")


def test_the_command_counts_on_a_card_and_prints_the_same(monkeypatch, coin):
    due = command("shares", coin, "--tosses", 300)
    card = with_card(monkeypatch)
    found = command("shares", coin, "--tosses", 300, "--device", "cuda")
    assert found.stdout == due.stdout
    handed = sum(n // 3 for n in card.given)
    assert found.stderr == f"cointoss: tossed by Stand-in, {handed} of 300 tosses handed over to the CPU\n"
    without_card(monkeypatch)
    told = refused("shares", coin, "--tosses", 300, "--device", "cuda")
    assert told == "cointoss: --device cuda: no NVIDIA driver was found; accepted: cpu, auto\n"


def test_a_card_tosses_to_the_outcome_that_is_sought(monkeypatch, coin):
    card, asked = with_card(monkeypatch), {"outcome": "heads", "sequence": "H", "tosses": 500}
    due = cointoss.find(CASE, WINDOW, **asked)
    assert not card.given
    found = cointoss.find(CASE, WINDOW, **asked, device="cuda")
    assert (found.scenario, found.rooms) == (due.scenario, due.rooms)
    assert found.target.processor.tossed == sum(card.given) > 0
    with pytest.raises(UnsupportedError, match=r"^`device` cuda: accepted for a sequence without"):
        cointoss.find(CASE, WINDOW, sequence="HT", device="cuda")
    words = ("find", coin, "--vary", "height=0.2:0.6", "--outcome", "heads", "--tosses", 200)
    here, there = (command(*words, "--device", one) for one in ("cpu", "cuda"))
    assert here.stdout == there.stdout
    assert there.stderr.startswith("cointoss: tossed by Stand-in, ")


def test_a_fit_is_made_by_the_cpu(monkeypatch):
    card, flat = with_card(monkeypatch), cointoss.load("fig24a").replace("air", {})
    times = cointoss.toss(flat).impacts.time[:3]
    observed = cointoss.Observed(touch_times=times, touch_sd=1e-4)
    asked: dict[str, Any] = {"vary": {"restitution": (0.7, 0.9)}, "starts": 16}
    with pytest.raises(UnsupportedError, match=r"^`device` cuda: accepted by a fit: cpu, auto$"):
        cointoss.fit(observed, flat, **asked, device="cuda")
    found, due = (cointoss.fit(observed, flat, **asked, device=one) for one in ("auto", "cpu"))
    assert found.values == due.values
    assert not card.given
