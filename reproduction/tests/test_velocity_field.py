"""The velocities of the surface, against the paper's matrices in the space frame."""

import numpy as np
import pytest

from cointoss.models.attitude import rotation_matrix
from cointoss_reproduction.studies.fig13.velocity_field import velocity_fields
from tests.helpers.draws import PAPER_OFFSET, draw_quaternion, scenario
from tests.helpers.tuples import quaternion

V, W = (0.3, -0.2, 0.2), (20.0, -30.0, 10.0)
THICK = scenario(coin={"center_of_mass": PAPER_OFFSET}).body
THIN = scenario(coin={"thickness": 0.0}).body


def skew(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def test_points_lie_on_their_surfaces_with_outward_normals():
    upper, lower, wall = velocity_fields(THICK, V, W)
    r, half = THICK.radius, THICK.thickness / 2
    assert np.all(upper.point[:, 2] == half)
    assert np.all(lower.point[:, 2] == -half)
    assert np.hypot(*wall.point[:, :2].T) == pytest.approx(np.full(len(wall.point), r), rel=1e-14)
    assert np.abs(wall.point[:, 2]).max() == half
    for field in (upper, lower, wall):
        assert np.all(np.sum(field.point * field.normal, axis=1) > 0)
        assert np.linalg.norm(field.normal, axis=1) == pytest.approx(np.ones(len(field.normal)))


def test_velocities_are_the_papers():
    """Eqs (59)-(65), with R, Omega and the projections H_1, H_3, R_theta of the paper."""
    R = np.array(rotation_matrix(quaternion(draw_quaternion(np.random.default_rng(1)))))
    omega = R @ skew(W) @ R.T
    v_B = R @ np.array(V) - omega @ R @ np.array(THICK.center)
    for number, field in enumerate(velocity_fields(THICK, V, W)):
        for i, point in enumerate(field.point):
            v_A = v_B + omega @ R @ point
            if number == 2:
                c, s = point[:2] / THICK.radius
                R_theta = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
                H = R_theta @ np.diag([1, 0, 0]) @ R_theta.T
            else:
                H = np.diag([0, 0, 1])
            v_n = R @ H @ R.T @ v_A
            outwards = v_n @ R @ field.normal[i] > 0
            assert R @ field.velocity[i] == pytest.approx(v_A, abs=1e-14)
            assert R @ field.tangential[i] == pytest.approx(v_A - v_n, abs=1e-14)
            assert R @ field.outward[i] == pytest.approx(outwards * v_n, abs=1e-14)
            # At a speed of nothing but rounding either answer will do.
            assert field.moves_outwards[i] == outwards or np.linalg.norm(v_n) < 1e-14


def test_both_faces_of_a_thin_coin_move_alike():
    """Eq. (75); there is no wall."""
    upper, lower, wall = velocity_fields(THIN, V, W)
    assert np.array_equal(upper.velocity, lower.velocity)
    assert np.array_equal(upper.tangential, lower.tangential)
    assert len(wall.point) == 0
