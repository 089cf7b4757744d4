"""A quantity estimated from a random sample, with its confidence interval."""

import math
from dataclasses import dataclass, replace

_MOST = 1e12
"""The largest sample that `needed` returns."""


@dataclass(frozen=True)
class Estimate:
    """A quantity estimated from a random sample, with its 99 % confidence interval."""

    value: float
    low: float
    high: float
    count: int
    """Size of the sample."""
    counted: str = "tosses"
    """What the sample is of, in the plural."""

    @property
    def ends(self) -> tuple[float, float, float]:
        """The value and the ends of its interval."""
        return self.value, self.low, self.high

    def __sub__(self, number: float) -> "Estimate":
        """Return the estimate of the quantity less a number."""
        return replace(self, value=self.value - number, low=self.low - number, high=self.high - number)

    def __mul__(self, factor: float) -> "Estimate":
        """Return the estimate of the quantity times a positive factor."""
        return replace(self, value=self.value * factor, low=self.low * factor, high=self.high * factor)

    def __truediv__(self, divisor: float) -> "Estimate":
        """Return the estimate of the quantity over a positive number."""
        return replace(self, value=self.value / divisor, low=self.low / divisor, high=self.high / divisor)

    def needed(self, threshold: float) -> int | None:
        """Return the size of sample whose interval would leave out a threshold; None where none would.

        An interval shrinks as 1/√count; the value is taken to stay as found, so that an empty sample has
        none.
        """
        side = self.low if threshold < self.value else self.high
        if self.value == threshold or not (self.count and math.isfinite(side)):
            return None
        exact = self.count * ((self.value - side) / (self.value - threshold)) ** 2
        if exact > _MOST:
            return None
        unit = 10 ** max(math.floor(math.log10(exact)) - 1, 0)
        return unit * math.ceil(exact / unit)
