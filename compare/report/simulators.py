"""An engine of a user's own, as the distribution that offers such engines gives it."""

from contextlib import AbstractContextManager
from importlib.metadata import entry_points
from typing import Any, Protocol

from cointoss.models.records import Toss, UnusableEngineError
from cointoss.models.scenario import Scenario


class Simulator(AbstractContextManager["Simulator"], Protocol):
    """An engine that is asked for states alone, and ends with the block."""

    name: str

    def toss(self, scenario: Scenario, until: float) -> Toss:
        """Return the toss that its states show until a time [s]; raise `UnsupportedError` for another."""
        ...


def simulator_of(given: Any) -> Simulator:
    """Return the engine that a user gives, by the entry point `cointoss.simulators`.

    Raises:
        UnusableEngineError: where no distribution offers such engines, or the engine can't be started.
        TypeError: for an object that is no engine.
    """
    for point in entry_points(group="cointoss.simulators"):
        return point.load()(given)
    raise UnusableEngineError(
        f"engine: {given}, accepted: analytic, mujoco, or another by pip install cointoss-yardstick"
    )
