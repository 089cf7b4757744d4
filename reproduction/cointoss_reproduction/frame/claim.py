"""A claim, the measured quantities and thresholds that decide it, and its verdict."""

import json
import math
import operator
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from numbers import Integral
from pathlib import Path
from typing import Literal

from pydantic import TypeAdapter, ValidationError

from cointoss.study import Estimate, read_bounded
from cointoss_reproduction.frame.files import MOST_BYTES

_MOST = 1e12
"""The largest sample that `needed_of` returns."""
Relation = Literal["<", "≤", "=", "≥", ">", "within ±"]
_COMPARE: dict[Relation, Callable[[float, float], bool]] = {
    "<": operator.lt,
    "≤": operator.le,
    "=": operator.eq,
    "≥": operator.ge,
    ">": operator.gt,
    "within ±": lambda measured, threshold: abs(measured) <= threshold,
}
VERDICTS = {True: "holds", False: "does not hold", None: "cannot be tested"}
MARKS = {True: "✓", False: "✗", None: "?"}


@dataclass(frozen=True)
class Criterion:
    """A measured quantity and its threshold, written as an inequality."""

    quantity: str
    """What is measured, with its unit in brackets."""
    measured: int | float | Estimate
    relation: Relation
    threshold: int | float
    reason: str
    """Why the threshold has this value."""

    @property
    def is_met(self) -> bool | None:
        """Whether the quantity is on the right side of the threshold; False for NaN.

        None where the interval of an estimate contains the threshold.
        """
        compare = _COMPARE[self.relation]
        if not isinstance(self.measured, Estimate):
            return bool(compare(self.measured, self.threshold))
        if any(self.measured.low <= limit <= self.measured.high for limit in self._limits):
            return None
        return bool(compare(self.measured.value, self.threshold))

    @property
    def _limits(self) -> tuple[float, ...]:
        """Where the verdict changes."""
        return (self.threshold, -self.threshold) if self.relation == "within ±" else (self.threshold,)

    @property
    def value(self) -> str:
        """The measured value in words, with its interval."""
        if not isinstance(self.measured, Estimate):
            return _number(self.measured)
        value, low, high = _alike(*self.measured.ends)
        return f"{value} [{low}, {high}]"

    @property
    def found(self) -> str:
        """The measured quantity in words, with its interval."""
        return f"{self.quantity}: {self.value}"

    @property
    def accepted(self) -> str:
        """The threshold in words."""
        return f"{self.relation} {_number(self.threshold)}"

    @property
    def row(self) -> tuple[str, ...]:
        """The quantity, its value and interval, the relation, the threshold and its reason."""
        it = self.measured
        values = it.ends if isinstance(it, Estimate) else (it, "", "")
        return (self.quantity, *map(str, values), self.relation, str(self.threshold), self.reason)

    @property
    def wanted(self) -> str:
        """What would decide the criterion, in words; empty if it is decided."""
        if self.is_met is not None or not isinstance(self.measured, Estimate):
            return ""
        sample = self.measured
        if not sample.count:
            return f"there were no {sample.counted}"
        nearest = min(self._limits, key=lambda limit: abs(limit - sample.value))
        needed = needed_of(sample, nearest)
        if needed is None:
            return f"no number of {sample.counted} would decide it"
        return f"about {needed:,d} {sample.counted} would decide it (there were {sample.count:,d})"


def needed_of(sample: Estimate, threshold: float) -> int | None:
    """Return the size of sample whose interval would leave out a threshold; None where none would.

    An interval shrinks as 1/√count; the value is taken to stay as found, so that an empty sample has none.
    """
    side = sample.low if threshold < sample.value else sample.high
    if sample.value == threshold or not (sample.count and math.isfinite(side)):
        return None
    exact = sample.count * ((sample.value - side) / (sample.value - threshold)) ** 2
    if exact > _MOST:
        return None
    unit = 10 ** max(math.floor(math.log10(exact)) - 1, 0)
    return unit * math.ceil(exact / unit)


@dataclass(frozen=True, kw_only=True)
class Claim:
    """Somebody's claim, a prediction made before, or a regression test; with the criteria that decide it."""

    claim: str
    """What the paper shows or says, or what a study found."""
    criteria: Sequence[Criterion] = ()
    """The criteria. The claim holds if all are met, and does not hold if one is not."""
    missing: str = ""
    """What the paper leaves out, without which the claim cannot be tested."""
    analytic: str = "-"
    """What the analytic engine finds; "-" where the criteria say all."""
    mujoco: str = "-"
    """What MuJoCo finds, or how far it is from the analytic engine; "-" where it has no part in the claim."""
    headline: str = ""
    """The finding, in a sentence for the opening of the page; empty for most claims."""
    expected: bool | None = True
    """The known verdict, as `holds` has it."""
    regression: bool = False
    """Whether the claim is a regression test, written after its numbers."""

    def __post_init__(self) -> None:
        """Keep the criteria as a tuple; refuse what nothing decides, or is no line."""
        object.__setattr__(self, "criteria", tuple(self.criteria))
        if "\n" in self.claim:
            raise ValueError(f"{self.claim!r}: several lines; accepted: one")
        if not self.criteria and not self.missing:
            raise ValueError(f"criteria of {self.claim!r}: none; accepted: one or more, or what is missing")

    @property
    def holds(self) -> bool | None:
        """Whether all criteria are met; None where the claim cannot be tested."""
        met = [criterion.is_met for criterion in self.criteria]
        if self.missing:
            return None
        if False in met:
            return False
        return None if None in met else True

    @property
    def verdict(self) -> str:
        """The verdict in words, with what would make it one where there is none."""
        return VERDICTS[self.holds] if self.holds is not None else f"{VERDICTS[None]}: {self.wanted}"

    @property
    def wanted(self) -> str:
        """What would make a verdict possible, in words; empty where there is one."""
        return self.missing or "; ".join(filter(None, (criterion.wanted for criterion in self.criteria)))


def unexpected(claims: Sequence[Claim], *, quick: bool = False) -> tuple[str, ...]:
    """Return the claims whose verdict is not the known one.

    Args:
        claims: to be looked at.
        quick: whether fewer tosses were made, which may leave a verdict open.
    """
    return tuple(
        claim.claim
        for claim in claims
        if claim.holds is not claim.expected and not (quick and claim.holds is None)
    )


def criteria_of(claim: Claim) -> str:
    """Return what was measured for a claim and what is accepted, without the reasons."""
    return "; ".join(f"{each.found} ({each.accepted})" for each in claim.criteria)


def to_json(claims: Sequence[Claim]) -> str:
    """Return the claims as JSON, with their verdicts for whoever reads the file."""
    listed = [{**asdict(claim), "holds": claim.holds} for claim in claims]
    # NumPy's numbers are of their own types.
    return json.dumps(listed, indent=1, ensure_ascii=False, default=lambda number: number.item()) + "\n"


def read_claims(path: Path) -> tuple[Claim, ...]:
    """Read claims that a run wrote; verdicts follow from their numbers.

    Raises:
        ValueError, OSError: in one line, for what no run writes.
    """
    try:
        return TypeAdapter(tuple[Claim, ...]).validate_json(read_bounded(path, MOST_BYTES))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise ValueError(f"{'.'.join(map(str, first['loc']))}: {first['msg']}") from None


def _number(value: float) -> str:
    return f"{value:,d}" if isinstance(value, Integral) else f"{value:.3g}"


def _alike(value: float, low: float, high: float) -> tuple[str, ...]:
    """Return an estimate and its interval, both to the second digit of half the interval's length."""
    half = (high - low) / 2
    if not 0 < half < math.inf or max(abs(low), abs(high)) >= 1e5 or half < 1e-4:
        return tuple(f"{one:.3g}" for one in (value, low, high))
    digits = max(1 - math.floor(math.log10(half)), 0)
    return tuple(f"{one:,.{digits}f}" for one in (value, low, high))
