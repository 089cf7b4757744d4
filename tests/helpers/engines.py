"""Both engines by their public functions; what an engine's settings are called is known here alone."""

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

import analytic
import coin_mj
from compare.engines import Engine
from models.outcomes import Outcomes
from models.records import ApproximationWarning, Toss
from models.releases import Releases
from models.scenario import Scenario


def toss(engine: Engine, case: Scenario) -> Toss:
    """Return one toss, with the engine's settings for one."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ApproximationWarning)
        return analytic.toss(case) if engine is Engine.ANALYTIC else coin_mj.toss(case)


def toss_as_many(engine: Engine, case: Scenario) -> Toss:
    """Return one toss, with the engine's settings for many."""
    if engine is Engine.ANALYTIC:
        return analytic.toss(case)
    coarse = {name: getattr(coin_mj.MANY, name) for name in ("stiffness", "steps", "flight_angle")}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ApproximationWarning)
        return coin_mj.toss(case, **coarse)


def toss_many(engine: Engine, case: Scenario, releases: Releases) -> Outcomes:
    """Return many tosses, with the engine's settings for many."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ApproximationWarning)
        many = analytic.toss_many if engine is Engine.ANALYTIC else coin_mj.toss_many
        return many(case, releases)


def as_releases(drawn: Sequence[dict[str, Any]]) -> Releases:
    """Return releases, one by one, as arrays."""
    names = ("position", "velocity", "quaternion", "angular_velocity")
    return Releases(**{name: np.array([one[name] for one in drawn]) for name in names})
