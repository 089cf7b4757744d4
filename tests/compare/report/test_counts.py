"""Why the engines count different numbers of impacts, in words."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss.compare.report.counts import counts_sentence
from cointoss.models.records import IMPACT_ROW, Impacts
from tests.helpers.films import MadePath, made

DYING = (
    "Until the coin first stays on the floor the engines count {} impacts: bounces that die out have "
    "no last one, and each engine takes the smallest for contact."
)


def bounced(count):
    """Return a toss with impacts at 1 s, 2 s, ..."""
    rows = np.zeros(count, IMPACT_ROW)
    rows["time"] = np.arange(1, count + 1)
    return replace(made(MadePath(position=(0, 0, 0.4))), impacts=Impacts.from_rows(rows))


def staying(first, after=0):
    """Return a toss with impacts before its first contact, and after it."""
    return replace(bounced(first + after), contacts=np.array([(first + 0.5, first + 0.7)]))


ONCE = "Once the coin has been in contact they count {}"
SPRING = (
    "{} and {}: MuJoCo’s contact is a spring, and lets go of the floor at other moments than a rigid one."
)


@pytest.mark.parametrize(
    ("tosses", "said"),
    [
        pytest.param([staying(4), staying(2)], DYING.format("4 and 2"), id="bounces die out"),
        pytest.param([staying(4), staying(2), staying(3)], DYING.format("4, 2 and 3"), id="of three engines"),
        pytest.param(
            [staying(3), staying(3, after=2)], ONCE.format(SPRING.format(0, 2)), id="after a contact"
        ),
        pytest.param(
            [staying(3, after=1), staying(2)],
            f"{DYING.format('3 and 2')} After that they count {SPRING.format(1, 0)}",
            id="before and after",
        ),
        pytest.param(
            [replace(staying(3), engine="a"), replace(staying(3, after=2), engine="b")],
            ONCE.format("0 and 2."),
            id="by no spring",
        ),
        pytest.param([staying(3)], "", id="one engine"),
        pytest.param([bounced(3), bounced(2)], "", id="no contact"),
        pytest.param([staying(3), staying(2, after=1)], "", id="as many in all"),
    ],
)
def test_counts_are_explained_where_a_contact_makes_them_differ(tosses, said):
    assert counts_sentence(tosses) == said
