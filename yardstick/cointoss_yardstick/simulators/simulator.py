"""An engine of anybody: what a user gives, and the tosses that its states show."""

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from importlib.metadata import entry_points
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from cointoss import Ending, Engine, Scenario, States, Toss, UnsupportedError, UnusableEngineError
from cointoss.study import Array, cores_used, meant
from cointoss_yardstick.simulators.answering import Answering, Called, Served
from cointoss_yardstick.simulators.checking import checked_states
from cointoss_yardstick.simulators.observed import ObservedToss

SPACING = 1e-4
"""The spacing of the times at which an engine without a step is asked [s]."""
LIMIT = 60.0
"""How long an answer may take by default [s]."""


class Simulates(Protocol):
    """What an engine is: one function.

    It may have a `name`; a `dt`, its step [s], which the harness sets; and `settings`, a dict of what it was
    set to. What it can't do, it says by raising `NotImplementedError` with the field, its value, and what is
    accepted.
    """

    def simulate(self, scenario: Scenario, times: Array) -> States | dict[str, Any] | tuple[ArrayLike, ...]:
        """Return the coin's states.

        Args:
            scenario: what is tossed; the floor is z = 0, and z is up.
            times: from 0, the release, on; with a step `dt` multiples of it, (n,) [s].

        Returns:
            Arrays by name, or in this order: `position` of the mass centre, space frame, (n, 3) [m];
            `quaternion`, scalar first, body to space, (n, 4); `velocity` of the mass centre, space frame,
            (n, 3) [m/s]; `angular_velocity`, body frame, (n, 3) [rad/s]. By name it may add `time`, the
            `impact_time`, (k,) [s], and `impact_impulse`, space frame, (k, 3) [N s], of its impacts, and the
            `stiffness` of a contact that is a spring [N/m].
        """
        ...


@dataclass(frozen=True)
class Simulator(AbstractContextManager["Simulator"]):
    """An engine, and who answers for it; it ends with the block."""

    answering: Answering

    @property
    def name(self) -> str:
        """The engine's name."""
        return self.answering.about["name"]

    @property
    def dt(self) -> float | None:
        """The engine's own step [s]; None for one that goes from event to event."""
        return self.answering.about["dt"]

    def observe(
        self, scenario: Scenario, until: float, *, dt: float | None = None, every: float | None = None
    ) -> ObservedToss:
        """Simulate a toss.

        Args:
            scenario: what is tossed.
            until: the time of the last state [s].
            dt: the step, by default the engine's own [s].
            every: the spacing of the states, by default one step [s].

        Raises:
            UnsupportedError: for what the engine can't do.
            UnusableEngineError: for an engine that fails; the message names it, the time and why.
        """
        if slope := scenario.floor.slope:
            raise UnsupportedError(f"floor.slope: {slope:g}, accepted of {self.name}: 0")
        step = dt or self.dt
        fine = step or SPACING
        spacing = fine * max(round((every or fine) / fine), 1)
        times: Array = spacing * np.arange(int(until / spacing + 1e-9) + 1, dtype=float)
        answer = self.answering.states(scenario, times, step)
        try:
            states = checked_states(scenario, times, step, answer)
        except ValueError as error:
            raise UnusableEngineError(f"{self.name}: {error}") from None
        return ObservedToss(
            scenario=scenario,
            states=states,
            told=(np.asarray(answer["impact_time"]), np.asarray(answer["impact_impulse"]))
            if "impact_time" in answer
            else None,
            stiffness=float(answer.get("stiffness", np.inf)),
            processor_time=float(answer["processor_time"]),
        )

    def toss(self, scenario: Scenario, until: float) -> Toss:
        """Return the toss that the engine's states show; see `observe`."""
        settings = dict(self.answering.about["settings"])
        until = min(until, scenario.ending.max_time)
        return self.observe(scenario, until).toss(
            self.name, settings | ({"dt [s]": self.dt} if self.dt else {})
        )

    def __exit__(self, *_: object) -> None:
        """End what was started for the engine."""
        self.answering.close()


def simulator_of(given: Any, limit: float = LIMIT) -> Simulator:
    """Return the engine that a user gives.

    Args:
        given: an object with a function `simulate`, see `Simulates`; or "package.module:name" of one, or the
            name of an entry point `cointoss.engines`, which runs in a process of its own; or an `Engine`.
            "PYTHON -m package.module:name" is run by another Python, which needs NumPy, and not cointoss.
        limit: of each answer [s].

    Raises:
        UnusableEngineError: for an engine that can't be started.
        TypeError: for an object that is no engine.
    """
    if not isinstance(given, str):
        return Simulator(Called(given, limit))
    if given in list(Engine):
        return Simulator(Called(Own(Engine(given)), limit))
    python, _, path = given.rpartition(" -m ")
    offered = {point.name: point.value for point in entry_points(group="cointoss.engines")}
    path = offered.get(path, path)
    if ":" not in path:
        known = [*Engine, *sorted(offered)]
        raise UnusableEngineError(
            f"engine: {given}, {meant(given, known)}accepted: {', '.join(known)}, or package.module:name"
        )
    return Simulator(Served(path, limit, python or sys.executable))


@contextmanager
def simulators_of(given: Any, limit: float) -> Iterator[list[Simulator]]:
    """Yield an engine, once for each core where it runs in processes of its own; see `simulator_of`."""
    with ExitStack() as stack:
        engines = [stack.enter_context(simulator_of(given, limit))]
        if isinstance(engines[0].answering, Served):
            engines += [stack.enter_context(simulator_of(given, limit)) for _ in range(cores_used() - 1)]
        yield engines


class Own:
    """An engine of cointoss, asked for states as any other."""

    def __init__(self, engine: Engine) -> None:
        """Keep the engine."""
        self._package = engine.package
        self.name, self.settings = str(engine), self._package.FINE.as_dict()

    def simulate(self, scenario: Scenario, times: Array) -> dict[str, Array]:
        """Return the states, and the impacts of the toss; see `Simulates`."""
        until = max(float(times[-1]), 1e-9)
        asked = scenario.replace("ending", {"test": "lying", "max_time": until, "until": until})
        toss = self._package.toss(asked)
        lies = toss.ending == Ending.LYING
        end = toss.end_time if lies else toss.path_end
        if end < until and not lies:
            raise UnsupportedError(f"the toss stopped at {end:.4g} s: {toss.ending.sentence}")
        states, moves = toss.sample(np.minimum(times, end)), (times <= end)[:, None]
        found = {"position": states.position, "quaternion": states.quaternion}
        found |= {name: getattr(states, name) * moves for name in ("velocity", "angular_velocity")}
        if lies or not len(toss.later_times):  # of later touches no impulse is known
            found |= {"impact_time": toss.impacts.time, "impact_impulse": toss.impacts.impulse}
        return found
