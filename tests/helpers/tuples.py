"""Vectors, matrices and quaternions as compiled functions take them."""

from collections.abc import Iterable

from cointoss.models.attitude import Quaternion
from cointoss.models.kernel.vectors import Matrix, Vector


def vector(numbers: Iterable[float]) -> Vector:
    """Return three numbers as a vector."""
    x, y, z = map(float, numbers)
    return x, y, z


def matrix(rows: Iterable[Iterable[float]]) -> Matrix:
    """Return three rows as a matrix."""
    first, second, third = map(vector, rows)
    return first, second, third


def quaternion(numbers: Iterable[float]) -> Quaternion:
    """Return four numbers as a quaternion."""
    e0, e1, e2, e3 = map(float, numbers)
    return e0, e1, e2, e3
