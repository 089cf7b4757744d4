"""Why the engines count different numbers of impacts, in words."""

from dataclasses import replace

import numpy as np

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


def test_bounces_that_die_out_are_counted_up_to_the_first_contact():
    assert counts_sentence([staying(4), staying(2)]) == DYING.format("4 and 2")
    assert counts_sentence([staying(4), staying(2), staying(3)]) == DYING.format("4, 2 and 3")


def test_impacts_after_a_contact_are_counted_for_themselves():
    said = (
        "they count {} and {}: MuJoCo’s contact is a spring, and lets go of the floor at other moments than "
        "a rigid one."
    )
    assert counts_sentence([staying(3), staying(3, after=2)]) == (
        f"Once the coin has been in contact {said.format(0, 2)}"
    )
    assert counts_sentence([staying(3, after=1), staying(2)]) == (
        f"{DYING.format('3 and 2')} After that {said.format(1, 0)}"
    )
    others = [replace(toss, engine=name) for toss, name in ((staying(3), "a"), (staying(3, after=2), "b"))]
    assert counts_sentence(others) == "Once the coin has been in contact they count 0 and 2."


def test_counts_that_need_no_reason_have_none():
    assert counts_sentence([staying(3)]) == ""
    assert counts_sentence([bounced(3), bounced(2)]) == ""
    assert counts_sentence([staying(3), staying(2, after=1)]) == ""
