"""The state of a coin as both engines name it."""

from typing import NamedTuple

from cointoss.models.attitude import Quaternion, rotation_matrix
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector


class State(NamedTuple):
    """A state of a coin, with its rotation matrix."""

    position: Vector
    """The position of C, space frame [m]."""
    velocity: Vector
    """The velocity of C, space frame [m/s]."""
    attitude: Quaternion
    """Euler parameters, body to space."""
    spin: Vector
    """ω, body frame [rad/s]."""
    R: Matrix
    """Rotation matrix, body to space; its last row is the upward unit vector in the body frame."""


@compiled
def state(position: Vector, velocity: Vector, attitude: Quaternion, spin: Vector) -> State:
    """Return the `State` with these parts; for their meaning see there."""
    return State(position, velocity, attitude, spin, rotation_matrix(attitude))
