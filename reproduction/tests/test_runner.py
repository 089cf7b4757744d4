"""`cointoss reproduce`: the list, unknown names, places in the way, failed claims, files that are whole."""

import json
import subprocess
import sys

import pytest

from cointoss_reproduction.frame import provenance, runner
from saved import fake
from tests.helpers.cards import with_card, without_card
from tests.helpers.command_line import cointoss, refused

CODE = """
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study

def cell():
    return {{"sum": {sum}}}

REPRODUCTION = study(__name__, Cells(cell, {{}}))
"""
SAID = """
title = "a fake"
seconds = 0

[[table]]
says = "as **drawn**"
columns = [["sum", "sum"]]

[measure.sum]
value = "sum"

[[claim]]
claim = "two and two are five"
criteria = [["sum", "sum", "=", 5, "five"]]
"""
SUMS = {"good": "5", "doubtful": "4", "broken": "(_ for _ in ()).throw(KeyboardInterrupt)"}


@pytest.fixture
def fakes(tmp_path, monkeypatch):
    for name, value in SUMS.items():
        fake(monkeypatch, tmp_path / "studies", f"fake_{name}", CODE.format(sum=value), SAID)


def test_names_are_listed_without_importing_what_they_name():
    script = """
import atexit, sys
from cointoss.compare.cli import main

heavy = {"numba", "numpy", "matplotlib", "mujoco", "cointoss_reproduction.studies.contact_laws.study"}
atexit.register(lambda: print(heavy & set(sys.modules)))
main(["reproduce"])
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "\ncontact-laws " in done.stdout
    assert done.stdout.splitlines()[-1] == "set()"


@pytest.mark.usefixtures("fakes")
def test_a_claim_that_fails_is_exit_status_1_and_keeps_the_evidence(tmp_path):
    old = tmp_path / "reproduction" / "fake-good"
    old.mkdir(parents=True)
    for name in ("cells.csv", "data.npz", "mine.txt"):
        (old / name).write_text("old")
    answered = cointoss("reproduce", "fake-doubtful", "fake-good", "--out", tmp_path)
    assert answered.exit_code == 1
    counts = [line for line in answered.stdout.splitlines() if line.startswith("fake-")]
    assert counts == ["fake-doubtful: 1 does not hold", "fake-good: 1 holds"]
    assert answered.stdout.startswith("as drawn\n\nsum\n───\n4\n\n✗ does not hold: two and two are five\n")
    told = "cointoss: fake-doubtful: two and two are five: another verdict than the known one\n"
    assert answered.stderr == told
    assert (old.with_name("fake-doubtful") / "cells.csv").read_text() == "sum\n4\n"
    kept = {path.name: path.read_text() for path in old.iterdir()}
    assert sorted(kept) == ["cells.csv", "claims.json", "index.md", "mine.txt", "provenance.json"]
    assert (kept["cells.csv"], kept["mine.txt"]) == ("sum\n5\n", "old")


INTERRUPTED = """
from pathlib import Path

def cell(number):
    mark = Path(__file__).with_name(f"{number}")
    if number == 1 and not mark.exists():
        mark.touch()
        raise KeyboardInterrupt
    mark.write_text(mark.read_text() + "x" if mark.exists() else "x")
    return {"sum": 5}
"""


def test_an_interrupted_study_goes_on_where_it_was_and_a_finished_one_leaves_no_parts(tmp_path, monkeypatch):
    code = INTERRUPTED + CODE.replace('def cell():\n    return {{"sum": {sum}}}\n', "").format()
    said = SAID.replace('value = "sum"', 'value = "sum"\ntake = "max"')
    fake(
        monkeypatch, tmp_path / "studies", "long", code.replace("cell, {}", "cell, {'number': (0, 1)}"), said
    )
    folder = tmp_path / "reproduction" / "long"
    assert cointoss("reproduce", "long", "--out", tmp_path).exit_code == 130
    assert [path.name for path in folder.iterdir()] == ["parts"]
    assert cointoss("reproduce", "long", "--out", tmp_path).exit_code == 0
    assert (tmp_path / "studies" / "long" / "0").read_text() == "x"
    left = sorted(path.name for path in folder.iterdir())
    assert left == ["cells.csv", "claims.json", "index.md", "provenance.json"]


@pytest.mark.usefixtures("fakes")
def test_what_is_in_the_way_is_refused_before_any_work(tmp_path):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "out" / "reproduction").mkdir(parents=True)
    (tmp_path / "out" / "reproduction" / "fake-broken").write_text("mine")
    (tmp_path / "taken" / "reproduction" / "fake-broken" / "data.npz").mkdir(parents=True)
    for out, named in (
        (tmp_path / "file", "file: is no folder; accepted: a folder"),
        (tmp_path / "out", "fake-broken: is no folder; accepted: a folder"),
        (tmp_path / "taken", "data.npz: is a folder; accepted: a new name or a regular file"),
    ):
        # Run, the good one would print and the broken one would abort.
        assert named in refused("reproduce", "fake-good", "fake-broken", "--out", out)
    for kept in (tmp_path / "file", tmp_path / "out" / "reproduction" / "fake-broken"):
        assert kept.read_text() == "mine"
    assert not (tmp_path / "out" / "reproduction" / "fake-good").exists()


def older(*names):
    answered = cointoss("reproduce", *names)
    return answered.exit_code, answered.stdout.splitlines()


@pytest.mark.usefixtures("fakes")
def test_results_of_other_engines_are_listed_as_older(tmp_path, monkeypatch):
    assert cointoss("reproduce", "fake-good", "--out", tmp_path).exit_code == 0
    assert older("fake-good", "--older", tmp_path) == (0, [])
    status, lines = older("fake-good", "fake-doubtful", "--older", tmp_path)
    assert (status, len(lines)) == (1, 1)
    assert "fake-doubtful: holds no claims.json" in lines[0]
    status, lines = older("--older", tmp_path)
    assert len(lines) == len(runner.names()) - 1
    monkeypatch.setattr(provenance, "fingerprints", lambda: {"analytic": "new", "mujoco": "new"})
    assert older("fake-good", "--older", tmp_path) == (1, ["fake-good: is older than analytic and mujoco"])
    path = tmp_path / "reproduction" / "fake-good" / "provenance.json"
    made_of = json.loads(path.read_text())
    del made_of["engines"]
    path.write_text(json.dumps(made_of))
    unsaid = (1, ["fake-good: does not say by which engines it was made"])
    assert older("fake-good", "--older", tmp_path) == unsaid
    path.unlink()
    assert older("fake-good", "--older", tmp_path) == unsaid
    path.write_text("[]")
    assert "provenance.json: needs sources" in older("fake-good", "--older", tmp_path)[1][0]
    assert cointoss("reproduce", "fake-good", "--older", tmp_path, "--out", tmp_path).exit_code == 2


TOSSED = """
import numpy as np
from cointoss import analytic, load
from cointoss.study import rows_of

def outcomes():
    spins = {{"release.angular_velocity.eta": np.linspace(20, 40, 9)}}
    return analytic.toss_rows(rows_of(load("fig24a"), 9, spins)).outcome
"""


@pytest.mark.slow
def test_a_study_is_tossed_on_the_device_that_is_asked_for(tmp_path, monkeypatch):
    """By a stand-in for a card, which hands a third of the tosses over to the CPU."""
    card, code = with_card(monkeypatch), (TOSSED + CODE).format(sum="int(outcomes().sum())")
    fake(monkeypatch, tmp_path / "studies", "fake_tossed", code, SAID)
    asked = ("reproduce", "fake-tossed", "--out", tmp_path / "out")
    due = cointoss(*asked)
    provenance.fingerprints.cache_clear()  # the tosses by which a run knows its engines are the CPU's
    found = cointoss(*asked, "--device", "cuda")
    assert (found.exit_code, found.stdout) == (due.exit_code, due.stdout)
    assert card.given == [9]
    assert found.stderr.endswith("cointoss: tossed by Stand-in, 3 of 9 tosses handed over to the CPU\n")
    without_card(monkeypatch)
    assert refused(*asked, "--device", "cuda").startswith(
        "cointoss: --device cuda: no NVIDIA driver was found"
    )
