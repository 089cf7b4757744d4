"""Rotation by three angles: the twelve Euler sequences, and where each is singular."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

SINGULAR = 1e-8
"""Below this |det B| the first and the third angle cannot be distinguished: rounding of R, divided by |det
B|, is as large as they are."""

_AXES = np.eye(3)


class Sequence(Enum):
    """The order of the axes about which the body turns, each in its new position; ξ 1, η 2, ζ 3."""

    XI_ETA_XI = "121"
    XI_ETA_ZETA = "123"
    XI_ZETA_XI = "131"
    XI_ZETA_ETA = "132"
    ETA_XI_ETA = "212"
    ETA_XI_ZETA = "213"
    ETA_ZETA_XI = "231"
    ETA_ZETA_ETA = "232"
    ZETA_XI_ETA = "312"
    ZETA_XI_ZETA = "313"
    """The classical Euler angles ψ, θ, φ."""
    ZETA_ETA_XI = "321"
    ZETA_ETA_ZETA = "323"

    @property
    def axes(self) -> tuple[int, int, int]:
        """Positions of the three axes among ξ, η, ζ, from 0."""
        first, second, third = (int(digit) - 1 for digit in self.value)
        return first, second, third


@dataclass(frozen=True)
class Singularity:
    """Where the rates of a sequence's angles cannot be found from ω: one row of Table 1."""

    function: str
    """det B as a function of φ_2: "sin" or "cos"."""
    sign: int
    """+1 or -1: det B = sign · function(φ_2)."""
    angle: float
    """The smallest φ_2 >= 0 with det B = 0; the others follow at multiples of π [rad]."""


def axis_rotation(axis: int, angle: float) -> Array:
    """Return the matrix of a turn about one body axis; Strzalko et al. 2008, eqs (6)-(8).

    Args:
        axis: 0 for ξ, 1 for η, 2 for ζ.
        angle: φ_i [rad].

    Returns:
        R_axis: body to space, (3, 3).
    """
    c, s = np.cos(angle), np.sin(angle)
    if axis == 0:
        return np.array(
            [
                [1.0, 0, 0],
                [0, c, -s],
                [0, s, c],
            ]
        )
    if axis == 1:
        return np.array(
            [
                [c, 0, s],
                [0, 1.0, 0],
                [-s, 0, c],
            ]
        )
    return np.array(
        [
            [c, -s, 0],
            [s, c, 0],
            [0, 0, 1.0],
        ]
    )


def rotation_of(sequence: Sequence, angles: ArrayLike) -> Array:
    """Return R = R_1(φ_1) R_2(φ_2) R_3(φ_3), eq. (5); for 313 it is eq. (10).

    Args:
        sequence: the three axes.
        angles: φ_1, φ_2, φ_3, (3,) [rad].

    Returns:
        R: rotation matrix, body to space, (3, 3).
    """
    R_1, R_2, R_3 = map(axis_rotation, sequence.axes, np.asarray(angles, dtype=float))
    return R_1 @ R_2 @ R_3


def rate_matrix(sequence: Sequence, angles: ArrayLike) -> Array:
    """Return B, with which the rates of the angles make the angular velocity: ω = B φ̇; section 3.2.

    A column is the axis of one turn, seen from the body: the turns that follow carry it along.

    Args:
        sequence: the three axes.
        angles: φ_1, φ_2, φ_3, (3,) [rad].

    Returns:
        B: angular velocity in the body frame for unit rates, (3, 3).
    """
    _, R_2, R_3 = map(axis_rotation, sequence.axes, np.asarray(angles, dtype=float))
    axis_1, axis_2, axis_3 = (_AXES[axis] for axis in sequence.axes)
    return np.column_stack([R_3.T @ R_2.T @ axis_1, R_3.T @ axis_2, axis_3])


def singularity(sequence: Sequence) -> Singularity:
    """Return where B loses its rank, found from B itself; Table 1.

    det B is the triple product of the three axes. Turning all by R_3 leaves R_2ᵀ a_1, a_2, a_3, so that
    φ_1 and φ_3 drop out and det B = p cos φ_2 + q sin φ_2; its values at 0 and π/2 are p and q.
    """
    p, q = (round(np.linalg.det(rate_matrix(sequence, [0, angle, 0]))) for angle in (0, np.pi / 2))
    if p:
        return Singularity("cos", p, np.pi / 2)
    return Singularity("sin", q, 0.0)


def angles_of(sequence: Sequence, R: ArrayLike) -> Array:
    """Return the angles of a rotation matrix, the inverse of `rotation_of`.

    Args:
        sequence: the three axes.
        R: rotation matrix, body to space, (3, 3).

    Returns:
        φ_1, φ_2, φ_3, (3,) [rad]; φ_1 and φ_3 from -π to π, φ_2 from 0 to π where the first axis comes twice
        and from -π/2 to π/2 where all three differ.

    Raises:
        ValueError: if R is within `SINGULAR` of the sequence's singularity, where only the sum or the
            difference of φ_1 and φ_3 has a meaning.
    """
    R = np.asarray(R, dtype=float)
    i, j, k = sequence.axes
    rest = 3 - i - j
    hand = np.dot(np.cross(_AXES[i], _AXES[j]), _AXES[rest])
    # The third axis in space, without φ_3: how far it is turned about the first axis is φ_1.
    third = R[:, k]
    if np.hypot(third[j], third[rest]) < SINGULAR:
        where = singularity(sequence)
        raise ValueError(
            f"R: the sequence {sequence.value} is singular at this attitude, {where.function} φ_2 = 0; "
            "give another sequence, or use Euler parameters"
        )
    sine, cosine = (third[j], -hand * third[rest]) if i == k else (-hand * third[j], third[rest])
    phi_1 = np.arctan2(sine, cosine)
    # What is left is R_2 R_3; φ_3 from it, not from R, takes up the rounding of φ_1 near a singularity.
    left = axis_rotation(i, phi_1).T @ R
    across = 3 - j - k
    turn = np.dot(np.cross(_AXES[k], _AXES[j]), _AXES[across])
    phi_3 = np.arctan2(-turn * left[j, across], left[j, j])
    left = left @ axis_rotation(k, phi_3).T
    return np.array([phi_1, np.arctan2(hand * left[i, rest], left[i, i]), phi_3])
