"""Lyapunov exponents of maps that are known, by both methods."""

import numpy as np
import pytest

from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss_reproduction.studies.fig27.lyapunov import divergence, growth_by_tangent
from tests.helpers.draws import scenario


def test_neighbours_of_a_doubled_angle_part_by_two():
    """Exponent log 2; a finite series adds noise only where neighbours are as far as the circle is wide."""
    angles = [1.0]
    rng = np.random.default_rng(1)
    for _ in range(6000):
        # Doubling loses a bit a step: fresh ones come from the generator.
        angles.append((2 * angles[-1] + 1e-9 * rng.random()) % (2 * np.pi))
    curve = divergence(np.array(angles), dimension=1, longest=6)
    assert np.diff(curve[:4]) == pytest.approx(np.log(2), abs=0.05)


def test_neighbours_of_a_turning_angle_stay():
    angles = np.mod(np.arange(3000) * 1.2345, 2 * np.pi)
    curve = divergence(angles, dimension=2, longest=5)
    assert np.diff(curve) == pytest.approx(0, abs=1e-9)


def test_the_growth_of_a_change_is_that_of_two_tosses():
    """A change of 1e-9 in the height, in tosses made apart: the same factor over the first impacts."""

    def case(z):
        return scenario(
            coin={"thickness": 0.0},
            floor={"contact": "smooth", "restitution": 1.0},
            release={"position": [0, 0, z], "angles": [0, 0.4, 0], "angular_velocity": [10, 40.15, 5]},
            ending={"max_impacts": 6},
        )

    tosses = [run(c.body, c.rules, state_at_release(c.release)) for c in (case(0.4), case(0.4 + 1e-9))]
    apart = [
        np.linalg.norm(a["angular_velocity_after"] - b["angular_velocity_after"])
        for a, b in zip(tosses[0].rows, tosses[1].rows, strict=True)
    ]
    growth = growth_by_tangent(case(0.4))
    assert np.log(apart[5] / apart[2]) == pytest.approx(growth[3:6].sum(), abs=0.7)
    assert growth[3:6].sum() > 3
