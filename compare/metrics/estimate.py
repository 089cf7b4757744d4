"""A quantity estimated from a random sample, with its confidence interval."""

from dataclasses import dataclass, replace


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
