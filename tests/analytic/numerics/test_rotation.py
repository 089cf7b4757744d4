"""Euler parameters: axis and angle, matrix and angular velocity, there and back, against SciPy."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from cointoss.analytic.numerics.rotation import (
    axis_and_angle,
    body_spin,
    body_spin_rate,
    quaternion_from_axis,
    quaternion_from_matrix,
    quaternion_rate,
    space_spin,
)
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import draw_quaternion
from tests.helpers.tuples import quaternion, vector

part = st.floats(-1, 1)
axes = st.tuples(part, part, part).filter(lambda v: np.linalg.norm(v) > 0.1)


@given(axes, st.floats(1e-6, 2 * np.pi - 1e-6))
def test_axis_and_angle_there_and_back(axis, angle):
    e = quaternion_from_axis(axis, angle)
    unit = np.array(axis) / np.linalg.norm(axis)
    assert np.abs(np.array(rotation_matrix(e)) - Rotation.from_rotvec(angle * unit).as_matrix()).max() < 2e-15
    axis_back, angle_back = axis_and_angle(e)
    assert angle_back == pytest.approx(angle, abs=2e-15)
    assert np.abs(axis_back - unit).max() < 1e-15
    assert quaternion_from_axis(axis_back, angle_back) == pytest.approx(e, abs=1e-15)


def test_without_a_turn_there_is_no_axis():
    for e in [(1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 0.0)]:
        with pytest.raises(ValueError, match="turns nothing"):
            axis_and_angle(e)
    for axis in [(0.0, 0.0, 0.0), (np.inf, 0.0, 0.0)]:
        with pytest.raises(ValueError, match="finite vector other than zero"):
            quaternion_from_axis(axis, 1.0)


@given(axes, st.sampled_from([0.0, np.pi, np.pi / 2]), st.sampled_from([0, 1e-15, 1e-12, 1e-8, 1e-4, 0.1]))
@example((1.0, 0.0, 0.0), np.pi, 0)
@example((0.0, 1.0, 0.0), np.pi, 0)
@example((0.0, 0.0, 1.0), np.pi, 0)
@example((0.0, 1.0, -1.0), np.pi, 0)
def test_matrix_there_and_back_near_every_half_turn(axis, angle, off):
    e = np.array(quaternion_from_axis(axis, angle + off))
    back = np.array(quaternion_from_matrix(rotation_matrix(tuple(e))))
    assert np.max(back) == np.max(np.abs(back)), "of the two signs the one with its largest part positive"
    assert np.abs(back * np.sign(back @ e) - e).max() < 1e-15


def turning(rng):
    """Give an attitude, its rate, its acceleration, and the angular velocity and acceleration in the body."""
    e, w, w_rate = quaternion(draw_quaternion(rng)), vector(rng.normal(size=3)), vector(rng.normal(size=3))
    e_rate = quaternion_rate(e, w)
    e_acceleration = quaternion(np.add(quaternion_rate(e_rate, w), quaternion_rate(e, w_rate)))
    return e, e_rate, e_acceleration, np.array(w), np.array(w_rate)


@pytest.mark.parametrize("seed", range(20))
def test_angular_velocity_and_acceleration_are_the_inverse_of_the_rates(seed):
    e, e_rate, e_acceleration, w, w_rate = turning(np.random.default_rng(seed))
    assert body_spin(e, e_rate) == pytest.approx(w, abs=2e-15)
    assert space_spin(e, e_rate) == pytest.approx(np.array(rotation_matrix(e)) @ w, abs=3e-15)
    assert body_spin_rate(e, e_acceleration) == pytest.approx(w_rate, abs=5e-15)


@pytest.mark.parametrize("seed", range(5))
def test_rates_turn_the_body_as_scipy_does(seed):
    e, e_rate, _, w, _ = turning(np.random.default_rng(seed))
    turned = {}
    for dt in (1e-5, -1e-5):
        after = (Rotation.from_quat(e, scalar_first=True) * Rotation.from_rotvec(dt * w)).as_quat(
            scalar_first=True
        )
        turned[dt] = after * np.sign(after @ e)
    # A central difference: its error is dt²|w|³/48, its rounding 1e-16/dt.
    assert (turned[1e-5] - turned[-1e-5]) / 2e-5 == pytest.approx(e_rate, abs=1e-10)
