"""The coin's inertia, against brute integration of its mass and against limiting cases."""

import numpy as np
import pytest

from cointoss.models.inertia import (
    cylinder_inertia,
    inertia_about_mass_center,
    inverse,
    is_positive_definite,
    obeys_triangle_inequality,
    principal_moments,
)
from tests.helpers.tuples import matrix


def turned(moments, rng):
    """Return a symmetric matrix of given eigenvalues, in axes of its own."""
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    J = axes @ np.diag(moments) @ axes.T
    return (J + J.T) / 2


@pytest.mark.parametrize("spread", [0.0, 1e-12, 1.0, 1e3, 1e10])
def test_principal_moments_are_the_eigenvalues(spread):
    rng = np.random.default_rng(5)
    for _ in range(50):
        moments = np.sort(1 + spread * rng.uniform(size=3))
        J = turned(moments, rng)
        # Jacobi's rotations lose some roundings of the largest moment, as LAPACK does.
        assert principal_moments(matrix(J)) == pytest.approx(np.linalg.eigvalsh(J), abs=1e-14 * moments[-1])
    assert principal_moments(matrix(np.diag([3.0, 1.0, 2.0]))) == (1.0, 2.0, 3.0)


def test_the_inverse_is_one_and_of_a_diagonal_matrix_its_reciprocals():
    rng = np.random.default_rng(6)
    for _ in range(50):
        J = turned(rng.uniform(1, 5, 3), rng)
        assert np.array(inverse(matrix(J))) @ J == pytest.approx(np.eye(3), abs=1e-14)
    assert inverse(matrix(np.diag([3.0, 7.0, 2.0]))) == matrix(np.diag([1 / 3, 1 / 7, 0.5]))


def test_cylinder_is_the_integral_of_its_mass():
    """Means of x² and z² by Gauss's rule, which integrates these polynomials exactly."""
    mass, radius, thickness = 3.0, 0.7, 0.4
    nodes, weights = np.polynomial.legendre.leggauss(8)
    rho, z = radius * (nodes + 1) / 2, thickness * nodes / 2
    x_squared, z_squared = weights @ rho**3 / (weights @ rho) / 2, weights @ z**2 / weights.sum()
    J = mass * np.diag([x_squared + z_squared, x_squared + z_squared, 2 * x_squared])
    assert np.allclose(cylinder_inertia(mass, radius, thickness), J, rtol=0, atol=1e-14)


def test_offset_obeys_the_parallel_axis_theorem():
    J_B, c, mass = cylinder_inertia(2.0, 1.0, 0.3), np.array([0.2, -0.1, 0.05]), 2.0
    J_C = np.array(inertia_about_mass_center(J_B, mass, tuple(c)))
    skew = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
    assert np.allclose(J_C + mass * skew.T @ skew, J_B, rtol=0, atol=1e-15)


THIN = cylinder_inertia(2e-3, 1.25e-2, 0.0)


@pytest.mark.parametrize(
    ("J", "positive"),
    [
        (inertia_about_mass_center(THIN, 2e-3, (0.499 * 1.25e-2, 0.0, 0.0)), True),
        (inertia_about_mass_center(THIN, 2e-3, (0.501 * 1.25e-2, 0.0, 0.0)), False),
        (matrix(np.full((3, 3), np.inf)), False),
        (matrix(np.full((3, 3), np.nan)), False),
    ],
    ids=["within half the radius", "beyond", "infinite", "not a number"],
)
def test_inertia_is_positive_up_to_half_the_radius_and_where_it_is_finite(J, positive):
    assert is_positive_definite(J) is positive


def test_thin_coins_stand_on_the_triangle_equality():
    rng = np.random.default_rng(3)
    for _ in range(200):
        c = rng.uniform(-4e-3, 4e-3, 2)
        J = inertia_about_mass_center(THIN, 2e-3, (c[0], c[1], 0.0))
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        assert obeys_triangle_inequality(matrix(turn @ J @ turn.T))
    assert not obeys_triangle_inequality(matrix(np.diag([1.0, 1.0, 2.0 + 1e-6])))
