"""Assertions on an engine's toss, whose messages say which impact, which quantity, and how far off."""

from os import PathLike
from typing import Any

import numpy as np

from cointoss import Scenario, Toss, analytic, load
from cointoss.study import Against
from cointoss_yardstick.simulators.simulator import Simulator, simulator_of
from cointoss_yardstick.suite.card import height_told, value
from cointoss_yardstick.suite.case import Case, kind_of
from cointoss_yardstick.suite.running import Status, run_case

AFTER = 0.05
"""How long after the end of the analytic toss the engine's states end [s]."""


def assert_agrees(
    given: Toss | Any, scenario: Scenario | str | PathLike[str], *, tolerance: float = 1e-2
) -> None:
    """Assert that a toss obeys the contact law, and agrees with the analytic engine as far as it must.

    Each impulse is held against the law in the very state in which the coin touched, so that it carries
    nothing of earlier impacts. The faces must agree within the horizon: as far as errors of that size change
    none.

    Args:
        given: a toss of the scenario, or an engine that tosses it, see
            `cointoss_yardstick.simulators.simulator.simulator_of`.
        scenario: what is tossed; or a file's path, or a name such as "fig24a".
        tolerance: the largest relative error of the flight to the first touch, its time, and an impulse.

    Raises:
        AssertionError: naming the impact, the quantity, how far off it is, and what is allowed.
    """
    described = scenario if isinstance(scenario, Scenario) else load(scenario)
    right = analytic.toss(described)
    engine = given if isinstance(given, Toss | Simulator) else simulator_of(given)
    toss = engine if isinstance(engine, Toss) else engine.toss(described, right.end_time + AFTER)
    who, first, expected = toss.engine, _first(toss), _first(right)
    _require(
        len(toss.impacts) > 0 or not len(right.impacts),
        f"{who}: no impact was seen in {toss.end_time:.4g} s; the first is at {expected:.6g} s",
    )
    pair = Against(measure=right, toss=toss)
    flight, errors = pair.flight_error, pair.errors
    _require(flight <= tolerance, f"{who}: flight before impact 1{_off(flight, tolerance)}")
    late = abs(first - expected) / max(expected, 1e-12)
    _require(
        late <= tolerance,
        f"{who}: impact 1: time {first:.6g} s, right {expected:.6g} s{_off(late, tolerance)}",
    )
    for i, error in enumerate(errors.tolist()):
        time, impulse = toss.impacts.time[i], value(toss.impacts.impulse[i])
        _require(
            error <= tolerance,
            f"{who}: impact {i + 1} at {time:.6g} s: impulse ({impulse}) N s against the contact law"
            f"{_off(error, tolerance)}",
        )
    horizon, agreed = pair.common_horizon, pair.common_prefix
    face = slice(agreed, agreed + 1)
    _require(
        agreed >= horizon,
        f"{who}: impact {agreed + 1}: face {toss.sequence[face] or 'none'}, right {right.sequence[face]}; "
        f"with impulses off by {np.max(errors, initial=0.0):.1e} the first {horizon} must agree",
    )


def assert_met(engine: Simulator, case: Case) -> None:
    """Assert that an engine meets a case, or says that it can't do what the case asks for.

    Raises:
        AssertionError: naming the case, the quantity, what was found, how far off it is, and what is allowed.
    """
    run, limit = run_case(engine, case, engine.dt), case.tolerance[kind_of(engine.dt)]
    _require(run.status != Status.FAILED, f"{engine.name}: {case.name}: {run.why}")
    _require(
        run.status != Status.MISSED,
        f"{engine.name}: {case.name} ({case.title}): {case.quantity} {value(run.found)}, right "
        f"{value(case.right)}{_off(run.error, limit)}, {case.reason}{height_told(run)}",
    )


def _off(error: float, allowed: float) -> str:
    return f": off by {error:.1e}, allowed {allowed:.1e}"


def _first(toss: Toss) -> float:
    return float(toss.impacts.time[0]) if len(toss.impacts) else 0.0


def _require(holds: bool, told: str) -> None:
    if not holds:
        raise AssertionError(told)
