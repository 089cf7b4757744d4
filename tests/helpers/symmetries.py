"""Releases that a symmetry of the floor or of the coin makes of a release, and what it makes of a vector."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

TURN = 0.7
"""About the vertical [rad]."""


class Symmetry(NamedTuple):
    """What becomes of a motion; all vectors of a release are given in full."""

    space: np.ndarray
    """The orthogonal map of space, (3, 3)."""
    body: np.ndarray
    """The orthogonal map of the body's axes, (3, 3)."""
    shift: np.ndarray
    """Of positions, (3,) [m]."""
    swaps_faces: bool = False
    negative: bool = False
    """Whether the Euler parameters are the others of the same attitude."""
    balanced: bool = False
    """Whether it is one only of a coin whose centre of mass is its centre."""

    def vector(self, values: ArrayLike) -> np.ndarray:
        """Return what becomes of vectors in space, (..., 3)."""
        return np.asarray(values) @ self.space.T

    def release(self, release: dict[str, Any]) -> dict[str, Any]:
        """Return what becomes of a release."""
        # An axial vector keeps its sign where a map has determinant -1 and turns over elsewhere.
        handed = np.linalg.det(self.space) * self.space
        inner = np.linalg.det(self.body) * self.body
        attitude = Rotation.from_quat(release["quaternion"], scalar_first=True)
        turned = Rotation.from_matrix(handed) * attitude * Rotation.from_matrix(inner.T)
        e = turned.as_quat(scalar_first=True)
        return {
            "position": (self.vector(release["position"]) + self.shift).tolist(),
            "velocity": self.vector(release["velocity"]).tolist(),
            "quaternion": (-e if self.negative else e).tolist(),
            "angular_velocity": (inner @ release["angular_velocity"]).tolist(),
        }


ONE, NONE = np.eye(3), np.zeros(3)
ABOUT_Z = np.array([[np.cos(TURN), -np.sin(TURN), 0], [np.sin(TURN), np.cos(TURN), 0], [0, 0, 1]])
MIRROR = np.diag([1.0, -1.0, 1.0])
HALF_TURN = np.diag([1.0, -1.0, -1.0])
SYMMETRIES = {
    "a shift along the floor": Symmetry(ONE, ONE, np.array([1.0, -2.0, 0.0])),
    "a turn about the vertical": Symmetry(ABOUT_Z, ONE, NONE),
    "a mirror": Symmetry(MIRROR, MIRROR, NONE, balanced=True),
    "half a turn of the coin about ξ": Symmetry(ONE, HALF_TURN, NONE, swaps_faces=True, balanced=True),
    "the other Euler parameters of the attitude": Symmetry(ONE, ONE, NONE, negative=True),
}
