"""The verb: an engine held against the suite of cases."""

from collections.abc import Iterable
from typing import Any

from cointoss.study import stage
from cointoss_yardstick.simulators.simulator import LIMIT, simulators_of
from cointoss_yardstick.suite.card import Card
from cointoss_yardstick.suite.case import cases as all_cases
from cointoss_yardstick.suite.running import full as at_full_length
from cointoss_yardstick.suite.running import run_cases


def conform(engine: Any, *, cases: Iterable[str] = (), full: bool = False, time_limit: float = LIMIT) -> Card:
    """Test an engine on cases with known answers.

    Args:
        engine: an object with a function `simulate(scenario, times)`, see
            `cointoss_yardstick.Simulates`; or "package.module:name" of one, or the name of
            an entry point `cointoss.engines`, which runs in processes of its own, side by side; or "analytic"
            or "mujoco". "PYTHON -m package.module:name" is run by another Python, which needs NumPy alone.
        cases: the names of the cases to run, by default all.
        full: whether to simulate an hour in place of a minute, and 10,000 tosses in place of 200.
        time_limit: the longest time for one answer of the engine [s].

    Returns:
        The card, with the result of each case.

    Raises:
        ValueError: for a name that no case has.
        TypeError: for an object that is no engine.
        UnusableEngineError: for an engine that can't be started.
    """
    known = {case.name: case for case in all_cases()}
    for name in (asked := tuple(cases)):
        if name not in known:
            raise ValueError(f"{name}: accepted: {', '.join(known)}")
    chosen = [
        at_full_length(case) if full else case for name, case in known.items() if name in (asked or known)
    ]
    with (
        simulators_of(engine, time_limit) as engines,
        stage(f"testing {engines[0].name} on {len(chosen)} cases", "runs") as progress,
    ):
        return Card.of(engines[0], run_cases(engines, chosen, progress))
