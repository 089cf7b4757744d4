"""The inertia of a coin about its geometric centre B and its mass centre C."""

import math

from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, dot

# A thin coin's principal moments obey A + B = C exactly, so rounding alone can break the inequality.
TRIANGLE_TOLERANCE = 1e-12
_SWEEPS = 20
"""The most of Jacobi's rotations, which converge quadratically: after four to six none is left to do."""


@compiled
def cylinder_inertia(mass: float, radius: float, thickness: float) -> Matrix:
    """Return J_B, the inertia of a uniform cylinder about its centre, body frame [kg m²].

    J_ξ = J_η = m r²/4 + m h²/12 and J_ζ = m r²/2; Strzalko et al. 2008, before eq. (34).

    Args:
        mass: m [kg].
        radius: r [m].
        thickness: h [m].
    """
    across = mass * (radius * radius / 4 + thickness * thickness / 12)
    return (
        (across, 0.0, 0.0),
        (0.0, across, 0.0),
        (0.0, 0.0, mass * (radius * radius) / 2),
    )


@compiled
def inertia_about_mass_center(J_B: Matrix, mass: float, center: Vector) -> Matrix:
    """Return the inertia moved from B to C: J_C = J_B - m (|c|² I - c cᵀ), body frame [kg m²].

    The paper leaves the inertia of its imperfect coin unsaid. Here J_B stays the uniform cylinder's,
    whatever the offset c, and the parallel-axis theorem gives J_C.

    Args:
        J_B: inertia about B, body frame [kg m²].
        mass: m [kg].
        center: c, the vector from B to C, body frame, (3,) [m].

    Returns:
        J_C, not positive definite when c is too long.
    """
    first, second, third = J_B
    (x, y, z), square = center, dot(center, center)
    m = mass
    return (
        (first[0] - m * (square - x * x), first[1] + m * (x * y), first[2] + m * (x * z)),
        (second[0] + m * (y * x), second[1] - m * (square - y * y), second[2] + m * (y * z)),
        (third[0] + m * (z * x), third[1] + m * (z * y), third[2] - m * (square - z * z)),
    )


@compiled
def largest_across(J: Matrix) -> float:
    """Return the largest moment of inertia about an axis in the coin's plane [kg m²]."""
    mean, half = (J[0][0] + J[1][1]) / 2, (J[0][0] - J[1][1]) / 2
    return mean + math.hypot(half, J[0][1])


@compiled
def inverse(J: Matrix) -> Matrix:
    """Return the inverse of a positive definite matrix, by Gaussian elimination, which needs no pivots there.

    With reciprocals in LAPACK's order, so that most inverses are numpy's to the bit.
    """
    (a, b, c), (d, e, f), (g, h, i) = J
    by_a = 1 / a
    down, low = d * by_a, g * by_a
    e, f = e - down * b, f - down * c
    h, i = h - low * b, i - low * c
    by_e = 1 / e
    step = h * by_e
    by_i = 1 / (i - step * f)
    # The right sides, the columns of I, after the same steps.
    first = _back((by_a, b, c), (by_e, f), by_i, (1.0, 0.0 - down, step * down - low))
    second = _back((by_a, b, c), (by_e, f), by_i, (0.0, 1.0, 0.0 - step))
    third = _back((by_a, b, c), (by_e, f), by_i, (0.0, 0.0, 1.0))
    return (
        (first[0], second[0], third[0]),
        (first[1], second[1], third[1]),
        (first[2], second[2], third[2]),
    )


@compiled
def _back(top: Vector, middle: tuple[float, float], last: float, side: Vector) -> Vector:
    """Solve an upper triangular system of given rows, each with the reciprocal of its pivot."""
    z = side[2] * last
    y = (side[1] - middle[1] * z) * middle[0]
    return (side[0] - top[2] * z - top[1] * y) * top[0], y, z


@compiled
def principal_moments(J: Matrix) -> Vector:
    """Return the eigenvalues of a symmetric matrix, the smallest first, by Jacobi's rotations.

    Each is exact within some roundings of the largest; those of a diagonal matrix are its entries.
    """
    (a, d, e), (_, b, f), (_, _, c) = J
    for _ in range(_SWEEPS):
        if d == 0 and e == 0 and f == 0:
            break
        a, b, d, e, f = _rotated(a, b, d, e, f)
        a, c, e, d, f = _rotated(a, c, e, d, f)
        b, c, f, d, e = _rotated(b, c, f, d, e)
    low, high = min(a, b, c), max(a, b, c)
    return low, max(min(a, b), min(max(a, b), c)), high


@compiled
def _rotated(
    p: float, q: float, apart: float, to_p: float, to_q: float
) -> tuple[float, float, float, float, float]:
    """Return a symmetric matrix turned in the plane of two of its axes, so that their product is 0.

    Args:
        p: diagonal entry of the first axis.
        q: of the second.
        apart: their product of inertia, which is turned away.
        to_p: product of the first with the third axis.
        to_q: of the second.
    """
    small = 1e-2 * min(abs(p), abs(q)) * 2.0**-52
    if abs(apart) <= small:
        return p, q, 0.0, to_p, to_q
    theta = (q - p) / (2 * apart)
    t = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1))
    c = 1 / math.sqrt(t * t + 1)
    s = t * c
    return p - t * apart, q + t * apart, 0.0, c * to_p - s * to_q, s * to_p + c * to_q


@compiled
def is_positive_definite(J: Matrix) -> bool:
    """Return whether every principal moment of J is positive beyond rounding."""
    for row in J:
        for entry in row:
            if not abs(entry) < math.inf:
                return False
    low, _, high = principal_moments(J)
    return low > 1e-14 * abs(high)


@compiled
def obeys_triangle_inequality(J: Matrix) -> bool:
    """Return whether no principal moment exceeds the sum of the other two, as for every real body."""
    low, middle, high = principal_moments(J)
    return high <= low + middle + TRIANGLE_TOLERANCE * (low + middle + high)
