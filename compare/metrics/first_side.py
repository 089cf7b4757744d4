"""How often the side up at the release is up: at each touch, at rest, or in a hand that catches the coin."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.models.records import Ending, Outcome
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario
from cointoss.models.stages import stage

TOUCHES = (0, 1, 2, 3)
"""Impacts before each touch that is counted."""


@dataclass(frozen=True)
class FirstSide:
    """Which tosses show the side that was up at their release."""

    touches: tuple[NDArray[np.bool_], ...]
    """At each of `TOUCHES`, or in the end where a toss ended before, (n,)."""
    at_rest: NDArray[np.bool_]
    """Of those that end on a face, (m,)."""


def first_side(scenario: Scenario, start: Releases, engine: Engine) -> FirstSide:
    """Toss coins released heads up, and see where heads are up.

    Args:
        scenario: coin, air and floor.
        start: the releases.
        engine: that tosses.
    """
    toss_many = engine.package.toss_many
    with stage("sides up", "counts", total=len(TOUCHES) + 1) as progress:
        faces = []
        for impacts in TOUCHES:
            faces.append(toss_many(scenario.replace("ending.max_impacts", impacts + 1), start).after(impacts))
            progress(len(faces), len(TOUCHES) + 1)
        outcome = toss_many(scenario, start).outcome
    ended = outcome[(outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)]
    return FirstSide(tuple(face == Outcome.HEADS for face in faces), ended == Outcome.HEADS)


def caught_side(scenario: Scenario, start: Releases, engine: Engine) -> NDArray[np.bool_]:
    """Toss coins released heads up to a hand, and see where heads are up in it.

    Args:
        scenario: coin, air, floor, and the height at which a hand catches the coin.
        start: the releases.
        engine: that tosses.

    Returns:
        Of those that are caught, (m,).
    """
    ended = engine.package.toss_many(scenario, start)
    return ended.outcome[ended.ending == Ending.CAUGHT] == Outcome.HEADS
