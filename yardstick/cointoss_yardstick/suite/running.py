"""An engine run through the cases, each with several steps where it has one."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from cointoss import Hand, Outcome, Scenario, ScenarioError, UnsupportedError, UnusableEngineError
from cointoss.study import in_tiles
from cointoss_yardstick.simulators.simulator import Simulator
from cointoss_yardstick.suite.case import HEIGHT, Case, kind_of
from cointoss_yardstick.suite.quantities import (
    QUANTITIES,
    NothingSeenError,
    error_of,
    height_at_touches,
)

HAND = Hand.people(height=0.1, speed=1.0, spin=80.0)
"""The hand whose releases are tossed for a share."""
STEPS = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)
"""The steps with which a case is run, over the engine's own."""

ALIKE = 0.1
"""The part by which two limits of an error may differ that lasts."""
BETWEEN = 0.25
"""The part of the way between close states by which a touch may be off where no step is late."""


class Status(StrEnum):
    """What came of a case."""

    MET = "met"
    MISSED = "missed"
    NOT_REALISABLE = "not realisable"
    """The engine says that it can't do this."""
    FAILED = "failed"
    """The engine raised an error, did not answer in time, or showed nothing of what is measured."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """A case run once."""

    dt: float | None
    """The step [s]; None for an engine that goes from event to event."""
    found: tuple[float, ...] = ()
    """What was measured, in SI."""
    error: float = float("nan")
    """The error of what was measured, over the case's scale."""
    height: float = 0.0
    """The height of the lowest point at a touch or at rest [m]; 0 where it is within what is allowed."""
    lowest: float = 0.0
    """That height also where it is allowed [m]."""
    processor_time: float = 0.0
    """How long the engine took [s]."""
    why: str = ""
    """Why nothing was measured."""
    status: Status
    """Whether the error is within the tolerance, and the height is allowed."""


@dataclass(frozen=True, kw_only=True)
class Result:
    """A case, and what came of it."""

    case: Case
    tolerance: float
    own: Run
    """The run with the engine's own step."""
    runs: tuple[Run, ...] = field(default=())
    """The runs with several steps, the largest first."""

    @property
    def order(self) -> float | None:
        """The order of the error in the step: the slope of its logarithm; None where it is not known."""
        known = [run for run in self.runs if run.dt and np.isfinite(run.error) and run.error > _ROUNDING]
        if len(known) < 3:
            return None
        steps, errors = np.log([run.dt or 1 for run in known]), np.log([run.error for run in known])
        return float(np.polyfit(steps, errors, 1)[0])

    @property
    def lasting(self) -> float:
        """The error that no shorter step takes away, if above the limit of an engine without a step; else 0.

        Of three steps, each half the one before, each two extrapolate to a limit. An error lasts where both
        limits are off alike.
        """
        case, found = self.case, [np.array(run.found) for run in self.runs[-3:]]
        if not case.scale or len(found) < 3 or {len(each) for each in found} != {len(case.right)}:
            return 0.0
        before, off = (2 * found[i + 1] - found[i] - case.right for i in (0, 1))
        size, change = (float(np.linalg.norm(each)) / case.scale for each in (off, off - before))
        return size if size > case.tolerance["event_driven"] and change <= ALIKE * size else 0.0


_ROUNDING = 1e-7


def run_cases(
    engines: Sequence[Simulator],
    cases: Sequence[Case],
    progress: Callable[[int, int], None] = lambda *_: None,
) -> list[Result]:
    """Run an engine through cases.

    Args:
        engines: the same one, several times where each runs in a process of its own: they work side by side.
        cases: of the suite.
        progress: called after each run with their number so far and in all.
    """
    own = engines[0].dt
    wanted = [(case, own) for case in cases]
    if own is not None:
        wanted += [(case, own * part) for case in cases if case.is_short for part in STEPS if part != 1]
    wanted.sort(key=lambda each: each[0].is_short)  # what takes longest first
    free = deque(engines)
    made: dict[tuple[str, float | None], Run] = {}

    def run(part: slice) -> None:
        engine = free.pop()
        try:
            made.update({(case.name, dt): run_case(engine, case, dt) for case, dt in wanted[part]})
        finally:
            free.append(engine)
        progress(len(made), len(wanted))

    in_tiles(len(wanted), 1, run, len(engines))
    return [_result(case, own, made) for case in cases]


def _result(case: Case, own: float | None, made: dict[tuple[str, float | None], Run]) -> Result:
    steps = sorted((dt for name, dt in made if name == case.name and dt is not None), reverse=True)
    return Result(
        case=case,
        tolerance=case.tolerance[kind_of(own)],
        own=made[case.name, own],
        runs=tuple(made[case.name, dt] for dt in steps),
    )


def run_case(engine: Simulator, case: Case, dt: float | None) -> Run:
    """Run a case once.

    Args:
        engine: that simulates it.
        case: of the suite.
        dt: the step, None for an engine without one [s].
    """
    step = dt
    if dt is not None and case.quantity.endswith("_at_the_end"):  # at that very time
        step = case.until / max(round(case.until / dt), 1)
    try:
        if case.quantity == "share_of_heads":
            seen = [engine.observe(each, case.until, dt=step) for each in _by_hand(case)]
            found = np.array([sum(each.ended[1] == Outcome.HEADS for each in seen) / len(seen)])
        else:
            seen = [engine.observe(case.scenario, case.until, dt=step, every=case.every)]
            found = QUANTITIES[case.quantity](seen[0])
        part = 1.0 if dt or case.every else BETWEEN
        lowest, is_off = height_at_touches(seen[0], HEIGHT[kind_of(dt)] * case.scenario.coin.radius, part)
    except UnsupportedError as error:
        return Run(dt=dt, why=str(error), status=Status.NOT_REALISABLE)
    except (UnusableEngineError, NothingSeenError, ScenarioError) as error:
        return Run(dt=dt, why=str(error), status=Status.FAILED)
    error = error_of(found, np.array(case.right), case.scale)
    return Run(
        dt=dt,
        found=tuple(found.tolist()),
        error=error,
        height=lowest if is_off else 0.0,
        lowest=lowest,
        processor_time=sum(each.processor_time for each in seen),
        status=Status.MET if error <= case.tolerance[kind_of(dt)] and not is_off else Status.MISSED,
    )


def _by_hand(case: Case) -> Iterator[Scenario]:
    drawn = HAND.releases(case.scenario, case.tosses)
    for i in range(case.tosses):
        yield case.scenario.replace(*(part for name, column in drawn.items() for part in (name, column[i])))


def full(case: Case) -> Case:
    """Return a case at its full length."""
    tosses = case.full_tosses or case.tosses
    narrower = (case.tosses / tosses) ** 0.5
    return replace(
        case,
        until=case.full_until or case.until,
        tosses=tosses,
        right=case.full_right or case.right,
        tolerance={kind: narrower * size for kind, size in case.tolerance.items()},
    )
