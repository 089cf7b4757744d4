"""What is said of a toss: no two of its words deny each other, whatever its outcome, ending and trust."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.verdict import VerdictKind, horizon_sentence, verdicts_of
from cointoss.models.records import IMPACT_ROW, Ending, Impacts, OtherOutcome, Outcome, TrustEnd
from tests.helpers.films import MadePath
from tests.helpers.films import made as made_by_formulas

TOSS = made_by_formulas(MadePath(position=(0, 0, 0.4)))
PROVED = {Ending.SETTLED, Ending.LYING, Ending.AT_REST, Ending.CAUGHT, Ending.PERIODIC}
"""What leaves nothing open."""
OPEN = {
    Ending.PAPER: "but a later impact may add some",
    Ending.PAPER_SMOOTH: "the paper's eq. (20)",
    Ending.PERPETUAL: "extrapolated",
    Ending.ROLLING: "still rolls",
    Ending.STANDING: "by all evidence",
    Ending.NONE: "goes on",
    Ending.MAX_IMPACTS: "raise it to go on",
    Ending.MAX_TIME: "raise it to go on",
    Ending.CHATTER: "not followed",
    Ending.NO_SOLUTION: "no solution",
    Ending.CONTACT_STEPS: "raise it to go on",
    Ending.FLIGHT_STEPS: "raise it to go on",
    Ending.NOT_CAUGHT: "never came down",
    Ending.TRANSIENT: "neither settled",
}
"""What ends a toss whose outcome is said with a reserve, and the words of its sentence that ask for one."""
OTHER = OtherOutcome(outcome=Outcome.TAILS, change=2e-15, impact=0)
SURE, UNSURE = {"outcome_certain": True}, {"outcome_certain": False}
KNOWN = (SURE, UNSURE, {**UNSURE, "other_outcome": OTHER}, {"outcome_certain": None})
"""What an engine knows of its outcome."""
CAN_CHANGE, CANNOT = ("may change", "decides", "computed"), ("certain", "can't change", "stay the same")


def made(count, trusted, end, **others):
    rows = np.zeros(count, IMPACT_ROW)
    rows["time"], rows["face"] = 0.1 * np.arange(1, count + 1), 1
    others = {"outcome": Outcome.HEADS, "ending": Ending.SETTLED, "other_outcome": None, **others}
    impacts = Impacts.from_rows(rows)
    return replace(TOSS, impacts=impacts, trusted_impacts=trusted, trust_end=end, end_time=2.0, **others)


def trusts(count):
    """Yield how many impacts may be trusted of so many, and why no more."""
    yield count, TrustEnd.NONE
    if count:
        yield from ((trusted, end) for trusted in {0, count - 1} for end in TrustEnd if end)


ALL = (  # used once
    made(count, trusted, end, outcome=outcome, ending=ending, **known)
    for outcome, ending, known, count in product(Outcome, Ending, KNOWN, (0, 1, 16))
    for trusted, end in trusts(count)
)


def test_every_ending_is_proved_or_leaves_something_open():
    """So a new one is thought of."""
    assert PROVED | set(OPEN) == set(Ending)
    assert not PROVED & set(OPEN)
    assert {ending for ending in Ending if ending.proviso} == set(OPEN)
    assert all(words in ending.sentence for ending, words in OPEN.items())


def test_no_two_words_on_a_toss_deny_each_other():
    for toss in ALL:
        outcome, trust, known = toss.outcome_told, toss.trust, toss.outcome_certain
        told = f"{outcome}\n{toss.ending.sentence}\n{trust}"
        decided = toss.outcome not in (Outcome.UNDECIDED, Outcome.TRANSIENT)
        # Certain is what the ending proves and no error changes: nothing beside it leaves the outcome open.
        assert ("and that is certain" in outcome) == (decided and known is True and toss.ending not in OPEN)
        # An ending that is no proof is said where the outcome is.
        assert (
            not (decided and toss.ending in OPEN and not toss.other_outcome) or toss.ending.proviso in outcome
        )
        # The engine's errors can change the outcome, or cannot, or it is not known; never two of these.
        unknown = "; this engine does not find out how certain that is"
        said = [any(word in told.replace(unknown, "") for word in words) for words in (CAN_CHANGE, CANNOT)]
        assert said == [decided and known is False, decided and known is True], told
        assert (unknown in outcome) == (decided and known is None)
        # Impacts that are not trusted leave a sure outcome as it is.
        few = toss.trusted_impacts < len(toss.impacts)
        assert ("outcome stay the same" in trust) == (few and decided and known is True), told


@pytest.mark.parametrize("known", KNOWN, ids=["sure", "unsure", "other", "unknown"])
def test_no_word_on_a_comparison_denies_those_on_its_tosses(known):
    lasting = np.array([[1.7, 2.0]])
    kinds = set()
    for ending, mine, its, more, settled, in_contact in product(
        (Ending.SETTLED, Ending.PAPER, Ending.CAUGHT, Ending.MAX_TIME),
        Outcome,
        Outcome,
        (0, 5, -5),
        (True, False),
        (True, False),
    ):
        a, b = 9 + max(more, 0), 9 + max(-more, 0)
        ends = {"ending": ending, "contacts": lasting if in_contact else np.zeros((0, 2))}
        analytic = made(a, a, TrustEnd.NONE, outcome=mine, **ends, **known)
        mujoco = made(b, b, TrustEnd.NONE, outcome=its, **ends, outcome_certain=None)
        both = Comparison(name="", text="", tosses=(analytic, mujoco))
        (pair,) = both.against
        vars(pair).update(common_prefix=9, common_horizon=9 if settled else 4)
        ((_, verdict, kind),) = verdicts_of(both)
        told = f"{analytic.outcome_told}\n{mujoco.outcome_told}\n{verdict}\n{horizon_sentence(pair)}"
        kinds.add(kind)
        # What is certain is so by the analytic engine, whose box says so too; MuJoCo's says why it does not.
        if "certain by the analytic one" in verdict:
            assert analytic.outcome_told.endswith("and that is certain"), told
            assert mujoco.outcome_told.endswith("this engine does not find out how certain that is"), told
        assert "certain" not in verdict.replace("certain by the analytic one", ""), told
        # Errors that change nothing of a toss are not said to decide it.
        sure = known == SURE and mine not in (Outcome.UNDECIDED, Outcome.TRANSIENT)
        assert not (sure and ("tiny errors" in told or "engines’ own" in told)), told
        # All impacts are all of both.
        assert ("all 9 impacts" in verdict) <= (a == b == 9), told
        assert (
            not (more and kind == VerdictKind.AGREE) or f"counts {abs(more)} more" in verdict or not settled
        ), told
        # What must be so is not said to be decided by a tiny change, and one engine is wrong or none is.
        assert not ("must lead" in verdict and "decides" in verdict), told
        assert not ("engine is wrong: please" in verdict and "neither engine is wrong" in verdict), told
        if kind == VerdictKind.FAULT:
            assert analytic.outcome_certain is not False, told
    assert {VerdictKind.AGREE, VerdictKind.DIFFER} <= kinds
