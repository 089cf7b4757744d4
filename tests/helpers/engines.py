"""Both engines by their verbs, without the warnings of what MuJoCo tosses approximately."""

import warnings

from cointoss.compare.engines import Engine
from cointoss.models.outcomes import Outcomes
from cointoss.models.records import ApproximationWarning, Toss
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario


def toss(engine: Engine, case: Scenario) -> Toss:
    """Return one toss, with the engine's settings for one."""
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        return engine.package.toss(case)


def toss_as_many(engine: Engine, case: Scenario) -> Toss:
    """Return one toss, with the engine's settings for many."""
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        return engine.package.toss(case, settings=engine.package.MANY)


def toss_many(engine: Engine, case: Scenario, releases: Releases) -> Outcomes:
    """Return many tosses, with the engine's settings for many."""
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        return engine.package.toss_many(case, releases)
