"""The verdict on a comparison, in plain words."""

from enum import StrEnum
from typing import NamedTuple

from cointoss.compare.report.compared_tosses import ComparedTosses
from cointoss.models.records import Ending, Outcome, Toss, TrustEnd

REPORT_IT = "One engine is wrong: please report it"
TINY_ERRORS = "tiny errors decide, and neither engine is wrong"
MUJOCOS_ERRORS = "MuJoCo’s own errors decide what it shows"
"""The sentence for a toss in which the analytic engine's errors change nothing."""
OFF_THE_LAW = (TrustEnd.SECOND_POINT, TrustEnd.RESTITUTION)
"""Ends of MuJoCo's trust where its impulse is not that of the contact law, however well the toss is known."""


class VerdictKind(StrEnum):
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
    """A sentence or two, and how good the news is."""

    text: str
    kind: VerdictKind


def verdict_of(comparison: ComparedTosses) -> Verdict:
    """Return the verdict."""
    analytic, mujoco = comparison.analytic, comparison.mujoco
    a, doubt = _outcome(analytic), _doubt(analytic)
    if mujoco is None:
        says = f"{a} by the analytic engine alone{', and that is certain' * analytic.is_certain}"
        return Verdict(
            _sentence(f"{says}: MuJoCo can't toss this coin on this floor") + doubt, VerdictKind.ALONE
        )
    b = _outcome(mujoco)
    agreement, kind = _agreement(comparison, a == b)
    if a == b:
        proviso = analytic.ending.proviso
        has_reserve = analytic.outcome.is_decided and proviso and proviso == mujoco.ending.proviso
        reserve = f", {proviso}" if has_reserve else ""
        says = f"{a} by both engines{', and certain by the analytic one' * analytic.is_certain}{reserve}"
    else:
        says = f"{a} by the analytic engine, {b} by MuJoCo"
        if analytic.is_sure and kind != VerdictKind.FAULT:
            doubt = " The analytic engine's own errors are too small to change its outcome."
    return Verdict(_sentence(f"{says}: {agreement}") + doubt, kind)


def _doubt(toss: Toss) -> str:
    other = toss.other_outcome
    if other is None:
        return ""
    return f" {_sentence(f'{_told(toss.outcome)} or {_told(other.outcome)}: {other.told}')}"


def horizon_sentence(comparison: ComparedTosses) -> str:
    """Return what the horizon of a comparison means."""
    horizon, count = comparison.horizon, _most_impacts(comparison)
    caught = _is_caught(comparison)
    if count == 0:
        before = "The coin is caught before its first impact: without" if caught else "Without"
        return f"{before} an impact nothing amplifies small errors."
    whose = "MuJoCo’s" if comparison.analytic.is_sure else "the engines’ own"
    errors = f"errors as small as {whose}"
    if horizon >= count and caught:
        return f"All faces must agree: the coin is caught before {errors} change one."
    if horizon >= count:
        return f"All faces must agree: {errors} change none."
    off_the_law = _off_the_law(comparison)
    if horizon == 0:
        return f"Not even the first face must agree: {off_the_law or f'{errors} can change it'}."
    first = "The first face" if horizon == 1 else f"The first {horizon} faces"
    if off_the_law:
        return f"{first}, up to the bar, must agree. {_sentence(off_the_law)}"
    return (
        f"{first}, up to the bar, must agree. Each impact amplifies small errors: after the bar {errors} can "
        "change a face."
    )


def _agreement(comparison: ComparedTosses, same_outcome: bool) -> tuple[str, VerdictKind]:
    a, b = comparison.both
    prefix, horizon, count = comparison.common_prefix, comparison.horizon, _most_impacts(comparison)
    in_contact, caught = len(a.contacts) + len(b.contacts) > 0, _is_caught(comparison)
    # Bounces that die out have no last one: each engine takes the smallest for contact from its own on.
    dies_out = len(a.contacts) > 0 < len(b.contacts) and 0 < prefix == min(len(a.impacts), len(b.impacts))
    agree = prefix == len(a.impacts) == len(b.impacts) or (dies_out and same_outcome)
    kind = VerdictKind.AGREE if agree and same_outcome else VerdictKind.DIFFER
    if prefix < horizon:
        return (
            f"they differ at impact {prefix + 1}, although {_first(horizon)} must agree. {REPORT_IT}",
            VerdictKind.FAULT,
        )
    off_the_law = _off_the_law(comparison)
    decide = MUJOCOS_ERRORS if a.is_sure else TINY_ERRORS
    then = off_the_law or f"after that {decide}"
    as_they_must = agree and horizon == prefix
    decided = a.outcome.is_decided and b.outcome.is_decided
    # The face in a hand may differ where the coin comes to it on its edge, unless it has flown only.
    leads_to_it = not in_contact and not (caught and count) and a.outcome_certain is not False
    if as_they_must and decided and not same_outcome and leads_to_it:
        why = f"{_all(count)} must lead to the same" if count else "the coin only flew"
        return f"they differ, although {why}. {REPORT_IT}", VerdictKind.FAULT
    if count == 0:
        return _without_impact(a, b, in_contact), kind
    if not agree and prefix == 0:
        return (
            f"they differ from the first impact on. Not even that must agree: {off_the_law or decide}",
            kind,
        )
    before = " before it is caught" if caught else ""
    shared = _all(count) if agree and prefix == count else _first(prefix)
    first = f"they agree on {shared}{before if agree else ''}"
    if as_they_must:
        decides = "the flight to the hand" if caught else "what the floor does after that"
        follows = "" if same_outcome else f"; {decides} decides"
        return f"{first}, as they must{follows or _further(a, b)}", kind
    if horizon == 0:
        return f"{first}. Not even the first must agree: {off_the_law or decide}", kind
    if horizon == prefix:
        return f"{first}, as they must; {then}", kind
    return f"{first}. The first{'' if horizon == 1 else f' {horizon}'} must agree; {then}", kind


def _further(a: Toss, b: Toss) -> str:
    """Return which engine counts more impacts than both share; empty where neither does."""
    more = len(a.impacts) - len(b.impacts)
    who = "the analytic engine" if more > 0 else "MuJoCo"
    return f"; after that {who} counts {abs(more)} more" if more else ""


def _off_the_law(comparison: ComparedTosses) -> str:
    """Return why MuJoCo's impulse after the horizon is not that of the law; empty where errors end it."""
    _, mujoco = comparison.both
    ends_it = comparison.horizon == mujoco.trusted_impacts and mujoco.trust_end in OFF_THE_LAW
    return mujoco.trust_reason if ends_it else ""


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
    return _told(toss.outcome)


def _told(outcome: Outcome) -> str:
    told = {
        Outcome.EDGE: "on its edge",
        Outcome.PERPETUAL: "moving for ever",
        Outcome.TRANSIENT: "moving still",
    }
    return told.get(outcome, str(outcome))


def _all(count: int) -> str:
    return {1: "its only impact", 2: "both impacts"}.get(count, f"all {count} impacts")


def _first(count: int) -> str:
    return "the first impact" if count == 1 else f"the first {count} impacts"


def _is_caught(comparison: ComparedTosses) -> bool:
    return all(toss.ending == Ending.CAUGHT for toss in comparison.both)


def _most_impacts(comparison: ComparedTosses) -> int:
    return max(len(toss.impacts) for toss in comparison.both)


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."
