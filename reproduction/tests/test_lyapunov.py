"""Lyapunov exponents of maps that are known, by both methods."""

import numpy as np
import pytest

from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss_reproduction.studies.fig27.lyapunov import _neighbours, divergence, growth_by_tangent
from tests.helpers.draws import ZLOTY, scenario


def doubled():
    """Yield an angle that doubles; it loses a bit a step, and fresh ones come from the generator."""
    angle, rng = 1.0, np.random.default_rng(1)
    while True:
        yield angle
        angle = (2 * angle + 1e-9 * rng.random()) % (2 * np.pi)


@pytest.mark.parametrize(
    ("angles", "dimension", "steps", "exponent", "error"),
    [
        # A finite series adds noise only where neighbours are as far as the circle is wide.
        ([angle for angle, _ in zip(doubled(), range(6001), strict=False)], 1, 3, np.log(2), 0.05),
        (np.mod(np.arange(3000) * 1.2345, 2 * np.pi), 2, 5, 0.0, 1e-9),
    ],
    ids=["doubles", "turns"],
)
def test_neighbours_part_by_the_exponent_of_a_map(angles, dimension, steps, exponent, error):
    curve = divergence(np.array(angles), dimension=dimension, longest=6)
    assert np.diff(curve[: steps + 1]) == pytest.approx(exponent, abs=error)


def test_a_neighbour_is_not_near_in_time():
    found = _neighbours(np.arange(20.0)[:, None], apart=2)
    assert (np.abs(found - np.arange(20)) == 3).all()


def case(height, times=1.0):
    """Return a toss of a coin that is larger in all its lengths, and slower by the root of this."""
    speed = times**0.5
    return scenario(
        coin={"thickness": 0.0, "radius": times * ZLOTY["radius"]},
        floor={"contact": "smooth", "restitution": 1.0},
        release={
            "position": [0, 0, times * height],
            "angles": [0, 0.4, 0],
            "angular_velocity": [10 / speed, 40.15 / speed, 5 / speed],
        },
        ending={"max_impacts": 6},
    )


def test_the_growth_of_a_change_is_that_of_two_tosses():
    """A change of 1e-9 in the height, in tosses made apart: the same factor over the first impacts."""
    tosses = [run(c.body, c.rules, state_at_release(c.release)) for c in (case(0.4), case(0.4 + 1e-9))]
    apart = [
        np.linalg.norm(a["angular_velocity_after"] - b["angular_velocity_after"])
        for a, b in zip(tosses[0].rows, tosses[1].rows, strict=True)
    ]
    growth = growth_by_tangent(case(0.4))
    assert np.log(apart[5] / apart[2]) == pytest.approx(growth[3:6].sum(), abs=0.7)
    assert growth[3:6].sum() > 3
    # A coin four times as large does the same in twice the time.
    assert growth_by_tangent(case(0.4, 4.0)) == pytest.approx(growth, rel=1e-9)
