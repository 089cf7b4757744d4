"""Many releases as states, and what each of their tosses must be."""

from typing import Any

import numpy as np

from cointoss.models.answers import Answers
from cointoss.models.records import Array, Toss
from tests.helpers.draws import draw_release

PARTS = ("position", "velocity", "quaternion", "angular_velocity")


def draw_states(rng: np.random.Generator, n: int) -> tuple[list[dict[str, Any]], Array]:
    """Draw releases, one by one and as states, (n, 13)."""
    drawn = [draw_release(rng) for _ in range(n)]
    return drawn, np.array([np.concatenate([one[name] for name in PARTS]) for one in drawn])


def same_states(
    n: int, *, position=(0, 0, 1), velocity=(0, 0, 0), quaternion=(1, 0, 0, 0), angular_velocity=(0, 0, 0)
) -> Array:
    """Return n states, (n, 13), by default flat and at rest; each part is one for all, (k,), or (n, k)."""
    parts = (position, velocity, quaternion, angular_velocity)
    return np.hstack([np.ones((n, 1)) * np.asarray(part) for part in parts])


def assert_same_toss(answers: Answers, i: int, tossed: Toss) -> None:
    """Check that one of many is this toss, to the bit."""
    faces = [0, *tossed.impacts.face]
    due = (tossed.outcome, tossed.ending, len(faces) - 1, faces[-1], tossed.end_time)
    assert tuple(column[i] for column in answers[:5]) == due  # outcome, ending, impacts, last_face, end_time
