"""An engine from outside that is off the contact law: the analytic one, on a floor of another restitution."""

from dataclasses import dataclass, replace

from cointoss import analytic
from cointoss.models.records import Toss, TrustEnd, UnsupportedError
from cointoss.models.scenario import Scenario


@dataclass(frozen=True)
class Off:
    """It tosses on a floor whose restitution is so many times as large."""

    name: str = "off"
    factor: float = 0.5

    def toss(self, scenario: Scenario) -> Toss:
        """Toss a coin, and find out nothing of how sure that is."""
        if not self.factor:
            raise UnsupportedError(f"{self.name} tosses nothing")
        found = analytic.toss(scenario.replace("floor.restitution", self.factor * scenario.floor.restitution))
        return replace(
            found,
            outcome_certain=None,
            other_outcome=None,
            trusted_impacts=len(found.impacts),
            trust_end=TrustEnd.NONE,
        )
