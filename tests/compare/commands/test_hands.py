"""`cointoss hands`: where a coin is caught, and what is counted."""

import json

import numpy as np
import pytest

from cointoss.models.reading import load
from tests.helpers.command_line import cointoss


def test_the_command_catches_where_it_or_the_scenario_says(tmp_path):
    """The scenario's height is that of the command without one, and the command's goes before."""
    path = tmp_path / "hand.toml"
    path.write_text(load("fig29").replace("air", {}, "ending.caught", 1.0).to_toml())
    arguments = ("--psi", "60 deg", "--tosses", "300")
    of_scenario = cointoss("hands", path, *arguments).stdout
    assert [line.split()[0] for line in of_scenario.splitlines()] == ["caught", "left"]
    assert cointoss("hands", path, *arguments, "--caught", "100 cm").stdout == of_scenario
    lower = json.loads(cointoss("hands", path, *arguments, "--caught", "0.8 m", "--json").stdout)
    assert lower["caught"] == 0.8
    assert lower["same_side"]["caught"]["count"] == 300
    told = cointoss("hands", path, *arguments, "--caught", "5 m")
    assert (told.exit_code, told.stdout) == (0, "left out  300 coins that never came down to the hand\n")
    assert json.loads(cointoss("hands", "fig29", "--tosses", "5", "--json").stdout)["caught"] is None


def test_the_command_counts_what_a_hand_tosses():
    arguments = ("hands", "fig29", "--psi", "60 deg", "--tosses", "60", "--height", "30 cm")
    answered = cointoss(*arguments)
    assert answered.exit_code == 0
    assert answered.stdout.splitlines()[-1] == "at rest   100.00% [90.04%, 100.00%] of 60 tosses"
    told = json.loads(cointoss(*arguments, "--json").stdout)
    assert told["hand"]["psi"] == pytest.approx(np.pi / 3)
    assert "cointoss" in told["versions"]
    assert told["same_side"]["at rest"]["value"] == 1
