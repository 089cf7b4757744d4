"""Scenarios, hands and settings: every way to get one wrong is one line, which says what is accepted."""

import json
import os
import tomllib
from functools import partial
from pathlib import Path

import pytest

from cointoss.analytic.settings import AnalyticSettings
from cointoss.models.errors import ScenarioError
from cointoss.models.hand import Hand, load_hand
from cointoss.models.reading import load, parse
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, scenario

GOOD = Path(__file__).with_name("good.toml").read_text(encoding="utf-8")
HERE = scenario(air=AIR, release={"angles": [0.1, 0.2, 0.3]})


def read(old: str, new: str) -> Scenario:
    """Return `GOOD` with something replaced, or with a line more."""
    assert old in GOOD
    line = f"{old}\n{new[2:]}" if new.startswith("+ ") else new
    return parse(GOOD.replace(old, line.replace("; ", "\n")), "given.toml")


def read_hand(text: str) -> Hand:
    """Return the hand of a file with this text."""
    Path("given.toml").write_text(text.replace("; ", "\n"))
    return load_hand("given.toml")


TABLES = tomllib.loads(Path(__file__).with_name("refusals.toml").read_text(encoding="utf-8"))
OF_FILES = [(partial(read, old), lines) for old, lines in TABLES["file"].items()]
OTHERS = [
    (read_hand, TABLES["hand"]),
    (lambda arguments: HERE.replace(*json.loads(arguments)), TABLES["change"]),
    (lambda arguments: AnalyticSettings(**json.loads(arguments)), TABLES["settings"]),
]
UNKNOWN = "unknown key; accepted: test, max_impacts, max_time, caught, until"
NESTED = "{'a': "
LONG = {
    "x = " + 1900 * "[": "nested too deeply; accepted: tables of numbers and lists",
    ".".join(900 * "a") + " = 1": f"ending.a = {(13 * NESTED)[:77]}...: {UNKNOWN}",
    ".".join(50_000 * "a") + " = 1": "line 16 has 100003 characters; accepted: at most 2000",
    ".".join(20_000 * ['"\u2028"']) + " = 1": "line 16 has 80003 characters; accepted: at most 2000",
    "x = " + 1900 * "9": f"ending.x = {77 * '9'}...: {UNKNOWN}",
    "x = 0x" + 1900 * "f": f"ending.x = {str(16**1900 - 1)[:77]}...: {UNKNOWN}",
    'y = "' + 1900 * "9" + '"': 'ending.y = "' + f"{76 * '9'}...: {UNKNOWN}",
    "\n".join(f"key{i} = {i}" for i in range(500)): f"ending.key0 = 0: {UNKNOWN} (also wrong: "
    + ", ".join(f"ending.key{i}" for i in range(1, 9))
    + ", and 491 more)",
}
CASES = [
    (make, given, line)
    for make, lines in [*OF_FILES, *OTHERS, (partial(read, "max_impacts = 20"), LONG)]
    for given, line in lines.items()
]


@pytest.mark.parametrize(("make", "given", "line"), CASES, ids=[given[:40] for _, given, _ in CASES])
@pytest.mark.usefixtures("here")
def test_what_is_wrong_is_answered_in_one_line(make, given, line):
    with pytest.raises(ValueError, match=r"^[^\n]*$") as refused:
        make(given)
    assert str(refused.value).removeprefix("given.toml: ") == line


@pytest.mark.parametrize("kind", [load, load_hand])
def test_a_file_that_is_not_there_or_that_nobody_writes_to_is_told(tmp_path, kind):
    with pytest.raises(ScenarioError, match=r"coin.toml: (no such file|can't be read).*; accepted: "):
        kind(tmp_path / "coin.toml")
    os.mkfifo(tmp_path / "coin.toml")
    with pytest.raises(ScenarioError, match=r"coin.toml: can't be read \(a pipe that nobody writes to\);"):
        kind(tmp_path / "coin.toml")
