"""The verdict of a report: its words in every case, with the numbers of the comparison."""

import re
from dataclasses import replace

import numpy as np
import pytest

from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.verdict import VerdictKind, horizon_sentence, verdicts_of
from cointoss.models.records import IMPACT_ROW, Ending, Face, Impacts, OtherOutcome, Outcome, TrustEnd
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
        trust_end=TrustEnd.NONE,
    )


def compared(a, b, prefix, horizon, engine="mujoco", errors=()):
    """Return a comparison of which some numbers are as given, and its pair."""
    found = Comparison(name="made", text="", tosses=(a, replace(b, engine=engine)))
    vars(found[engine]).update(common_prefix=prefix, common_horizon=horizon, errors=np.array(errors))
    return found, found[engine]


TOSSES = {
    "HHT": made("HHT"),
    "sure": replace(made("HHT"), outcome_certain=True),
    "open": replace(made("HHT"), other_outcome=OtherOutcome(outcome=Outcome.EDGE, change=1.2e-16, impact=2)),
    "shaky": replace(made("HHT"), outcome_certain=False),
    "tested": replace(made("HHT", ending=Ending.PAPER), outcome_certain=True),
    "HTT": made("HTT", Outcome.TAILS),
    "HHTH": made("HHTH"),
    "TTT": made("TTT", Outcome.TAILS),
    "turned": made("HHT", Outcome.TAILS),
    "rolled": made("HH", contacts=[(0.5, 0.7)]),
    "rolled-upright": made("HH", Outcome.EDGE, contacts=[(0.5, 0.7)]),
    "rolled-on": made("HHH", contacts=[(0.5, 0.7)]),
    "rolled-over": made("HHH", Outcome.TAILS, contacts=[(0.5, 0.7)]),
    "caught": made("", ending=Ending.CAUGHT),
    "caught-turned": made("", Outcome.TAILS, ending=Ending.CAUGHT),
    "bounced-once": made("H", ending=Ending.CAUGHT),
    "bounced": made("HT", ending=Ending.CAUGHT),
    "bounced-turned": made("HT", Outcome.TAILS, ending=Ending.CAUGHT),
    "cut": made("HH", Outcome.UNDECIDED, ending=Ending.MAX_IMPACTS),
    "moving": made("HHT", Outcome.TRANSIENT, ending=Ending.TRANSIENT),
    "flying": made("", Outcome.UNDECIDED, ending=Ending.MAX_TIME),
}
VERDICTS = """
HHT HHT 3 3 AGREE
    Heads by both engines: they agree on all 3 impacts, as they must.
HHT HHT 3 1 AGREE
    Heads by both engines: they agree on all 3 impacts. The first must agree; after that DECIDE
sure HHT 3 1 AGREE
    Heads by both engines, and certain by the analytic one: they agree on all 3 impacts. The first must agree;
    after that MUJOCOS
open HHT 3 1 AGREE
    Heads by both engines: they agree on all 3 impacts. The first must agree; after that DECIDE Heads or on
    its edge: a change of 1e-16 after impact 2 decides.
sure HTT 1 1 DIFFER
    HEADS, TAILS: they agree on the first impact, as they must; after that MUJOCOS The analytic engine's own
    errors are too small to change its outcome.
sure turned 3 3 FAULT
    HEADS, TAILS: they differ, although all 3 impacts must lead to the same. FAULTY
shaky turned 3 3 DIFFER
    HEADS, TAILS: they agree on all 3 impacts, as they must; what the floor does after that decides.
tested tested 3 3 AGREE
    Heads by both engines, by a test that is no proof: they agree on all 3 impacts, as they must.
tested HHT 3 3 AGREE
    Heads by both engines: they agree on all 3 impacts, as they must.
HHT HHTH 3 2 DIFFER
    Heads by both engines: they agree on the first 3 impacts. The first 2 must agree; after that DECIDE
HHT HTT 1 1 DIFFER
    HEADS, TAILS: they agree on the first impact, as they must; after that DECIDE
HHT TTT 0 0 DIFFER
    HEADS, TAILS: they differ from the first impact on. Not even that must agree: DECIDE
HHT HTT 1 0 DIFFER
    HEADS, TAILS: they agree on the first impact. Not even the first must agree: DECIDE
HHT HTT 1 2 FAULT
    HEADS, TAILS: they differ at impact 2, although the first 2 impacts must agree. FAULTY
HHT turned 3 3 FAULT
    HEADS, TAILS: they differ, although all 3 impacts must lead to the same. FAULTY
rolled rolled-upright 2 2 DIFFER
    HEADS, on its edge by MuJoCo: they agree on both impacts, as they must; what the floor does after that
    decides.
rolled rolled-on 2 2 AGREE
    Heads by both engines: they agree on the first 2 impacts, as they must; after that MuJoCo counts 1 more.
rolled-on rolled 2 2 AGREE
    Heads by both engines: they agree on the first 2 impacts, as they must; after that the analytic engine
    counts 1 more.
rolled-over rolled 2 1 DIFFER
    Tails by the analytic engine, heads by MuJoCo: they agree on the first 2 impacts. The first must agree;
    after that DECIDE
caught caught 0 0 AGREE
    HELD by both engines: the coin is caught before it touches the floor, so that nothing amplifies small
    errors.
caught caught-turned 0 0 FAULT
    HELD by the analytic engine, tails in the hand by MuJoCo: they differ, although the coin only flew. FAULTY
bounced-once bounced-once 1 1 AGREE
    HELD by both engines: they agree on its only impact before it is caught, as they must.
bounced bounced 2 2 AGREE
    HELD by both engines: they agree on both impacts before it is caught, as they must.
bounced bounced-turned 2 2 DIFFER
    HELD by the analytic engine, tails in the hand by MuJoCo: they agree on both impacts before it is caught,
    as they must; the flight to the hand decides.
HHT moving 3 3 DIFFER
    Heads by the analytic engine, moving still by MuJoCo: they agree on all 3 impacts, as they must; what the
    floor does after that decides.
cut cut 2 2 AGREE
    Undecided by both engines: they agree on both impacts, as they must.
flying flying 0 0 AGREE
    Undecided by both engines: the coin does not touch the floor in the 1 s of the toss.
"""
"""Two tosses, how many impacts agree, how many must, and the verdict with its words."""
WORDS = {
    "DECIDE": "tiny errors decide, and neither engine is wrong.",
    "MUJOCOS": "MuJoCo’s own errors decide what it shows.",
    "HEADS": "Heads by the analytic engine",
    "TAILS": "tails by MuJoCo",
    "FAULTY": "One engine is wrong: please report it.",
    "HELD": "Heads in the hand",
}


@pytest.mark.parametrize(
    "case", re.split(r"\n(?! )", VERDICTS.strip()), ids=lambda case: case.splitlines()[0]
)
def test_the_verdict_of_every_case(case):
    first, *lines = case.splitlines()
    a, b, prefix, horizon, kind = first.split()
    text = re.sub("|".join(WORDS), lambda word: WORDS[word[0]], " ".join(map(str.strip, lines)))
    found, _ = compared(TOSSES[a], TOSSES[b], int(prefix), int(horizon))
    assert verdicts_of(found) == [("mujoco", text, VerdictKind[kind])]


ALONE = "Heads by the analytic engine alone: {} can't toss this coin on this floor."


@pytest.mark.parametrize(
    ("others", "absent", "verdicts"),
    [
        ([], ["mujoco"], [("analytic", ALONE.format("MuJoCo"), VerdictKind.ALONE)]),
        ([], ["mujoco", "off"], [("analytic", ALONE.format("MuJoCo and off"), VerdictKind.ALONE)]),
        (
            [("mujoco", "HHT", 3), ("off", "HTT", 1)],
            ["gone"],
            [
                (
                    "mujoco",
                    "Heads by the analytic engine and MuJoCo: they agree on all 3 impacts, as they must.",
                    VerdictKind.AGREE,
                ),
                (
                    "off",
                    "Heads by the analytic engine, tails by off: they agree on the first impact, as they "
                    f"must; after that {WORDS['DECIDE']}",
                    VerdictKind.DIFFER,
                ),
                ("gone", "gone can't toss this coin on this floor.", VerdictKind.ALONE),
            ],
        ),
    ],
)
def test_each_of_several_engines_has_a_verdict_that_names_it(others, absent, verdicts):
    tosses = [replace(TOSSES[b], engine=name) for name, b, _ in others]
    found = Comparison(
        name="made", text="", tosses=(TOSSES["HHT"], *tosses), absent=dict.fromkeys(absent, "no")
    )
    for name, _, horizon in others:
        vars(found[name]).update(common_prefix=horizon, common_horizon=horizon, errors=np.zeros(3))
    assert verdicts_of(found) == verdicts


@pytest.mark.parametrize(
    ("name", "horizon", "begins"),
    [
        ("HHT", 3, "All faces must agree: errors"),
        ("sure", 3, "All faces must agree: errors as small as MuJoCo’s change none"),
        ("sure", 0, "Not even the first face must agree: errors as small as MuJoCo’s can change it"),
        (
            "HHT",
            2,
            "The first 2 faces, up to the bar (the common horizon), must agree. Each impact amplifies small "
            "errors: after the bar errors as small as the engines’ own can change a face. By itself the "
            "analytic toss is trusted in 3 impacts, that of MuJoCo in 3.",
        ),
        ("HHT", 1, "The first face, up to the bar (the common horizon), must agree. Each"),
        ("HHT", 0, "Not even the first face must agree: errors"),
        ("bounced", 2, "All faces must agree: the coin is caught before errors as small as the engines’ own"),
        ("caught", 0, "The coin is caught before its first impact: without an impact nothing amplifies"),
    ],
)
def test_the_horizon_is_told_in_plain_words(name, horizon, begins):
    _, pair = compared(TOSSES[name], TOSSES[name], len(TOSSES[name].impacts), horizon)
    told = horizon_sentence(pair)
    assert told.startswith(begins)
    assert told.endswith(".")


SECOND_POINT = "at impact {} a second point lands within MuJoCo's contact."
TOLD = (
    "Not even the first face must agree: ",
    "The first face, up to the bar (the common horizon), must agree. A",
    "The first 2 faces, up to the bar (the common horizon), must agree. A",
)
"""How the sentence on a horizon of so many impacts begins."""


@pytest.mark.parametrize(
    ("b", "prefix", "horizon", "verdict"),
    [
        ("HHT", 3, 0, "Heads by both engines: they agree on all 3 impacts. Not even the first must agree: "),
        ("TTT", 0, 0, "HEADS, TAILS: they differ from the first impact on. Not even that must agree: "),
        ("HTT", 1, 1, "HEADS, TAILS: they agree on the first impact, as they must; "),
        ("HHTH", 3, 2, "Heads by both engines: they agree on the first 3 impacts. The first 2 must agree; "),
    ],
)
def test_an_impact_that_is_not_the_laws_is_named_where_it_ends_the_horizon(b, prefix, horizon, verdict):
    """There no tiny error decides: MuJoCo is wrong, and says so."""
    ends = replace(TOSSES[b], trusted_impacts=horizon, trust_end=TrustEnd.SECOND_POINT)
    told = TOLD[horizon]
    (found, pair), reason = compared(TOSSES["HHT"], ends, prefix, horizon), SECOND_POINT.format(horizon + 1)
    begins = verdict.replace("HEADS", WORDS["HEADS"]).replace("TAILS", WORDS["TAILS"])
    assert verdicts_of(found)[0].text == begins + reason
    own = f" By itself the analytic toss is trusted in 3 impacts, that of MuJoCo in {horizon}." * (
        horizon > 0
    )
    assert horizon_sentence(pair) == told + reason.removeprefix("a" if told.endswith("A") else "") + own
    earlier, pair = compared(TOSSES["HHT"], replace(ends, trusted_impacts=horizon + 1), prefix, horizon)
    assert "tiny errors" in verdicts_of(earlier)[0].text
    assert "errors" in horizon_sentence(pair)


THERE = "within the horizon: off is wrong there"


@pytest.mark.parametrize(
    ("b", "prefix", "horizon", "errors", "kind", "says"),
    [
        (
            *("HTT", 0, 1, 0.34, VerdictKind.FAULT),
            f"they differ at impact 1, {THERE} (before impact 1 its flight is 34 % off).",
        ),
        (
            *("HHT", 3, 3, 0.34, VerdictKind.AGREE),
            "as they must. Before impact 1 the flight of off is 34 % off.",
        ),
        (
            *("HTT", 1, 2, [0.68, 0.1], VerdictKind.FAULT),
            f"they differ at impact 2, {THERE} (at impact 1 its impulse is 68 % off the contact law).",
        ),
        ("HTT", 1, 2, [1e-6, 1e-6], VerdictKind.FAULT, f"they differ at impact 2, {THERE}."),
        (
            *("turned", 3, 3, [1e-6, 0.02, 0.3], VerdictKind.FAULT),
            "off is wrong there (at impact 2 its impulse is 2 % off the contact law).",
        ),
        (
            *("HTT", 1, 1, [np.inf], VerdictKind.DIFFER),
            "as they must; at impact 1 the impulse of off is nothing like that of the contact law.",
        ),
        (
            *("HTT", 1, 1, [1e-6, 0.5], VerdictKind.DIFFER),
            "as they must; after that tiny errors decide, and neither engine is wrong.",
        ),
    ],
)
def test_another_engine_is_told_where_its_impulse_misses_the_law(b, prefix, horizon, errors, kind, says):
    """Within the horizon the fault is its own, and no report is asked for; a number is its flight's error."""
    of_flight = errors if isinstance(errors, float) else 0.0
    found, pair = compared(
        TOSSES["HHT"], TOSSES[b], prefix, horizon, "off", np.zeros(3) if of_flight else errors
    )
    vars(pair).update(flight_error=of_flight)
    (verdict,) = verdicts_of(found)
    assert verdict.kind == kind
    assert verdict.text.endswith(says)
