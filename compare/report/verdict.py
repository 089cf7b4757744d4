"""The verdict on a comparison, in plain words."""

import math
from enum import StrEnum
from typing import NamedTuple

from cointoss.compare.engines import is_own, label_of
from cointoss.compare.output.answer import counted
from cointoss.compare.output.language import listed
from cointoss.compare.report.compared_tosses import Against, ComparedTosses
from cointoss.models.records import Ending, Outcome, Toss, TrustEnd

REPORT_IT = "One engine is wrong: please report it"
TINY_ERRORS = "tiny errors decide, and neither engine is wrong"
OFF_THE_LAW = (TrustEnd.SECOND_POINT, TrustEnd.RESTITUTION)
"""How MuJoCo's trust ends where its impulse is not that of the law, however well the toss is known."""
MISSES = 1e-2
"""A flight, or an impulse, of another engine than ours is off where its relative error is larger."""


class VerdictKind(StrEnum):
    """The kind of a verdict."""

    AGREE = "agree"
    """The engines show the same."""
    DIFFER = "differ"
    """The engines differ only where they may."""
    FAULT = "fault"
    """The engines differ where they must not."""
    ALONE = "alone"
    """One engine alone can toss the coin."""


class Verdict(NamedTuple):
    """A sentence or two on one engine, and the kind of the verdict."""

    engine: str
    """The engine that is held against the analytic one, which is its own where it is alone."""
    text: str
    kind: VerdictKind


def verdicts_of(comparison: ComparedTosses) -> list[Verdict]:
    """Return the verdict on each other engine, or one on the analytic engine where it is alone."""
    measure, absent = comparison.measure, comparison.absent
    cannot = "{} can't toss this coin on this floor"
    if comparison.against:
        many = len(comparison.tosses) > 2
        return [
            *(_verdict(pair, many=many) for pair in comparison.against),
            *(Verdict(name, f"{cannot.format(label_of(name))}.", VerdictKind.ALONE) for name in absent),
        ]
    says = f"{_outcome(measure)} by the analytic engine alone{', and that is certain' * measure.is_certain}"
    why = f": {cannot.format(listed(map(label_of, absent)))}" if absent else ""
    return [Verdict(measure.engine, _sentence(says + why) + _doubt(measure), VerdictKind.ALONE)]


def _verdict(pair: Against, *, many: bool) -> Verdict:
    """Return the verdict on an engine, which is named where there are more than two."""
    analytic, other, label = pair.measure, pair.toss, label_of(pair.toss.engine)
    a, b, doubt = _outcome(analytic), _outcome(other), _doubt(analytic)
    agreement, kind = _agreement(pair, a == b)
    if a == b:
        proviso = analytic.ending.proviso
        has_reserve = analytic.outcome.is_decided and proviso and proviso == other.ending.proviso
        reserve = f", {proviso}" if has_reserve else ""
        both = f"the analytic engine and {label}" if many else "both engines"
        says = f"{a} by {both}{', and certain by the analytic one' * analytic.is_certain}{reserve}"
    else:
        says = f"{a} by the analytic engine, {b} by {label}"
        if analytic.is_sure and kind != VerdictKind.FAULT:
            doubt = " The analytic engine's own errors are too small to change its outcome."
    off = _off_the_law(pair)
    if "flight" in off and "flight" not in agreement:
        doubt += f" {_sentence(off)}"
    return Verdict(other.engine, _sentence(f"{says}: {agreement}") + doubt, kind)


def _doubt(toss: Toss) -> str:
    other = toss.other_outcome
    return f" {_sentence(f'{_told(toss.outcome)} or {_told(other.outcome)}: {other.told}')}" if other else ""


def horizon_sentence(pair: Against) -> str:
    """Return what the common horizon of a pair means, and how far each toss is trusted by itself."""
    horizon, count, caught = pair.common_horizon, pair.most_impacts, _is_caught(pair)
    if count == 0:
        before = "The coin is caught before its first impact: without" if caught else "Without"
        return f"{before} an impact nothing amplifies small errors."
    whose = f"{label_of(pair.toss.engine)}’s" if pair.measure.is_sure else "the engines’ own"
    errors = f"errors as small as {whose}"
    if horizon >= count:
        change = f"the coin is caught before {errors} change one" if caught else f"{errors} change none"
        return f"All faces must agree: {change}."
    off_the_law = _off_the_law(pair)
    if horizon == 0:
        return f"Not even the first face must agree: {off_the_law or f'{errors} can change it'}."
    first = "The first face" if horizon == 1 else f"The first {horizon} faces"
    own, its = pair.measure.trusted_impacts, pair.toss.trusted_impacts
    why = off_the_law or f"each impact amplifies small errors: after the bar {errors} can change a face"
    return (
        f"{first}, up to the bar (the common horizon), must agree. {_sentence(why)} "
        f"By itself the analytic toss is trusted in {counted(own, 'impact')}, that of "
        f"{label_of(pair.toss.engine)} in {its}."
    )


def _agreement(pair: Against, same_outcome: bool) -> tuple[str, VerdictKind]:
    a, b = pair.measure, pair.toss
    prefix, horizon, count = pair.common_prefix, pair.common_horizon, pair.most_impacts
    in_contact, caught = len(a.contacts) + len(b.contacts) > 0, _is_caught(pair)
    # Bounces that die out have no last one: each engine takes the smallest for contact from its own on.
    dies_out = len(a.contacts) > 0 < len(b.contacts) and 0 < prefix == min(len(a.impacts), len(b.impacts))
    agree = prefix == len(a.impacts) == len(b.impacts) or (dies_out and same_outcome)
    kind = VerdictKind.AGREE if agree and same_outcome else VerdictKind.DIFFER
    if prefix < horizon:
        must = f"although {_first(horizon)} must agree" if is_own(b.engine) else "within the horizon"
        return f"they differ at impact {prefix + 1}, {must}{_fault(pair)}", VerdictKind.FAULT
    off_the_law = _off_the_law(pair)
    decide = f"{label_of(b.engine)}’s own errors decide what it shows" if a.is_sure else TINY_ERRORS
    then = off_the_law or f"after that {decide}"
    as_they_must = agree and horizon == prefix
    decided = a.outcome.is_decided and b.outcome.is_decided
    # The face in a hand may differ where the coin comes to it on its edge, unless it has flown only.
    leads_to_it = not in_contact and not (caught and count) and a.outcome_certain is not False
    if as_they_must and decided and not same_outcome and leads_to_it:
        why = f"{_all(count)} must lead to the same" if count else "the coin only flew"
        return f"they differ, although {why}{_fault(pair)}", VerdictKind.FAULT
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
    who = "the analytic engine" if more > 0 else label_of(b.engine)
    return f"; after that {who} counts {abs(more)} more" if more else ""


def _fault(pair: Against) -> str:
    """Return whose fault it is that an engine differs where it must not."""
    if is_own(pair.toss.engine):
        return f". {REPORT_IT}"
    missed = _missed(pair, "its {}")
    return f": {label_of(pair.toss.engine)} is wrong there{missed and f' ({missed})'}"


def _off_the_law(pair: Against) -> str:
    """Return which impulse is not that of the law where that, and no tiny error, ends the horizon."""
    toss = pair.toss
    if not is_own(toss.engine):
        return _missed(pair, f"the {{}} of {label_of(toss.engine)}")
    ends_it = pair.common_horizon == toss.trusted_impacts and toss.trust_end in OFF_THE_LAW
    return toss.trust_reason if ends_it else ""


def _missed(pair: Against, whose: str) -> str:
    """Return what is off first, the flight or an impulse within the horizon, and by how much."""
    if pair.flight_error > MISSES:
        return f"before impact 1 {whose.format('flight')} is {100 * pair.flight_error:.0f} % off"
    for number, error in enumerate(pair.errors[: pair.common_horizon].tolist(), start=1):
        if error > MISSES:
            off = f"{100 * error:.0f} % off" if math.isfinite(error) else "nothing like that of"
            return f"at impact {number} {whose.format('impulse')} is {off} the contact law"
    return ""


def _without_impact(a: Toss, b: Toss, in_contact: bool) -> str:
    if in_contact:
        return "the coin comes to stay on the floor without a bounce"
    if a.ending == b.ending == Ending.CAUGHT:
        return "the coin is caught before it touches the floor, so that nothing amplifies small errors"
    return f"the coin does not touch the floor in the {max(a.end_time, b.end_time):.4g} s of the toss"


def _outcome(toss: Toss) -> str:
    of_a_hand = {Ending.CAUGHT: f"{toss.outcome} in the hand", Ending.NOT_CAUGHT: "not caught"}
    return of_a_hand.get(toss.ending) or _told(toss.outcome)


def _told(outcome: Outcome) -> str:
    return {
        Outcome.EDGE: "on its edge",
        Outcome.PERPETUAL: "moving for ever",
        Outcome.TRANSIENT: "moving still",
    }.get(outcome, str(outcome))


def _all(count: int) -> str:
    return {1: "its only impact", 2: "both impacts"}.get(count, f"all {count} impacts")


def _first(count: int) -> str:
    return "the first impact" if count == 1 else f"the first {count} impacts"


def _is_caught(pair: Against) -> bool:
    return pair.measure.ending == pair.toss.ending == Ending.CAUGHT


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."
