"""How finely the analytic engine computes, and how far it follows a toss."""

from dataclasses import asdict, dataclass, field
from numbers import Integral
from typing import NamedTuple

from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR, STEP_ERROR

FINEST, COARSEST = 1e-14, 1e-6
"""The bounds of the tolerances accepted: rounding, and a motion that hardly keeps its energy."""


@dataclass(frozen=True, kw_only=True)
class AnalyticSettings:
    """What the tosses of this engine depend on beside their scenario."""

    tolerance: float = field(default=STEP_ERROR, init=False)
    """Error allowed in a step of flight, relative; it is compiled in and can't be set."""
    contact_tolerance: float = CONTACT_STEP_ERROR
    """Error allowed in a step of sustained contact, relative."""
    contact_steps: int = 250_000
    """The most steps of a toss in contacts and flights from its first sustained contact on; an event counts
    as four, a mode that takes no time as a thousand."""

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            ValueError: naming the setting, its value and what is accepted.
        """
        if not (isinstance(self.contact_steps, Integral) and self.contact_steps >= 1):
            raise ValueError(f"contact_steps: given {self.contact_steps}, accepted: a whole number >= 1")

        if not FINEST <= self.contact_tolerance <= COARSEST:
            raise ValueError(
                f"contact_tolerance: given {self.contact_tolerance}, accepted: {FINEST:g} to {COARSEST:g}"
            )

    def as_dict(self) -> dict[str, str | float]:
        """Return the settings on which a toss depends, by name."""
        return asdict(self)


class ContactLimits(NamedTuple):
    """How sustained contact is followed, as numbers for compiled code."""

    steps: int
    tolerance: float


def contact_limits(settings: AnalyticSettings) -> ContactLimits:
    """Return the settings of sustained contact."""
    return ContactLimits(settings.contact_steps, settings.contact_tolerance)


FINE = MANY = AnalyticSettings()
"""The settings of one toss, and of many tosses, which are the same for this engine."""
