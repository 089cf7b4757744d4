"""What stands below a report's film: one sentence for each thing that the film does, of real tosses."""

import re
from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.page import render
from cointoss.models.records import Ending
from tests.helpers.draws import scenario
from tests.helpers.engines import toss

COLORS = "Gold with an H is heads, blue with a T is tails."
ARROWS = "a force’s up to twice the weight."
STRONG, HAND = "around each strong impact", "where the coin is caught"
SETTLED = {"release": {"position": [0, 0, 0.02]}}
FLOWN = {"release": {"position": [0, 0, 1.0], "velocity": [0, 0, 3.0]}, "ending": {"caught": 1.2}}
BOUNCED = {"release": {"position": [0, 0, 1.0], "velocity": [0, 0, -5.0]}, "ending": {"caught": 1.2}}
CUT = {"release": {"position": [0, 0, 0.1]}, "ending": {"max_impacts": 1}}
SHORT = {"ending": {"max_time": 0.1}}


def film_caption(tosses, **absent):
    """Return what stands below the film of a report."""
    shown = Comparison(name="made", text="", tosses=tuple(tosses), absent=absent)
    for pair in shown.against:
        vars(pair).update(common_prefix=0, common_horizon=0, errors=np.zeros(0))
    with patch("cointoss.compare.report.page.motion_of", return_value={}):
        page = render(shown, film=(b"", b""))
    (found,) = re.findall(r"id=\"film\".*?<figcaption>(.*?)<br>", page, re.DOTALL)
    return " ".join(found.split())


@pytest.mark.parametrize(
    ("parts", "ending", "slows", "ends"),
    [
        (SETTLED, Ending.SETTLED, {STRONG}, "It goes on at real speed when"),
        (FLOWN, Ending.CAUGHT, {HAND}, "It ends with the coin in the hand."),
        (BOUNCED, Ending.CAUGHT, {STRONG, HAND}, "It ends with the coin in the hand."),
        (CUT, Ending.MAX_IMPACTS, {STRONG}, "It ends as the toss"),
        (SHORT, Ending.MAX_TIME, set(), "It ends as the toss"),
    ],
)
def test_the_caption_says_what_the_film_shows(parts, ending, slows, ends):
    tosses = [toss(engine, scenario(**parts)) for engine in Engine]
    assert [each.ending for each in tosses] == [ending] * 2
    one = "The toss by the analytic engine, drawn by MuJoCo"
    for shown, absent, begins in (
        (tosses, {}, "Both tosses at the same times, drawn by MuJoCo. "),
        (tosses[:1], {}, f"{one}. "),
        (tosses[:1], {"mujoco": "no"}, f"{one}, which can’t toss it. "),
    ):
        told = film_caption(shown, **absent)
        assert told.startswith(begins)
        assert COLORS in told
        assert {place for place in (STRONG, HAND) if place in told} == slows
        assert ends in told
        assert told.endswith(ARROWS) == (STRONG in slows)
    several = film_caption([*tosses, replace(tosses[0], engine="off")])
    assert several == film_caption(tosses).replace("Both", "All").replace("both", "all")


def test_the_caption_says_that_a_slope_is_drawn_level():
    shown = toss(Engine.ANALYTIC, scenario(floor={"slope": "5 deg"}, **CUT))
    assert "It is drawn in the floor’s frame: x is downhill, by 5°." in film_caption([shown])
    assert "downhill" not in film_caption([toss(Engine.ANALYTIC, scenario(**CUT))])
