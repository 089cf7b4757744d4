"""The lab's page as a file, and the command that writes it; tests/site has the page in a browser."""

import json
import re
import webbrowser

import pytest

from cointoss.compare.lab import lab
from cointoss.compare.web.wasm import carried
from tests.helpers.command_line import cointoss as command
from tests.helpers.command_line import refused


def test_the_page_is_one_small_file_that_loads_nothing(tmp_path):
    target = tmp_path / "lab.html"
    answered = command("lab", "table", "--out", target)
    assert (answered.exit_code, answered.stdout) == (0, f"{target}\n"), answered.stderr
    text = target.read_text("utf-8")
    # Of three.js and an engine of 500 kB; its own scripts are small.
    assert 1_000_000 < len(text.encode()) < lab.MOST_BYTES
    assert "default-src 'none'" in text
    assert re.findall(r'(?:src|href)="(?!data:,|#)[^"]*"', text.partition('type="importmap"')[0]) == []
    held = json.loads(re.findall(r'id="data">(.*)</script>', text)[0])
    assert held["scenario"]["coin.mass"] == 0.0075
    assert held["outcomes"]["1"]["label"] == "heads"


PLAYED = ("toss", "table", "--max-impacts", 5, "--set", "restitution=0.3", "--play")


@pytest.mark.parametrize(
    ("words", "found", "begins"),
    [
        (["lab"], True, {"coin.mass": 0.002}),
        (["lab"], False, {"coin.mass": 0.002}),
        (PLAYED, True, {"coin.mass": 0.0075, "floor.restitution": 0.3, "ending.max_impacts": 5}),
        (PLAYED, False, {"coin.mass": 0.0075}),
    ],
)
def test_without_a_target_the_page_is_opened(monkeypatch, tmp_path, words, found, begins):
    opened = []
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or found)
    answered = command(*words)
    assert answered.exit_code == 0
    (page,) = tmp_path.glob("*/lab.html")
    told, _, last = answered.stdout.removesuffix("\n").rpartition("\n")
    assert (last, told.startswith("engine    analytic")) == (str(page), words[0] == "toss")
    assert opened == [page.as_uri()]
    held = json.loads(re.findall(r'id="data">(.*)</script>', page.read_text("utf-8"))[0])
    assert (held["tour"], held["scenario"] | begins) == (words[0] == "lab", held["scenario"])
    assert answered.stderr == (
        "" if found else "cointoss: no browser was found; open the file above in one\n"
    )


def test_an_engine_that_was_not_built_is_told_in_a_line(monkeypatch):
    monkeypatch.setattr(carried, "sources", lambda: "others")
    told = "cointoss: engine.wasm: not built, or of other sources; make report builds it\n"
    assert refused("lab") == told
