"""The twelve Euler sequences against SciPy, and the paper's Table 1 found again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from cointoss_reproduction.studies.table1.euler_angles import (
    axes_of,
    axis_rotation,
    rate_matrix,
    rotation_of,
    singularity,
)
from cointoss_reproduction.studies.table1.study import PRINTED

angle = st.floats(-10, 10)

each_sequence = pytest.mark.parametrize("sequence", PRINTED)


def scipys(sequence):
    """Give the name of a sequence in SciPy, whose capitals are axes that turn with the body."""
    return "".join("XYZ"[axis] for axis in axes_of(sequence))


@each_sequence
@given(st.tuples(angle, angle, angle))
def test_rotation_is_scipys_about_axes_that_turn_with_the_body(sequence, angles):
    ours = rotation_of(sequence, angles)
    assert np.abs(ours - Rotation.from_euler(scipys(sequence), angles).as_matrix()).max() < 5e-15


@pytest.mark.parametrize("axis", range(3))
def test_a_turn_about_one_axis_is_right_handed(axis):
    ahead, beyond = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
    assert axis_rotation(axis, np.pi / 2) @ ahead == pytest.approx(beyond, abs=1e-16)


@each_sequence
def test_rate_matrix_turns_rates_into_angular_velocity(sequence):
    rng = np.random.default_rng(31)
    for _ in range(20):
        angles, rates = rng.uniform(-3, 3, 3), rng.normal(size=3)
        # RᵀṘ by a central difference, good to dt² and 1e-16/dt.
        dt = 1e-5
        ahead, behind = (rotation_of(sequence, angles + s * dt * rates) for s in (1, -1))
        skew = rotation_of(sequence, angles).T @ (ahead - behind) / (2 * dt)
        w = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
        assert np.abs(rate_matrix(sequence, angles) @ rates - w).max() < 3e-9


@each_sequence
def test_table_1_follows_from_the_rate_matrix(sequence):
    """The determinant is that of the table for all angles: it vanishes there and nowhere else."""
    name, sign, _ = found = singularity(sequence)
    assert found == PRINTED[sequence]
    rng = np.random.default_rng(32)
    function = {"sin": np.sin, "cos": np.cos}[name]
    for angles in rng.uniform(-7, 7, (50, 3)):
        determinant = np.linalg.det(rate_matrix(sequence, angles))
        assert determinant == pytest.approx(sign * function(angles[1]), abs=1e-15)
