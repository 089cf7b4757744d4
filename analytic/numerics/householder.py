"""Householder's reflections: as many vectors as dimensions with the covariance of more."""

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled


@compiled
def reflect_to_triangle(rows: Array) -> None:
    """Turn the rows A, (m, n) with m >= n, into an upper triangle R in the first n, with RᵀR = AᵀA.

    The others become zero. A column of zeros stays one exactly.
    """
    m, n = rows.shape
    for j in range(n):
        square = 0.0
        for i in range(j, m):
            square += rows[i, j] * rows[i, j]
        if square == 0:
            continue
        size = square**0.5
        end = -size if rows[j, j] > 0 else size
        rows[j, j] -= end
        part = -1 / (end * rows[j, j])
        for k in range(j + 1, n):
            along = 0.0
            for i in range(j, m):
                along += rows[i, j] * rows[i, k]
            along *= part
            for i in range(j, m):
                rows[i, k] -= along * rows[i, j]
        rows[j, j] = end
        for i in range(j + 1, m):
            rows[i, j] = 0.0
