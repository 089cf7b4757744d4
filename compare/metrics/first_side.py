"""How often the side up at the release is up: at each touch, at rest, or in a hand that catches the coin."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.models.answers import Answers
from cointoss.models.batch import PLACE, states_of
from cointoss.models.records import Array, Ending, Outcome

TOUCHES = (0, 1, 2, 3)
"""The numbers of impacts before the touches that are counted."""


@dataclass(frozen=True)
class FirstSide:
    """Which tosses show the side that was up at their release."""

    touches: tuple[NDArray[np.bool_], ...]
    """Whether that side is up at each of `TOUCHES`, or in the end where a toss ended before, (n,)."""
    at_rest: NDArray[np.bool_]
    """Whether that side is up at the end of the tosses that end on a face, (m,)."""


def first_side(rows: Array, engine: Engine) -> FirstSide:
    """Toss coins, and return at which touches the side that was up at the release is up.

    Args:
        rows: of the scenarios, whose attitude is a quaternion, (n, m).
        engine: that tosses.
    """
    several = np.tile(rows, (len(TOUCHES) + 1, 1, 1))
    several[:-1, :, PLACE["ending.max_impacts"]] = np.array(TOUCHES)[:, None] + 1
    answers = engine.package.toss_rows(several.reshape(-1, rows.shape[1]))
    table = [np.split(column, len(several)) for column in answers if column is not None]
    *at_touches, at_end = (Answers(*part) for part in zip(*table, strict=True))
    first, outcome = first_faces(rows), at_end.outcome
    on_a_face = (outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)
    faces = (one.after(impacts) for one, impacts in zip(at_touches, TOUCHES, strict=True))
    return FirstSide(tuple(face == first for face in faces), (outcome == first)[on_a_face])


def caught_side(rows: Array, engine: Engine) -> NDArray[np.bool_]:
    """Toss coins to a hand, and return in which catches the side that was up at the release is up.

    Args:
        rows: of the scenarios, with the height at which a hand catches the coin, (n, m); their attitude is
            a quaternion.
        engine: that tosses.

    Returns:
        Of those that are caught, (m,).
    """
    ended = engine.package.toss_rows(rows)
    return (ended.outcome == first_faces(rows))[ended.ending == Ending.CAUGHT]


def first_faces(rows: Array) -> NDArray[np.int8]:
    """Return the face that is up at each release, as an `Outcome`, (n,)."""
    e0, e1, e2, e3 = states_of(rows)[:, 6:10].T
    return np.where(e0**2 + e3**2 > e1**2 + e2**2, Outcome.HEADS, Outcome.TAILS).astype(np.int8)
