"""`cointoss shares`: what it prints and writes, the hand's options, and Ctrl-C."""

import csv
import json
import math
import signal
from unittest.mock import Mock

import pytest

from cointoss.compare.commands import hands
from cointoss.compare.output.interruption import Interruption
from cointoss.compare.shares import counting
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import Hand
from tests.helpers.command_line import cointoss


def test_by_default_a_coin_is_tossed_as_people_do_unless_the_hand_is_described(coin, tmp_path):
    """Whoever says ψ, spins the coin, or has a hand's file means a hand of their own."""
    file = tmp_path / "hand.toml"
    file.write_text('speed = "1 m/s"\n')
    hands = {
        (): Hand.people(),
        ("--spin", "50 rad/s"): Hand.people(spin=50.0),
        ("--psi-scatter", "0"): Hand(),
        ("--psi", "90 deg"): Hand(psi=math.pi / 2),
        ("--spun",): Hand(spun=True),
        ("--hand", file): Hand(speed=1.0),
    }
    for words, hand in hands.items():
        for command in ("shares", "hands"):
            told = json.loads(cointoss(command, coin, *words, "--tosses", 2, "--json").stdout)
            assert Hand(**told["hand"]) == hand, words


def test_the_side_that_was_up_is_counted_whichever_it_was(coin):
    words = ("hands", coin, "--psi", "50 deg", "--caught", "1 m", "--tosses", 4000, "--json")
    heads, either = (
        json.loads(cointoss(*words, "--up", up).stdout)["same_side"]["caught"] for up in ("heads", "either")
    )
    assert heads["low"] < either["value"] < heads["high"]
    assert heads["low"] > 0.6


@pytest.mark.parametrize(
    ("words", "home", "name", "counted", "shown", "rows"),
    [
        (
            ("shares", "--vary", "floor.restitution=0.3:0.6:3", "--out", "a.csv", "--out", "a.png"),
            *(counting, "counting", 250, "250", ["250", "0", "0"]),
        ),
        (("hands", "--tosses", 1000), hands, "first_sides", 40, "] of 40 tosses\n", []),
    ],
    ids=["shares", "hands"],
)
def test_an_interruption_prints_and_writes_what_is_counted(
    coin, here, monkeypatch, words, home, name, counted, shown, rows
):
    own = getattr(home, name)

    def interrupted(*given):
        yield next(own(*given))
        raise Interruption(signal.SIGINT)

    monkeypatch.setattr(home, name, interrupted)
    monkeypatch.setitem(hands.BLOCK, "analytic", 40)
    answered = cointoss(words[0], coin, *words[1:])
    assert isinstance(answered.exception, Interruption)
    assert answered.exception.message == f"interrupted by SIGINT: {counted} tosses are counted"
    assert shown in answered.stdout
    tables = [path.read_text().splitlines() for path in here.glob("a.*")]
    assert [row["tosses"] for table in tables for row in csv.DictReader(table)] == rows


def test_a_coin_that_does_not_turn_shows_its_first_side_at_every_touch(coin):
    words = ("hands", coin, "--spin", "0", "--scatter", "0", "--psi", "0", "--tosses", 20, "--json")
    told = json.loads(cointoss(*words).stdout)
    touches = [f"touch {number}" for number in range(1, 5)]
    shares = {name: (one["value"], one["count"]) for name, one in told["same_side"].items()}
    assert shares == dict.fromkeys([*touches, "at rest"], (1, 20))


def test_coins_that_never_come_to_the_hand_are_left_out(coin):
    """With 2 m/s from 1 m a coin rises to 1.2 m, by half of the hands above it."""
    words = ("hands", coin, "--caught", "1.2 m", "--tosses", 200, "--json")
    told = json.loads(cointoss(*words).stdout)
    assert 50 < told["not_caught"] < 150
    assert told["same_side"]["caught"]["count"] + told["not_caught"] == told["tosses"] == 200


def test_blocks_count_what_all_tosses_at_once_do(coin, monkeypatch):
    whole = cointoss("hands", coin, "--tosses", 130, "--json").stdout
    monkeypatch.setitem(hands.BLOCK, "analytic", 37)
    assert cointoss("hands", coin, "--tosses", 130, "--json").stdout == whole


def test_where_nothing_is_counted_no_answer_is_printed(coin, monkeypatch):
    monkeypatch.setattr(hands, "first_sides", Mock(side_effect=SweepError("no toss")))
    assert cointoss("hands", coin).stdout == ""
