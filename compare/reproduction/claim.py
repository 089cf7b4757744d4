"""A claim, the measured quantities and thresholds that decide it, and its verdict."""

import json
import operator
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from numbers import Integral
from pathlib import Path
from typing import Literal

from compare.output.tables import table

Relation = Literal["<", "≤", "=", "≥", ">"]
_COMPARE = {"<": operator.lt, "≤": operator.le, "=": operator.eq, "≥": operator.ge, ">": operator.gt}


@dataclass(frozen=True)
class Criterion:
    """A measured quantity and its threshold, written as an inequality."""

    quantity: str
    """What is measured, with its unit in brackets."""
    measured: float
    relation: Relation
    threshold: float
    reason: str
    """Why this is the threshold."""

    @property
    def is_met(self) -> bool:
        """Whether the measured quantity is on the right side of the threshold; never so for NaN."""
        return bool(_COMPARE[self.relation](self.measured, self.threshold))

    @property
    def found(self) -> str:
        """The measured quantity in words."""
        return f"{self.quantity}: {_number(self.measured)}"

    @property
    def accepted(self) -> str:
        """The threshold in words."""
        return f"{self.relation} {_number(self.threshold)}"


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A claim beside the numbers that decide it."""

    claim: str
    """What the paper shows or says, or what a study found."""
    criteria: Sequence[Criterion]
    """The claim holds where all are met."""
    analytic: str = "-"
    """What the analytic engine finds; "-" where the criteria say all."""
    mujoco: str = "-"
    """What MuJoCo finds, or how far it is from the analytic engine; "-" where it has no part in the claim."""
    expected: bool = True
    """The known verdict; it is False for a claim of the paper that is known to fail."""

    def __post_init__(self) -> None:
        """Refuse a claim that nothing decides."""
        if not self.criteria:
            raise ValueError(f"criteria of {self.claim!r}: none; accepted: one or more")

    @property
    def holds(self) -> bool:
        """Whether all criteria are met."""
        return all(criterion.is_met for criterion in self.criteria)

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        return "holds" if self.holds else "does not hold"


def unexpected(claims: Sequence[Claim]) -> tuple[str, ...]:
    """Return the claims whose verdict is not the known one."""
    return tuple(claim.claim for claim in claims if claim.holds != claim.expected)


def table_of(claims: Sequence[Claim]) -> str:
    """Return the claims with their thresholds and verdicts as a table, without columns that say nothing."""
    columns = {
        "claim": [claim.claim for claim in claims],
        "analytic": [claim.analytic for claim in claims],
        "MuJoCo": [claim.mujoco for claim in claims],
        "measured (threshold: reason)": [criteria_of(claim) for claim in claims],
        "verdict": [claim.verdict for claim in claims],
    }
    shown = {name: cells for name, cells in columns.items() if set(cells) != {"-"}}
    return table(list(shown), list(zip(*shown.values(), strict=True)), words=True)


def criteria_of(claim: Claim, *, reasons: bool = True) -> str:
    """Return what was measured for a claim and what is accepted, with or without the reasons."""
    return "; ".join(
        f"{each.found} ({each.accepted}{': ' + each.reason if reasons else ''})" for each in claim.criteria
    )


def to_json(claims: Sequence[Claim]) -> str:
    """Return the claims as JSON, with their verdicts for whoever reads the file."""
    listed = [{**asdict(claim), "holds": claim.holds} for claim in claims]
    # NumPy's numbers are of their own types.
    return json.dumps(listed, indent=1, ensure_ascii=False, default=lambda number: number.item()) + "\n"


def read_claims(path: Path) -> tuple[Claim, ...]:
    """Read claims that a run wrote; verdicts follow from their numbers."""
    listed = json.loads(path.read_text(encoding="utf-8"))
    for one in listed:
        del one["holds"]
        one["criteria"] = [Criterion(**criterion) for criterion in one["criteria"]]
    return tuple(Claim(**one) for one in listed)


def _number(value: float) -> str:
    return f"{value:,d}" if isinstance(value, Integral) else f"{value:.3g}"
