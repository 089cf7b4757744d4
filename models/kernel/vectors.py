"""Three-vectors and 3 by 3 matrices as tuples, so that compiled code holds them in registers.

A vector is (x, y, z); a matrix is a tuple of three rows.
"""

import math

from cointoss.models.kernel.compiled import compiled

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]


@compiled
def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@compiled
def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@compiled
def scale(k: float, a: Vector) -> Vector:
    """Return k a for a number k."""
    return k * a[0], k * a[1], k * a[2]


@compiled
def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def norm(a: Vector) -> float:
    """Return the length |a|."""
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@compiled
def apply(M: Matrix, a: Vector) -> Vector:
    """Return M a."""
    return dot(M[0], a), dot(M[1], a), dot(M[2], a)


@compiled
def apply_transposed(M: Matrix, a: Vector) -> Vector:
    """Return M^T a."""
    return (
        M[0][0] * a[0] + M[1][0] * a[1] + M[2][0] * a[2],
        M[0][1] * a[0] + M[1][1] * a[1] + M[2][1] * a[2],
        M[0][2] * a[0] + M[1][2] * a[1] + M[2][2] * a[2],
    )


@compiled
def multiply(A: Matrix, B: Matrix) -> Matrix:
    """Return A B."""
    return apply_transposed(B, A[0]), apply_transposed(B, A[1]), apply_transposed(B, A[2])


@compiled
def solve(M: Matrix, b: Vector) -> Vector:
    """Solve M x = b for a 3 by 3 matrix M, by Cramer's rule."""
    column_0 = (M[0][0], M[1][0], M[2][0])
    column_1 = (M[0][1], M[1][1], M[2][1])
    column_2 = (M[0][2], M[1][2], M[2][2])
    determinant = dot(column_0, cross(column_1, column_2))
    return (
        dot(b, cross(column_1, column_2)) / determinant,
        dot(column_0, cross(b, column_2)) / determinant,
        dot(column_0, cross(column_1, b)) / determinant,
    )
