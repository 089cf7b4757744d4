"""How often a coin showed each side, and whether a fair coin does so."""

from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from scipy.stats import binom, binomtest

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import LEVEL, share_of
from cointoss.compare.sweep.errors import require_whole

MOST = 1_000_000_000
"""The most flips with one side up."""
BIAS, POWER = 0.01, 0.9
"""The bias for which `needed_flips` finds enough flips, and how likely these show it."""


@dataclass(frozen=True, kw_only=True)
class Sides:
    """How often a coin showed heads and tails.

    Sides(heads=493, tails=507).verdict
    """

    heads: int
    tails: int

    def __post_init__(self) -> None:
        """Check the counts.

        Raises:
            SweepError: naming the count, its value and what is accepted.
        """
        require_whole("heads", self.heads, 0, MOST)
        require_whole("tails", self.tails, 0 if self.heads else 1, MOST)

    @property
    def flips(self) -> int:
        """All flips that ended on a face."""
        return self.heads + self.tails

    @property
    def share(self) -> Estimate:
        """The share of heads, with Wilson's interval."""
        return share_of(self.heads, self.flips, "flips")

    @property
    def p_value(self) -> float:
        """How likely a fair coin is as far from one half, by the exact two-sided binomial test."""
        return float(binomtest(self.heads, self.flips).pvalue)

    @property
    def verdict(self) -> str:
        """Whether a fair coin can do this, and how many more flips show a bias of 1 %, in words."""
        can, more = "can" if self.p_value >= 1 - LEVEL else "cannot", needed_flips() - self.flips
        enough = f"{more:,} more would show" if more > 0 else "these are enough to show"
        return (
            f"a fair coin {can} do what was counted: p = {self.p_value:.2g}\n"
            f"{enough} a bias of 1 %, 51 or 49 heads in 100, nine times in ten"
        )

    def as_dict(self) -> dict[str, Any]:
        """Return it in the form of `cointoss flips --json`."""
        return asdict(self) | {
            "share": dict(zip(("value", "low", "high"), self.share.ends, strict=True)),
            "p_value": self.p_value,
        }


def together(several: Iterable[Sides]) -> Sides:
    """Return the counts of several series in one."""
    heads, tails = zip(*((one.heads, one.tails) for one in several), strict=True)
    return Sides(heads=sum(heads), tails=sum(tails))


@cache
def needed_flips() -> int:
    """Return the flips by which a two-sided test at 1 % finds a bias of `BIAS` as likely as `POWER`."""
    return bisect_left(
        range(1_000_000),
        POWER,
        key=lambda flips: binom.sf(binom.isf((1 - LEVEL) / 2, flips, 0.5), flips, 0.5 + BIAS),
    )
