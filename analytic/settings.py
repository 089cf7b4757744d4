"""How finely the analytic engine computes, and how far it follows a toss."""

from dataclasses import asdict, dataclass, field
from numbers import Integral

from analytic.numerics.tolerances import STEP_ERROR


@dataclass(frozen=True, kw_only=True)
class Settings:
    """What the tosses of this engine depend on beside their scenario."""

    tolerance: float = field(default=STEP_ERROR, init=False)
    """Error allowed in a step, relative; compiled in."""
    contact_steps: int = 50_000_000
    """The most steps in the sustained contacts of a toss; a mode that takes no time costs a thousand."""

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            ValueError: naming the setting, its value and what is accepted.
        """
        if not (isinstance(self.contact_steps, Integral) and self.contact_steps >= 1):
            raise ValueError(f"contact_steps: given {self.contact_steps}, accepted: a whole number >= 1")

    def as_dict(self) -> dict[str, str | float]:
        """Return the settings on which a toss depends, by name."""
        return asdict(self)


FINE = MANY = Settings()
"""The settings of one toss, and of many tosses: here the same."""
