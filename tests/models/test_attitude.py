"""The rotation conventions, against SciPy's Rotation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from cointoss.models.attitude import quaternion_from_angles, quaternion_product, rotation_matrix

angle = st.floats(-10, 10)


@given(angle, angle, angle)
def test_angles_are_z_x_z_about_body_axes(psi, theta, phi):
    ours = rotation_matrix(quaternion_from_angles((psi, theta, phi)))
    scipys = Rotation.from_euler("ZXZ", [psi, theta, phi]).as_matrix()
    assert np.abs(np.array(ours) - scipys).max() < 5e-15


@pytest.mark.parametrize("seed", range(5))
def test_a_product_of_quaternions_is_one_turn_after_the_other(seed):
    a, b = (e / np.linalg.norm(e) for e in np.random.default_rng(seed).normal(size=(2, 4)))
    product = np.array(quaternion_product(a, b))
    scipys = Rotation.from_quat(a, scalar_first=True) * Rotation.from_quat(b, scalar_first=True)
    expected = scipys.as_quat(scalar_first=True)
    assert np.abs(product - np.copysign(1, product @ expected) * expected).max() < 1e-15
