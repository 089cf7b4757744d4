"""How finely the analytic engine computes."""

from dataclasses import asdict, dataclass, field

from analytic.flight.equations_of_motion import TOLERANCE


@dataclass(frozen=True, kw_only=True)
class Settings:
    """What the tosses of this engine depend on beside their scenario; so far there is nothing to choose."""

    tolerance: float = field(default=TOLERANCE, init=False)
    """Error allowed in a step, relative; compiled in."""

    def as_dict(self) -> dict[str, str | float]:
        """Return the settings on which a toss depends, by name."""
        return asdict(self)


FINE = MANY = Settings()
"""Of one toss, and of many."""
