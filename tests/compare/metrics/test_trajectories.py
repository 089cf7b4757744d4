"""Distances, angles and partings of two paths."""

import numpy as np
import pytest

from cointoss.compare.metrics.trajectories import attitude_angle, distance, parting_time, tilt
from cointoss.models.records import States


def states(quaternions, positions=None):
    n = len(quaternions)
    return States(
        time=np.arange(n, dtype=float),
        position=np.zeros((n, 3)) if positions is None else np.array(positions, dtype=float),
        velocity=np.zeros((n, 3)),
        quaternion=np.array(quaternions, dtype=float),
        angular_velocity=np.zeros((n, 3)),
    )


def test_attitude_angle_is_that_of_the_rotation_between():
    angles = np.array([0.0, 1e-9, 0.3, 2.0, np.pi])
    turned = states([[np.cos(a / 2), 0, np.sin(a / 2), 0] for a in angles])
    still = states([[1, 0, 0, 0]] * 5)
    for other in (turned, states(-turned.quaternion)):
        assert attitude_angle(still, other) == pytest.approx(angles, rel=1e-12)


def test_distance_and_tilt():
    a = states([[1, 0, 0, 0]] * 3, [[0, 0, 0], [1, 1, 1], [1, 1, 1]])
    b = states(
        [
            [np.cos(0.2), np.sin(0.2), 0, 0],
            [np.cos(0.2), 0, np.sin(0.2), 0],
            [np.cos(1.5), 0, np.sin(1.5), 0],
        ],
        [[3, 4, 0], [1, 1, 1], [1, 1, 3]],
    )
    assert distance(a, b).tolist() == [5, 0, 2]
    assert tilt(b) == pytest.approx([0.4, 0.4, 3.0], rel=1e-14)


@pytest.mark.parametrize(
    ("apart", "due"), [([0, 0.5, 0.1, 2], 1.0), ([0.4, 0.4, 0.4, 0.5], 3.0), ([0, 0, 0, 0], None)]
)
def test_parting_time_is_the_first_beyond(apart, due):
    assert parting_time(np.array([0.0, 1.0, 2.0, 3.0]), np.array(apart), 0.4) == due
