"""The verdict of a report: its words in every case, with the numbers of the comparison."""

from dataclasses import replace

import numpy as np
import pytest

import cointoss
from cointoss import coin_mj
from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.verdict import Kind, horizon_sentence, verdict_of
from cointoss.models.records import IMPACT_ROW, Ending, Face, Impacts, Outcome
from tests.helpers.draws import scenario
from tests.helpers.films import MadePath
from tests.helpers.films import made as made_by_formulas

TOSS = made_by_formulas(MadePath(position=(0, 0, 0.4)))
"""What the tosses of these tests are made of, with other impacts and endings."""


def made(sequence, outcome=Outcome.HEADS, *, engine="analytic", ending=Ending.SETTLED, contacts=()):
    rows = np.zeros(len(sequence), IMPACT_ROW)
    for i, symbol in enumerate(sequence):
        rows[i]["time"], rows[i]["face"] = 0.1 * (i + 1), Face.HEADS if symbol == "H" else Face.TAILS
    return replace(
        TOSS,
        engine=engine,
        impacts=Impacts.from_rows(rows),
        contacts=np.array(contacts, dtype=float).reshape(-1, 2),
        outcome=outcome,
        ending=ending,
        end_time=1.0,
        trusted_impacts=len(sequence),
    )


def compared(a, b, prefix, horizon):
    """Return a comparison of which two numbers are as given."""
    found = Comparison(
        name="made", text="", analytic=a, mujoco=replace(b, engine="mujoco"), settings=coin_mj.FINE
    )
    vars(found).update(common_prefix=prefix, horizon=horizon)
    return found


DECIDE = "tiny errors decide, and neither engine is wrong."
HEADS_TAILS = "Heads by the analytic engine, tails by MuJoCo:"
HEADS, TAILS = made("HHT"), made("HTT", Outcome.TAILS)
CAUGHT = made("", ending=Ending.CAUGHT)
CAUGHT_AFTER = made("HT", ending=Ending.CAUGHT)
CUT = made("HH", Outcome.UNDECIDED, ending=Ending.MAX_IMPACTS)
ROLLED = made("HH", contacts=[(0.5, 0.7)])
ROLLED_ON = made("HHH", Outcome.TAILS, contacts=[(0.5, 0.7)])


@pytest.mark.parametrize(
    ("a", "b", "prefix", "horizon", "kind", "text"),
    [
        (
            HEADS,
            HEADS,
            3,
            3,
            Kind.AGREE,
            "Heads by both engines: they agree on all 3 impacts, as they must.",
        ),
        (
            HEADS,
            HEADS,
            3,
            1,
            Kind.AGREE,
            f"Heads by both engines: they agree on all 3 impacts. The first must agree; after that {DECIDE}",
        ),
        (
            HEADS,
            made("HHTH"),
            3,
            2,
            Kind.DIFFER,
            "Heads by both engines: they agree on the first 3 impacts. The first 2 must agree; after that "
            f"{DECIDE}",
        ),
        (
            HEADS,
            TAILS,
            1,
            1,
            Kind.DIFFER,
            f"{HEADS_TAILS} they agree on the first impact, as they must; after that {DECIDE}",
        ),
        (
            HEADS,
            made("TTT", Outcome.TAILS),
            0,
            0,
            Kind.DIFFER,
            f"{HEADS_TAILS} they differ from the first impact on. Not even that must agree: {DECIDE}",
        ),
        (
            HEADS,
            TAILS,
            1,
            0,
            Kind.DIFFER,
            f"{HEADS_TAILS} they agree on the first impact. Not even the first must agree: {DECIDE}",
        ),
        (
            HEADS,
            TAILS,
            1,
            2,
            Kind.FAULT,
            f"{HEADS_TAILS} they differ at impact 2, although the first 2 impacts must agree. One engine is "
            "wrong: please report it.",
        ),
        (
            HEADS,
            replace(HEADS, outcome=Outcome.TAILS),
            3,
            3,
            Kind.FAULT,
            f"{HEADS_TAILS} they differ, although all 3 impacts must lead to the same. One engine is wrong: "
            "please report it.",
        ),
        (
            ROLLED,
            replace(ROLLED, outcome=Outcome.EDGE),
            2,
            2,
            Kind.DIFFER,
            "Heads by the analytic engine, on its edge by MuJoCo: they agree on both impacts, as they "
            "must; what the floor does after that decides.",
        ),
        (
            ROLLED,
            replace(ROLLED_ON, outcome=Outcome.HEADS),
            2,
            2,
            Kind.AGREE,
            "Heads by both engines: they agree on the 2 impacts that both count, as they must.",
        ),
        (
            ROLLED_ON,
            ROLLED,
            2,
            1,
            Kind.DIFFER,
            "Tails by the analytic engine, heads by MuJoCo: they agree on the first 2 impacts. The first "
            f"must agree; after that {DECIDE}",
        ),
        (
            CAUGHT,
            CAUGHT,
            0,
            0,
            Kind.AGREE,
            "Heads in the hand by both engines: the coin is caught before it touches the floor, so that "
            "nothing amplifies small errors.",
        ),
        (
            CAUGHT,
            replace(CAUGHT, outcome=Outcome.TAILS),
            0,
            0,
            Kind.FAULT,
            "Heads in the hand by the analytic engine, tails in the hand by MuJoCo: they differ, although "
            "the coin only flew. One engine is wrong: please report it.",
        ),
        (
            CAUGHT_AFTER,
            CAUGHT_AFTER,
            2,
            2,
            Kind.AGREE,
            "Heads in the hand by both engines: they agree on both impacts before it is caught, as they "
            "must.",
        ),
        (
            CAUGHT_AFTER,
            replace(CAUGHT_AFTER, outcome=Outcome.TAILS),
            2,
            2,
            Kind.DIFFER,
            "Heads in the hand by the analytic engine, tails in the hand by MuJoCo: they agree on both "
            "impacts before it is caught, as they must; the flight to the hand decides.",
        ),
        (
            CUT,
            CUT,
            2,
            2,
            Kind.AGREE,
            "Undecided by both engines: they agree on both impacts, as they must.",
        ),
        (
            made("", Outcome.UNDECIDED, ending=Ending.MAX_TIME),
            made("", Outcome.UNDECIDED, ending=Ending.MAX_TIME),
            0,
            0,
            Kind.AGREE,
            "Undecided by both engines: the coin does not touch the floor in the 1 s of the toss.",
        ),
    ],
)
def test_the_verdict_of_every_case(a, b, prefix, horizon, kind, text):
    assert verdict_of(compared(a, b, prefix, horizon)) == (text, kind)


def test_what_mujoco_cannot_toss_is_said():
    alone = Comparison(
        name="made", text="", analytic=HEADS, mujoco=None, not_realisable="no", settings=coin_mj.FINE
    )
    assert verdict_of(alone) == (
        "Heads by the analytic engine alone: MuJoCo can't toss this coin on this floor.",
        Kind.ALONE,
    )


@pytest.mark.parametrize(
    ("horizon", "begins"),
    [
        (3, "All faces must agree: errors"),
        (2, "The first 2 faces, up to the bar, must agree. Each"),
        (1, "The first face, up to the bar, must agree. Each"),
        (0, "Not even the first face must agree: errors"),
    ],
)
def test_the_horizon_is_told_in_plain_words(horizon, begins):
    told = horizon_sentence(compared(HEADS, HEADS, 3, horizon))
    assert told.startswith(begins)
    assert told.endswith(".")


def thrown(height, up):
    """Throw a coin up or down, flat, to be caught at 1.2 m, and compare both engines."""
    release = {"position": [0, 0, height], "velocity": [0, 0, up]}
    compared = cointoss.compare(scenario(release=release, ending={"caught": 1.2}))
    assert [toss.ending for toss in compared.both] == [Ending.CAUGHT, Ending.CAUGHT]
    return compared


def test_what_the_hand_cuts_short_is_said_of_real_tosses():
    flown, bounced = thrown(1.0, 3.0), thrown(1.0, -5.0)
    assert verdict_of(flown) == (
        "Heads in the hand by both engines: the coin is caught before it touches the floor, so that nothing "
        "amplifies small errors.",
        Kind.AGREE,
    )
    assert horizon_sentence(flown) == (
        "The coin is caught before its first impact: without an impact nothing amplifies small errors."
    )
    assert verdict_of(bounced) == (
        "Heads in the hand by both engines: they agree on its only impact before it is caught, as they must.",
        Kind.AGREE,
    )
    assert horizon_sentence(bounced) == (
        "All faces must agree: the coin is caught before errors as small as the engines’ own change one."
    )
