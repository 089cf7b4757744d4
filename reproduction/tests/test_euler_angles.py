"""The twelve Euler sequences against SciPy, and the paper's Table 1 found again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import root_scalar
from scipy.spatial.transform import Rotation

from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss_reproduction.studies.table1.euler_angles import (
    Sequence,
    Singularity,
    angles_of,
    axis_rotation,
    rate_matrix,
    rotation_of,
    singularity,
)

each_sequence = pytest.mark.parametrize("sequence", Sequence, ids=lambda sequence: sequence.value)
angle = st.floats(-10, 10)

SINE, COSINE = 0.0, np.pi / 2
TABLE_1 = {
    "121": Singularity("sin", -1, SINE),
    "123": Singularity("cos", +1, COSINE),
    "131": Singularity("sin", -1, SINE),
    "132": Singularity("cos", -1, COSINE),
    "212": Singularity("sin", -1, SINE),
    "213": Singularity("cos", -1, COSINE),
    "231": Singularity("cos", +1, COSINE),
    "232": Singularity("sin", -1, SINE),
    "312": Singularity("cos", +1, COSINE),
    "313": Singularity("sin", -1, SINE),
    "321": Singularity("cos", -1, COSINE),
    "323": Singularity("sin", -1, SINE),
}


def test_there_are_twelve():
    assert [sequence.value for sequence in Sequence] == list(TABLE_1)
    assert Sequence.ZETA_XI_ZETA.axes == (2, 0, 2)


def scipys(sequence):
    """Give the name of a sequence in SciPy, whose capitals are axes that turn with the body."""
    return "".join("XYZ"[axis] for axis in sequence.axes)


@each_sequence
@given(st.tuples(angle, angle, angle))
def test_rotation_is_scipys_about_axes_that_turn_with_the_body(sequence, angles):
    ours = rotation_of(sequence, angles)
    assert np.abs(ours - Rotation.from_euler(scipys(sequence), angles).as_matrix()).max() < 5e-15


@given(angle, angle, angle)
def test_the_classical_angles_are_the_sequence_313(psi, theta, phi):
    ours = rotation_of(Sequence.ZETA_XI_ZETA, [psi, theta, phi])
    assert np.abs(ours - rotation_matrix(quaternion_from_angles((psi, theta, phi)))).max() < 5e-15


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
    found = singularity(sequence)
    assert found == TABLE_1[sequence.value]
    rng = np.random.default_rng(32)
    function = {"sin": np.sin, "cos": np.cos}[found.function]
    for angles in rng.uniform(-7, 7, (50, 3)):
        determinant = np.linalg.det(rate_matrix(sequence, angles))
        assert determinant == pytest.approx(found.sign * function(angles[1]), abs=1e-15)


@each_sequence
def test_the_rate_matrix_loses_its_rank_there_and_nowhere_else(sequence):
    phi_1, phi_3 = 0.4, -1.3

    def determinant(phi_2):
        return np.linalg.det(rate_matrix(sequence, [phi_1, phi_2, phi_3]))

    grid = np.linspace(-7, 7, 301) + 1e-3
    values = [determinant(phi_2) for phi_2 in grid]
    zeros = [
        root_scalar(determinant, bracket=(a, b)).root
        for a, b, at_a, at_b in zip(grid, grid[1:], values, values[1:], strict=False)
        if at_a * at_b < 0
    ]
    expected = singularity(sequence).angle + np.pi * np.arange(-3, 4)
    expected = expected[np.abs(expected) < 7]
    assert zeros == pytest.approx(expected, abs=1e-12)
    for zero in zeros:
        assert np.linalg.matrix_rank(rate_matrix(sequence, [phi_1, zero, phi_3]), tol=1e-9) == 2


@each_sequence
def test_angles_there_and_back(sequence):
    rng = np.random.default_rng(33)
    low, high = (0, np.pi) if sequence.value[0] == sequence.value[2] else (-np.pi / 2, np.pi / 2)
    for _ in range(200):
        angles = np.array([rng.uniform(-np.pi, np.pi), rng.uniform(low, high), rng.uniform(-np.pi, np.pi)])
        R = rotation_of(sequence, angles)
        back = angles_of(sequence, R)
        distance = abs(np.linalg.det(rate_matrix(sequence, angles)))
        assert np.abs(back - angles).max() < 4e-15 / distance
        assert np.abs(rotation_of(sequence, back) - R).max() < 2e-15
        assert np.abs(back - Rotation.from_matrix(R).as_euler(scipys(sequence))).max() < 4e-15 / distance


@each_sequence
@pytest.mark.parametrize("turns", [0, 1])
def test_near_a_singularity_the_attitude_is_kept_and_at_it_refused(sequence, turns):
    singular = singularity(sequence).angle + turns * np.pi
    for off in (1e-7, -1e-5):
        R = rotation_of(sequence, [0.3, singular + off, 1.1])
        assert np.abs(rotation_of(sequence, angles_of(sequence, R)) - R).max() < 2e-15
    for off in (0, 1e-9):
        R = rotation_of(sequence, [0.3, singular + off, 1.1])
        with pytest.raises(ValueError, match=f"{sequence.value} is singular at this attitude"):
            angles_of(sequence, R)
