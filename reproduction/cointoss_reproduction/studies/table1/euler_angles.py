"""Rotation by three angles: the twelve Euler sequences, and where each is singular.

A sequence is the order of the axes about which the body turns, each in its new position; ξ 1, η 2, ζ 3. The
classical Euler angles ψ, θ, φ are "313".
"""

import numpy as np
from numpy.typing import ArrayLike

from cointoss.study import Array


def axes_of(sequence: str) -> list[int]:
    """Return the positions of a sequence's three axes among ξ, η, ζ, from 0."""
    return [int(digit) - 1 for digit in sequence]


def axis_rotation(axis: int, angle: float) -> Array:
    """Return the matrix of a turn about one body axis; Strzalko et al. 2008, eqs (6)-(8).

    Args:
        axis: 0 for ξ, 1 for η, 2 for ζ.
        angle: φ_i [rad].

    Returns:
        R_axis: body to space, (3, 3).
    """
    c, s = np.cos(angle), np.sin(angle)
    R, turned = np.eye(3), [(axis + 1) % 3, (axis + 2) % 3]
    R[np.ix_(turned, turned)] = [[c, -s], [s, c]]
    return R


def rotation_of(sequence: str, angles: ArrayLike) -> Array:
    """Return R = R_1(φ_1) R_2(φ_2) R_3(φ_3), eq. (5); for 313 it is eq. (10).

    Args:
        sequence: the three axes.
        angles: φ_1, φ_2, φ_3, (3,) [rad].

    Returns:
        R: rotation matrix, body to space, (3, 3).
    """
    R_1, R_2, R_3 = map(axis_rotation, axes_of(sequence), np.asarray(angles, dtype=float))
    return R_1 @ R_2 @ R_3


def rate_matrix(sequence: str, angles: ArrayLike) -> Array:
    """Return B, with which the rates of the angles make the angular velocity: ω = B φ̇; section 3.2.

    A column is the axis of one turn, seen from the body: the turns that follow carry it along.

    Args:
        sequence: the three axes.
        angles: φ_1, φ_2, φ_3, (3,) [rad].

    Returns:
        B: angular velocity in the body frame for unit rates, (3, 3).
    """
    _, R_2, R_3 = map(axis_rotation, axes_of(sequence), np.asarray(angles, dtype=float))
    axis_1, axis_2, axis_3 = np.eye(3)[axes_of(sequence)]
    return np.column_stack([R_3.T @ R_2.T @ axis_1, R_3.T @ axis_2, axis_3])


def singularity(sequence: str) -> tuple[str, int, float]:
    """Return where the rates of the angles cannot be found from ω: a row of Table 1, found from B itself.

    det B is the triple product of the three axes. Turning all by R_3 leaves R_2ᵀ a_1, a_2, a_3, so that
    φ_1 and φ_3 drop out and det B = p cos φ_2 + q sin φ_2; its values at 0 and π/2 are p and q.

    Args:
        sequence: the three axes.

    Returns:
        With det B = sign · function(φ_2): the function, "sin" or "cos"; the sign; and the smallest φ_2 >= 0
        with det B = 0, which the others follow at multiples of π [rad].
    """
    p, q = (round(np.linalg.det(rate_matrix(sequence, [0, angle, 0]))) for angle in (0, np.pi / 2))
    return ("cos", p, np.pi / 2) if p else ("sin", q, 0.0)
