"""Both engines by their verbs, without the warnings of what MuJoCo tosses approximately."""

import warnings

from cointoss.compare.engines import Engine
from cointoss.models.answers import Answers
from cointoss.models.batch import rows_from_states
from cointoss.models.records import ApproximationWarning, Array, Toss
from cointoss.models.scenario import Scenario


def toss(engine: Engine, case: Scenario) -> Toss:
    """Return one toss, with the engine's settings for one."""
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        return engine.package.toss(case)


def toss_many(engine: Engine, case: Scenario, states: Array) -> Answers:
    """Return the tosses of a scenario from many states, (n, 13), with the engine's settings for many."""
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        return engine.package.toss_rows(rows_from_states(case, states))
