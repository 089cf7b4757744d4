"""`cointoss find`: what it prints is a scenario; its exit status is 1 where there is none."""

import json

import numpy as np

from cointoss import __version__
from cointoss.compare.find.window import window_of
from cointoss.models.parts import LARGEST
from cointoss.models.reading import load, parse
from tests.helpers.command_line import cointoss

VARY = ("--vary", "release.position.z=0.3:0.5", "--tosses", 512)


def test_what_is_printed_or_written_is_the_scenario_of_the_toss(tmp_path):
    printed = cointoss("find", "fig24a", "--sequence", "HT", *VARY)
    assert printed.exit_code == 0, printed.stderr
    out = tmp_path / "ht.toml"
    written = cointoss("find", "fig24a", "--sequence", "HT", *VARY, "--out", out)
    assert parse(printed.stdout, "printed") == load(out)
    assert written.stdout.endswith(f"scenario: {out}\n")
    tossed = json.loads(cointoss("toss", out, "--json").stdout)
    assert tossed["sequence"].startswith("HT")
    told = json.loads(cointoss("find", "fig24a", "--sequence", "HT", *VARY, "--json").stdout)
    assert told["versions"]["cointoss"] == __version__
    assert told["found"]["release"]["position"] == list(load(out).release.position)
    assert told["margins"]["release.position.z"]["down"] > 0
    assert told["trusted"] == 2


def test_none_is_said_and_has_a_status_of_its_own(tmp_path):
    words = ("find", "fig24a", "--sequence", "TT", "--vary", "release.position.z=0.2:0.2001", "--tosses", 300)
    out = tmp_path / "tt.toml"
    answered = cointoss(*words, "--out", out)
    assert answered.exit_code == 1
    assert answered.stdout.startswith("none in 300 tosses, covering release.position.z from 0.2 to 0.2001 m")
    assert not out.exists()
    assert json.loads(cointoss(*words, "--json").stdout)["found"] is None


def test_margins_are_looked_for_in_numbers_that_a_release_can_have():
    window = window_of({"release.position.z": (-1e9, 1e9)}, load("fig24a"))
    # A margin may be as wide as the window, to either side.
    assert window.values(np.array([[-1.0], [0.75], [2.0]])).ravel().tolist() == [-LARGEST, 5e8, LARGEST]
    assert window.rows(window.values(np.array([[-1.0], [2.0]])))[1].tolist() == [False, True]
