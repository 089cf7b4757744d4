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
    """Whether that side is up at each of `TOUCHES`, or in the end where a toss ended before, (n,)."""
    at_rest: NDArray[np.bool_]
    """Whether that side is up at the end of the tosses that end on a face, (m,)."""


def first_side(scenario: Scenario, start: Releases, engine: Engine) -> FirstSide:
    """Toss coins, and see where the side is up that was at the release.

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
    first, on_a_face = first_faces(start), (outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)
    return FirstSide(tuple(face == first for face in faces), (outcome == first)[on_a_face])


def caught_side(scenario: Scenario, start: Releases, engine: Engine) -> NDArray[np.bool_]:
    """Toss coins to a hand, and see where the side is up in it that was at the release.

    Args:
        scenario: coin, air, floor, and the height at which a hand catches the coin.
        start: the releases.
        engine: that tosses.

    Returns:
        Of those that are caught, (m,).
    """
    ended = engine.package.toss_many(scenario, start)
    return (ended.outcome == first_faces(start))[ended.ending == Ending.CAUGHT]


def first_faces(start: Releases) -> NDArray[np.int8]:
    """Return the face that is up at each release, as an `Outcome`, (n,)."""
    e0, e1, e2, e3 = start.quaternion.T
    return np.where(e0**2 + e3**2 > e1**2 + e2**2, Outcome.HEADS, Outcome.TAILS).astype(np.int8)
