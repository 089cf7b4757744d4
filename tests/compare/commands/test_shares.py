"""`cointoss shares`: what it prints and writes, the hand's options, and Ctrl-C."""

import csv
import io
import json
import math
import signal

import pytest

from cointoss.compare.commands import hands
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import Hand
from tests.helpers.command_line import cointoss
from tests.helpers.processes import answered, ask, started, wait_until


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


@pytest.mark.slow
def test_ctrl_c_prints_and_writes_what_is_counted(coin, tmp_path):
    script = """
import time
from pathlib import Path
from cointoss.compare.shares import counting
whole = counting.counting
def slow(*given):
    yield next(whole(*given))
    Path("begun").touch()
    time.sleep(1000)
counting.counting = slow
from cointoss.compare.cli import main
main()
"""
    words = ("shares", coin, "--vary", "floor.restitution=0.3:0.6:3", "--out", "a.csv", "--out", "a.png")
    with started("-c", script, *words, cwd=tmp_path) as process:
        wait_until(process, (tmp_path / "begun").exists)
        ask(process, signal.SIGINT)
        printed, said = answered(process)
    assert process.returncode == 130, said
    assert said.endswith("cointoss: interrupted by SIGINT: 250 tosses are counted\n")
    rows = list(csv.DictReader(io.StringIO((tmp_path / "a.csv").read_text())))
    assert [row["tosses"] for row in rows] == ["250", "0", "0"]
    assert "250" in printed
    assert not (tmp_path / "a.png").exists()


@pytest.mark.slow
def test_ctrl_c_prints_what_hands_have_counted_until_then(coin, tmp_path):
    """The third block is never tossed; `begun` is there from then on."""
    script = """
import time
from pathlib import Path
from cointoss.compare.commands import hands
from cointoss.compare.metrics import first_side
tossed, own = [], first_side.first_side
hands.BLOCK["analytic"] = 40
def slow(*words):
    tossed.append(1)
    if len(tossed) > 2:
        Path("begun").touch()
        time.sleep(1000)
    return own(*words)
first_side.first_side = slow
from cointoss.compare.cli import main
main()
"""
    with started("-c", script, "hands", coin, "--tosses", "1000", cwd=tmp_path) as process:
        wait_until(process, (tmp_path / "begun").exists)
        ask(process, signal.SIGINT)
        printed, said = answered(process)
    assert process.returncode == 130, said
    assert said.endswith("cointoss: interrupted by SIGINT: 80 tosses are counted\n")
    assert [line.split(" of ")[-1] for line in printed.splitlines()[1:5]] == 4 * ["80 tosses"]


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
    caught = told["same_side"]["caught"]
    assert 50 < told["not_caught"] < 150
    assert caught["count"] + told["not_caught"] == told["tosses"] == 200


def test_blocks_count_what_all_tosses_at_once_do(coin, monkeypatch):
    whole = cointoss("hands", coin, "--tosses", 130, "--json").stdout
    monkeypatch.setitem(hands.BLOCK, "analytic", 37)
    assert cointoss("hands", coin, "--tosses", 130, "--json").stdout == whole


def test_where_nothing_is_counted_no_answer_is_printed(coin, monkeypatch):
    def refused(_):
        raise SweepError("no toss")

    monkeypatch.setattr(hands, "first_sides", refused)
    assert cointoss("hands", coin).stdout == ""
