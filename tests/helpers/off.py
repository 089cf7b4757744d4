"""An engine from outside that is off the contact law: the analytic one, on a floor of another restitution."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario


@dataclass(frozen=True)
class Off:
    """It tosses on a floor whose restitution is so many times as large."""

    name: str = "off"
    factor: float = 0.5

    def simulate(self, scenario: Scenario, times: Array) -> dict[str, Any]:
        """Return the states and the impacts."""
        if not self.factor:
            raise NotImplementedError(f"{self.name} tosses nothing")
        toss = analytic.toss(scenario.replace("floor.restitution", self.factor * scenario.floor.restitution))
        states = toss.sample(np.minimum(times, toss.end_time))
        columns = {name: column for name, column in vars(states).items() if name != "time"}
        return columns | {"impact_time": toss.impacts.time, "impact_impulse": toss.impacts.impulse}
