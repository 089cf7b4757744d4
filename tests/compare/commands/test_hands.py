"""`cointoss hands`: where a coin is caught, and what is counted."""

import json

import numpy as np
import pytest

from cointoss.compare.output.hand_lines import WHY, hand_lines
from cointoss.models.hand import Hand
from cointoss.models.reading import load
from tests.helpers.command_line import cointoss, printed


def test_the_command_catches_where_it_or_the_scenario_says(tmp_path):
    """The scenario's height is that of the command without one, and the command's goes before."""
    path = tmp_path / "hand.toml"
    path.write_text(load("fig29").replace("air", {}, "ending.caught", 1.0).to_toml())
    arguments = ("--psi", "60 deg", "--tosses", "300")
    of_scenario = cointoss("hands", path, *arguments).stdout
    first, *rest = of_scenario.splitlines()
    assert first == (
        "How often the side that is up at the release (heads) is up in the hand that catches the coin:"
    )
    assert [line.partition(" ")[0] for line in rest] == ["caught", "left", "", "hand", "engine"]
    assert ", caught at 1 m\n" in of_scenario
    assert cointoss("hands", path, *arguments, "--caught", "100 cm").stdout == of_scenario
    lower = json.loads(cointoss("hands", path, *arguments, "--caught", "0.8 m", "--json").stdout)
    assert lower["caught"] == 0.8
    assert lower["same_side"]["caught"]["count"] == 300
    told = printed("hands", path, *arguments, "--caught", "5 m")
    assert told.splitlines()[1] == "left out  300 coins that never came down to the hand"
    assert json.loads(cointoss("hands", "fig29", "--tosses", "5", "--json").stdout)["caught"] is None


def test_the_command_counts_what_a_hand_tosses():
    arguments = ("hands", "fig29", "--psi", "60 deg", "--tosses", "60", "--height", "30 cm")
    answered = printed(*arguments)
    assert "\nat rest   100.00% [90.04%, 100.00%] of 60 tosses\n\nwhy " in answered
    assert max(map(len, answered.splitlines())) <= 110
    told = json.loads(cointoss(*arguments, "--json").stdout)
    assert told["hand"]["psi"] == pytest.approx(np.pi / 3)
    assert "cointoss" in told["versions"]
    assert told["same_side"]["at rest"]["value"] == 1


@pytest.mark.parametrize(
    ("hand", "changes"),
    [
        (Hand.people(), {"floor.contact": "perfectly_rough"}),
        (Hand.people(), {"floor.slope": 0.1}),
        (Hand.people(), {"floor.pivoting_friction": 1e-4}),
        (Hand.people(), {"coin.center_of_mass": (1e-4, 0, 0)}),
        (Hand.people(), {"ending.caught": 1.0}),
        (Hand(), {}),
    ],
    ids=["rough", "slope", "pivoting", "offset", "caught", "no wobble"],
)
def test_a_smooth_floor_explains_the_side_at_rest_only_where_it_keeps_the_momenta(hand, changes):
    coin = load("fig29")
    assert hand_lines(Hand.people(), coin, "analytic", 0).below[: len(WHY)] == WHY
    for field, value in changes.items():
        coin = coin.replace(field, value)
    assert WHY[0] not in hand_lines(hand, coin, "analytic", 0).below
