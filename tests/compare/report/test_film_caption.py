"""What stands below a report's film: one sentence for each thing that the film does, of real tosses."""

import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.report.film_caption import ARROWS, COLORS, film_caption
from cointoss.models.records import Ending
from tests.helpers.draws import scenario
from tests.helpers.engines import toss

BOTH, ONE = (
    "Both tosses at the same times, drawn by MuJoCo.",
    "The toss by the analytic engine, drawn by MuJoCo, which can’t toss it.",
)
SETTLED = {"release": {"position": [0, 0, 0.02]}}
FLOWN = {"release": {"position": [0, 0, 1.0], "velocity": [0, 0, 3.0]}, "ending": {"caught": 1.2}}
BOUNCED = {"release": {"position": [0, 0, 1.0], "velocity": [0, 0, -5.0]}, "ending": {"caught": 1.2}}
CUT = {"release": {"position": [0, 0, 0.1]}, "ending": {"max_impacts": 1}}
SHORT = {"ending": {"max_time": 0.1}}


@pytest.mark.parametrize(
    ("parts", "ending", "says", "alone"),
    [
        (
            SETTLED,
            Ending.SETTLED,
            "The film slows down around each strong impact. It goes on at real speed when both faces are "
            f"settled, until the coins lie still or 2 s have passed. {ARROWS}",
            "The film slows down around each strong impact. It goes on at real speed when the face is "
            f"settled, until the coin lies still or 2 s have passed. {ARROWS}",
        ),
        (
            FLOWN,
            Ending.CAUGHT,
            "The film slows down where the coin is caught. It ends with the coin in the hand.",
            None,
        ),
        (
            BOUNCED,
            Ending.CAUGHT,
            "The film slows down around each strong impact and where the coin is caught. It ends with the "
            f"coin in the hand. {ARROWS}",
            None,
        ),
        (
            CUT,
            Ending.MAX_IMPACTS,
            f"The film slows down around each strong impact. It ends as the tosses do. {ARROWS}",
            f"The film slows down around each strong impact. It ends as the toss does. {ARROWS}",
        ),
        (SHORT, Ending.MAX_TIME, "It ends as the tosses do.", "It ends as the toss does."),
    ],
)
def test_the_caption_says_what_the_film_shows(parts, ending, says, alone):
    tosses = [toss(engine, scenario(**parts)) for engine in Engine]
    assert [each.ending for each in tosses] == [ending] * 2
    assert film_caption(tosses) == f"{BOTH} {COLORS} {says}"
    assert film_caption(tosses[:1]) == f"{ONE} {COLORS} {alone or says}"
