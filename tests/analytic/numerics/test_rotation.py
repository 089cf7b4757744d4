"""Euler parameters: the matrix and angular velocity, there and back, against SciPy."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from cointoss.analytic.numerics.rotation import attitude_near, quaternion_rate
from cointoss.models.attitude import quaternion_product, rotation_matrix
from tests.helpers.draws import draw_quaternion
from tests.helpers.tuples import quaternion, vector

part = st.floats(-1, 1)
axes = st.tuples(part, part, part).filter(lambda v: np.linalg.norm(v) > 0.1)


@given(axes, st.sampled_from([0.0, np.pi, np.pi / 2]), st.sampled_from([0, 1e-15, 1e-12, 1e-8, 1e-4, 0.1]))
@example((1.0, 0.0, 0.0), np.pi, 0)
@example((0.0, 1.0, 0.0), np.pi, 0)
@example((0.0, 0.0, 1.0), np.pi, 0)
@example((0.0, 1.0, -1.0), np.pi, 0)
def test_axis_to_matrix_and_back_near_every_half_turn(axis, angle, off):
    """Eqs (11) to (13), and of e and -e the one on the side of the attitude before."""
    half, unit = (angle + off) / 2, np.array(axis) / np.linalg.norm(axis)
    e = np.array([np.cos(half), *(np.sin(half) * unit)])
    R = rotation_matrix(tuple(e))
    assert np.abs(np.array(R) - Rotation.from_rotvec(2 * half * unit).as_matrix()).max() < 2e-15
    for before in (e, -e, np.add(e, [0.1, -0.2, 0.3, 0.1])):
        back = np.array(attitude_near(R, quaternion(before)))
        assert np.abs(back * np.sign(before @ e) - e).max() < 1e-15


@pytest.mark.parametrize("seed", range(20))
def test_angular_velocity_and_acceleration_are_the_inverse_of_the_rates(seed):
    """Eqs (17), (18) and (19): the vector parts of 2 ē ∘ ė, of 2 ē ∘ ë, and in space of 2 ė ∘ ē."""
    rng = np.random.default_rng(seed)
    e, w, w_rate = quaternion(draw_quaternion(rng)), vector(rng.normal(size=3)), vector(rng.normal(size=3))
    e_rate = quaternion_rate(e, w)
    e_acceleration = quaternion(np.add(quaternion_rate(e_rate, w), quaternion_rate(e, w_rate)))
    back = (e[0], -e[1], -e[2], -e[3])
    in_space = np.array(rotation_matrix(e)) @ w
    assert 2 * np.array(quaternion_product(back, e_rate))[1:] == pytest.approx(w, abs=2e-15)
    assert 2 * np.array(quaternion_product(back, e_acceleration))[1:] == pytest.approx(w_rate, abs=5e-15)
    assert 2 * np.array(quaternion_product(e_rate, back))[1:] == pytest.approx(in_space, abs=3e-15)
