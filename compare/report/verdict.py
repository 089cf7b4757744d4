"""The verdict on a comparison: one sentence for a visitor."""

from enum import StrEnum
from typing import NamedTuple

from compare.report.comparison import Comparison
from models.records import Ending, Outcome, Toss

REPORT_IT = "one of them is wrong: please report it"


class Kind(StrEnum):
    """How good the news is."""

    AGREE = "agree"
    """The engines show the same."""
    DIFFER = "differ"
    """They differ where they may."""
    FAULT = "fault"
    """They differ where they must not."""
    ALONE = "alone"
    """One engine alone can toss the coin."""


class Verdict(NamedTuple):
    """A sentence, and how good its news is."""

    text: str
    kind: Kind


def verdict_of(comparison: Comparison) -> Verdict:
    """Return the verdict."""
    if comparison.mujoco is None:
        says = f"{_outcome(comparison.analytic)} by the analytic engine alone"
        return Verdict(_sentence(f"{says}: MuJoCo can't toss this coin on this floor"), Kind.ALONE)
    a, b = (_outcome(toss) for toss in comparison.both)
    says = f"{a} by both engines" if a == b else f"{a} by the analytic engine, {b} by MuJoCo"
    agreement, kind = _agreement(comparison, a == b)
    return Verdict(_sentence(f"{says}: {agreement}"), kind)


def horizon_sentence(comparison: Comparison) -> str:
    """Return what the horizon of a comparison means, in one sentence."""
    horizon, count = comparison.horizon, _most_impacts(comparison)
    caught = _is_caught(comparison)
    if count == 0:
        before = "The coin is caught before its first impact: without" if caught else "Without"
        return f"{before} an impact nothing amplifies small errors."
    errors = "errors as small as the engines’ own"
    if horizon >= count and caught:
        return f"The coin is caught before {errors} change a face: the sequences must be the same to the end."
    if horizon >= count:
        return f"The sequences must be the same to the end: {errors} change no face."
    if horizon == 0:
        return (
            f"Not even the first face must be the same: {errors} can change it, and neither engine is wrong."
        )
    return (
        f"Up to the bar, after impact {horizon}, the faces must be the same; after it {errors}, amplified by "
        "each impact, can change a face, and neither engine is wrong."
    )


def contact_lines(toss: Toss, most: int = 5) -> list[str]:
    """Return what is said of a toss's sustained contacts: a line each, or one for all of many."""
    contacts = toss.contacts.tolist()
    if len(contacts) <= most:
        return [f"In contact from {start:.6f} s to {end:.6f} s." for start, end in contacts]
    total = sum(end - start for start, end in contacts)
    return [
        f"In contact {len(contacts)} times, for {total:.4f} s in all, "
        f"between {contacts[0][0]:.6f} s and {contacts[-1][1]:.6f} s."
    ]


def _agreement(comparison: Comparison, same_outcome: bool) -> tuple[str, Kind]:
    a, b = comparison.both
    prefix, horizon, count = comparison.common_prefix, comparison.horizon, _most_impacts(comparison)
    in_contact, caught = len(a.contacts) + len(b.contacts) > 0, _is_caught(comparison)
    agree = prefix == len(a.impacts) == len(b.impacts)
    kind = Kind.AGREE if agree and same_outcome else Kind.DIFFER
    if prefix < horizon:
        must = f"although {_first(horizon)} must be the same"
        return f"they differ at impact {prefix + 1}, {must}; {REPORT_IT}", Kind.FAULT
    certain = agree and horizon == count
    decided = Outcome.UNDECIDED not in (a.outcome, b.outcome)
    # The face in a hand may differ where the coin comes to it on its edge, unless it has flown only.
    leads_to_it = not in_contact and not (caught and count)
    if certain and decided and not same_outcome and leads_to_it:
        why = f"{_all(count)} must lead to the same" if count else "the coin only flew"
        return f"they differ although {why}; {REPORT_IT}", Kind.FAULT
    if count == 0:
        return _without_impact(a, b, in_contact), kind
    if not agree and prefix == 0:
        return "they differ from the first impact on, where no face is certain and neither is wrong", kind
    before = " before it is caught" if caught else ""
    first = f"they agree on {_all(count)}{before}" if agree else f"they agree on {_first(prefix)}"
    if certain:
        decides = "the flight to the hand" if caught else "what the floor does after that"
        follows = "" if same_outcome else f"; {decides} decides"
        return f"{first}, and that is certain{follows}", kind
    then = "after it they might have differed" if agree else "after it neither is wrong"
    if horizon == 0:
        return f"{first}, but none of this is certain{'' if agree else ', and neither is wrong'}", kind
    if horizon == prefix:
        return f"{first}, and that is certain; after that neither is wrong", kind
    return f"{first}; up to impact {horizon} that is certain, {then}", kind


def _without_impact(a: Toss, b: Toss, in_contact: bool) -> str:
    if in_contact:
        return "the coin comes to stay on the floor without a bounce"
    if a.ending == b.ending == Ending.CAUGHT:
        return "the coin is caught before it touches the floor, so that nothing amplifies small errors"
    return f"the coin does not touch the floor in the {max(a.end_time, b.end_time):.4g} s of the toss"


def _outcome(toss: Toss) -> str:
    if toss.ending == Ending.CAUGHT:
        return f"{toss.outcome} in the hand"
    if toss.ending == Ending.NOT_CAUGHT:
        return "not caught"
    return {Outcome.EDGE: "on its edge", Outcome.PERPETUAL: "moving for ever"}.get(
        toss.outcome, str(toss.outcome)
    )


def _all(count: int) -> str:
    return {1: "its only impact", 2: "both impacts"}.get(count, f"all {count} impacts")


def _first(count: int) -> str:
    return "the first impact" if count == 1 else f"the first {count} impacts"


def _is_caught(comparison: Comparison) -> bool:
    return all(toss.ending == Ending.CAUGHT for toss in comparison.both)


def _most_impacts(comparison: Comparison) -> int:
    return max(len(toss.impacts) for toss in comparison.both)


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."
