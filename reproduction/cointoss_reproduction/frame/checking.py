"""The comparison of a run with an earlier run: each number with its tolerance and a reason."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import Any, TypeGuard

import pandas as pd

from cointoss.study import Estimate
from cointoss_reproduction.frame.cells import ENDS, estimate, read_table
from cointoss_reproduction.frame.claim import VERDICTS, Claim, read_claims
from cointoss_reproduction.frame.files import CLAIMS, PROVENANCE, TABLE
from cointoss_reproduction.frame.provenance import read_provenance, unlike

CONFIDENCE = 2.58
"""Standard deviations to either side of 99 % of a normal distribution."""
BITS = "equal to the bit: the same sources, versions and kind of machine"
EQUAL = "equal to the bit"
ESTIMATE = "each value within the other's 99 % interval"
COUNT = f"within {CONFIDENCE} √n of the larger count n: tosses past their horizon of trust may end otherwise"
PRINTED = "within one in the third digit, as they are printed"
BESIDE = "within a thousandth of the largest number beside it"
SMALL = "within a hundredth of the threshold: rounding"
SAME = "equal"
_TOLD = ("analytic", "mujoco", "headline")
"""The texts of a claim."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """The results of a run, read from its folder."""

    claims: tuple[Claim, ...]
    cells: pd.DataFrame
    """The table of the run, empty where it has none."""
    made_of: Mapping[str, Any] | None
    """What the run was made of, see `provenance`; None for runs that did not keep it."""

    @property
    def named(self) -> dict[str, Claim]:
        """The claims by their words; claims with the same words are numbered."""
        seen, claims = Counter[str](), dict[str, Claim]()
        for one in self.claims:
            seen[one.claim] += 1
            claims[f"{one.claim} ({seen[one.claim]})" if seen[one.claim] > 1 else one.claim] = one
        return claims

    @property
    def columns(self) -> dict[str, list[Any]]:
        """The table by columns, an estimate with its interval in one."""
        rows = self.cells.to_dict("records")
        return {
            str(name): [estimate(row, name) for row in rows]
            for name in self.cells
            if not (str(name).endswith(ENDS) and str(name).rpartition(" ")[0] in self.cells)
        }


@dataclass(frozen=True, kw_only=True)
class Compared:
    """A number of two runs."""

    place: str
    """The place of the number."""
    there: Any
    here: Any
    reason: str
    """The tolerance and its reason, in words."""
    agrees: bool


@dataclass(frozen=True, kw_only=True)
class Check:
    """The result of comparing two runs."""

    unlike: str
    """The differences of sources, versions and machines, in words; empty if there are none."""
    verdicts: int
    """How many claims were compared."""
    changed: tuple[str, ...]
    """Claims whose verdict changes, in words."""
    numbers: tuple[Compared, ...]
    words: tuple[str, ...] = ()
    """Texts of claims that differ; the numbers in them have no tolerance of their own."""

    @property
    def off(self) -> tuple[Compared, ...]:
        """The numbers that do not agree."""
        return tuple(number for number in self.numbers if not number.agrees)

    @property
    def agrees(self) -> bool:
        """Whether no verdict changes and all numbers agree; and the texts, if the bits should be the same."""
        return not self.changed and not self.off and (bool(self.unlike) or not self.words)


class RunError(ValueError):
    """A folder that is not as a run leaves it; the message names the file and why."""


def read_run(folder: Path, *, quick: bool | None) -> Run:
    """Return what a run of this size, or of any, has left in a folder.

    Raises:
        RunError: naming the file, why, and what is accepted.
    """
    if not (folder / CLAIMS).is_file():
        raise RunError(
            f"{folder}: holds no {CLAIMS}, so no run; accepted: --check DIR after a run with --out DIR"
        )
    read, found = {CLAIMS: read_claims, PROVENANCE: read_provenance}, dict[str, Any]()
    if (folder / TABLE).exists():
        read[TABLE] = read_table
    for name, reader in read.items():
        try:
            found[name] = reader(folder / name)
        except (ValueError, OSError) as error:
            why = error.strerror if isinstance(error, OSError) else error
            raise RunError(f"{folder / name}: {why}; accepted: the file as a run has written it") from None
    made_of = found[PROVENANCE]
    if quick is not None and quick is not (made_of is not None and made_of["quick"]):
        size, way = ("full", "without") if quick else ("quick", "with")
        raise RunError(f"{folder}: of the {size} size; accepted: the same {way} --quick")
    return Run(claims=found[CLAIMS], cells=found.get(TABLE, pd.DataFrame()), made_of=made_of)


def check(there: Run, here: Run, *, timed: bool) -> Check:
    """Compare two runs.

    Args:
        there: the earlier run.
        here: the run of this machine.
        timed: whether the numbers are times, which no two runs share.
    """
    assert here.made_of is not None
    other = unlike(there.made_of, here.made_of)
    claims, found = there.named, here.named
    verdicts = {
        one: [VERDICTS[of[one].holds] if one in of else "no such claim" for of in (claims, found)]
        for one in {**claims, **found}
    }
    both = [] if timed else [(name, claims[name], found[name]) for name in claims if name in found]
    exact = not other
    numbers = [one for pair in both for one in _criteria(*pair, exact=exact)]
    if not (timed or there.cells.empty):
        numbers += _columns(there.columns, here.columns, exact=exact)
    return Check(
        unlike=other,
        verdicts=len(verdicts),
        changed=tuple(
            f"{one}: {old} there, {new} here" for one, (old, new) in verdicts.items() if old != new
        ),
        numbers=tuple(numbers),
        words=tuple(
            f"{name}: {getattr(old, who)} there, {getattr(new, who)} here"
            for name, old, new in both
            for who in _TOLD
            if getattr(old, who) != getattr(new, who)
        ),
    )


def _criteria(name: str, there: Claim, here: Claim, *, exact: bool) -> Iterator[Compared]:
    yield from _as_many(name, there.criteria, here.criteria, "criteria")
    for one, other in zip(there.criteria, here.criteria, strict=False):
        small = min(abs(one.threshold), abs(other.threshold)) / 100
        place = f"{name}: {other.quantity}"
        yield compared(place, one.measured, other.measured, exact=exact, small=small)


def _columns(
    there: Mapping[str, list[Any]], here: Mapping[str, list[Any]], *, exact: bool
) -> Iterator[Compared]:
    for name in {**there, **here}:
        old, new, place = there.get(name, []), here.get(name, []), f"{TABLE} {name}"
        yield from _as_many(place, old, new, "rows")
        largest = max((abs(one) for one in (*old, *new) if isinstance(one, float)), default=0.0)
        for number, (one, other) in enumerate(zip(old, new, strict=False)):
            yield compared(f"{place}[{number}]", one, other, exact=exact, beside=largest)


def _as_many(place: str, there: Any, here: Any, what: str) -> Iterator[Compared]:
    """Yield a difference if two runs have different numbers of entries."""
    if len(there) != len(here):
        counts = (f"{len(each)} {what}" for each in (there, here))
        yield compared(place, *counts, exact=False)


def compared(
    place: str, there: Any, here: Any, *, exact: bool, beside: float = 0.0, small: float = 0.0
) -> Compared:
    """Return how a number, an estimate or a word of two runs compares, with its tolerance.

    Neither run is preferred: exchanged, they agree in the same places.

    Args:
        place: where it stands.
        there: of the earlier run.
        here: of this one.
        exact: whether the bits should be the same.
        beside: the largest number in its column.
        small: what rounding may change.
    """
    agrees, reason = _same(there, here), BITS if exact else SAME
    if not exact and isinstance(there, Estimate) and isinstance(here, Estimate):
        reason = ESTIMATE
        agrees = agrees or (there.low <= here.value <= there.high and here.low <= there.value <= here.high)
    elif not exact and _is_number(there) and _is_number(here):
        allowed, reason = _allowed(there, here, beside, small)
        agrees = agrees or abs(there - here) <= allowed
    return Compared(place=place, there=there, here=here, reason=reason, agrees=agrees)


def _allowed(there: float, here: float, beside: float, small: float) -> tuple[float, str]:
    """Return by how much two numbers may differ, and why; symmetric in the two runs."""
    size = max(abs(there), abs(here))
    if isinstance(there, int) and isinstance(here, int):
        return CONFIDENCE * math.sqrt(size), COUNT
    printed = 10.0 ** (math.floor(math.log10(size)) - 2) if 0 < size < math.inf else 0.0
    return max((printed, PRINTED), (beside / 1000, BESIDE), (small, SMALL), key=lambda pair: pair[0])


def _same(there: Any, here: Any) -> bool:
    """Return whether two values are the same to the bit, the share of no trials too."""
    return repr(there) == repr(here)


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, Real) and not isinstance(value, bool)


def in_words(name: str, where: str, found: Check, *, timed: bool) -> str:
    """Return what a check found, in lines.

    Args:
        name: of what was reproduced.
        where: the folder with which it was compared.
        found: by the check.
        timed: as `check` takes it.
    """
    unlike = f"not to the bit: {found.unlike}" if found.unlike else ""
    agreeing = Counter(
        EQUAL if _same(number.there, number.here) else number.reason
        for number in found.numbers
        if number.agrees
    )
    details = [
        "its numbers are times: verdicts alone are compared" if timed else unlike,
        *(f"{count} {reason}" for reason, count in agreeing.items()),
        *(f"changes: {words}" for words in found.changed),
        *(f"in other words: {words}" for words in found.words),
        *(
            f"off: {number.place}: {_told(number.there)} there, {_told(number.here)} here; "
            f"accepted: {number.reason}"
            for number in found.off
        ),
    ]
    head = (
        f"{name}: {len(found.changed)} of {found.verdicts} verdicts change, "
        f"{len(found.off)} of {len(found.numbers)} numbers are off, against {where}"
    )
    return "\n  ".join([head, *filter(None, details)])


def _told(value: Any) -> Any:
    return value.value if isinstance(value, Estimate) else value
