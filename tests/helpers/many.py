"""Many releases as arrays, and what each of their tosses must be."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from cointoss.models.outcomes import Outcomes
from cointoss.models.records import Array
from cointoss.models.releases import Releases
from tests.helpers.draws import draw_release

PARTS = ("position", "velocity", "quaternion", "angular_velocity")


def as_releases(drawn: Sequence[dict[str, Any]]) -> Releases:
    """Return releases, one by one, as arrays."""
    return Releases(**{name: np.array([one[name] for one in drawn]) for name in PARTS})


def as_parts(states: Array) -> dict[str, Array]:
    """Return states, (13,) or (n, 13), as the parts of a release or of releases."""
    return dict(zip(PARTS, np.split(states, [3, 6, 10], axis=-1), strict=True))


def draw_releases(rng: np.random.Generator, n: int) -> tuple[list[dict[str, Any]], Releases]:
    """Draw releases, one by one and as arrays."""
    drawn = [draw_release(rng) for _ in range(n)]
    return drawn, as_releases(drawn)


def releases_of(
    n: int, *, position=(0, 0, 1), velocity=(0, 0, 0), quaternion=(1, 0, 0, 0), angular_velocity=(0, 0, 0)
) -> Releases:
    """Return `n` releases, by default flat and at rest; each part is one for all, (k,), or (n, k)."""
    parts = (position, velocity, quaternion, angular_velocity)
    return Releases(
        **{name: np.ones((n, 1)) * np.asarray(part) for name, part in zip(PARTS, parts, strict=True)}
    )


def assert_same_toss(outcomes: Outcomes, i: int, tossed: Any) -> None:
    """Check that one of many is the toss whose rows of impacts, ending and end are these, to the bit."""
    faces = tossed.rows["face"]
    assert outcomes.outcome[i] == tossed.outcome
    assert outcomes.ending[i] == tossed.ending
    assert outcomes.impacts[i] == len(faces)
    assert outcomes.end_time[i] == tossed.end_time
    assert outcomes.last_face[i] == (faces[-1] if len(faces) else 0)
