"""Many releases as states, and what each of their tosses must be."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from cointoss.models.answers import Answers
from cointoss.models.records import Array, Toss
from tests.helpers.draws import draw_release

PARTS = ("position", "velocity", "quaternion", "angular_velocity")


def as_states(drawn: Sequence[dict[str, Any]]) -> Array:
    """Return releases, one by one, as states, (n, 13)."""
    return np.array([np.concatenate([one[name] for name in PARTS]) for one in drawn])


def draw_states(rng: np.random.Generator, n: int) -> tuple[list[dict[str, Any]], Array]:
    """Draw releases, one by one and as states, (n, 13)."""
    drawn = [draw_release(rng) for _ in range(n)]
    return drawn, as_states(drawn)


def same_states(
    n: int, *, position=(0, 0, 1), velocity=(0, 0, 0), quaternion=(1, 0, 0, 0), angular_velocity=(0, 0, 0)
) -> Array:
    """Return n states, (n, 13), by default flat and at rest; each part is one for all, (k,), or (n, k)."""
    parts = (position, velocity, quaternion, angular_velocity)
    return np.hstack([np.ones((n, 1)) * np.asarray(part) for part in parts])


def assert_same_toss(answers: Answers, i: int, tossed: Toss) -> None:
    """Check that one of many is this toss, to the bit."""
    faces = tossed.impacts.face
    assert answers.outcome[i] == tossed.outcome
    assert answers.ending[i] == tossed.ending
    assert answers.impacts[i] == len(faces)
    assert answers.end_time[i] == tossed.end_time
    assert answers.last_face[i] == (faces[-1] if len(faces) else 0)
