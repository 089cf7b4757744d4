"""Rotation in Euler parameters: from the rotation matrix, and by angular velocity."""

from cointoss.models.attitude import Quaternion, norm_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector

Four = tuple[float, float, float, float]


@compiled
def attitude_products(R: Matrix) -> tuple[Four, tuple[Four, Four, Four, Four]]:
    """Return 4 e_i² and all 4 e_i e_j of a rotation matrix, the inverse of eq. (15)."""
    total, difference = R[1][1] + R[2][2], R[1][1] - R[2][2]
    squares = (
        (1 + R[0][0]) + total,
        (1 + R[0][0]) - total,
        (1 - R[0][0]) + difference,
        (1 - R[0][0]) - difference,
    )
    a, b, c = R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]
    p, q, s = R[1][0] + R[0][1], R[0][2] + R[2][0], R[2][1] + R[1][2]
    return squares, (
        (squares[0], a, b, c),
        (a, squares[1], p, q),
        (b, p, squares[2], s),
        (c, q, s, squares[3]),
    )


@compiled
def attitude_near(R: Matrix, e: Quaternion) -> Quaternion:
    """Return the Euler parameters of a rotation matrix that continue others, (4,), of norm 1.

    Of e' e'ᵀ, which R determines, e picks e' (e' · e): the turn between them must be less than half a turn.

    Args:
        R: rotation matrix, body to space, rows, (3, 3).
        e: Euler parameters not far away, (4,).
    """
    _, products = attitude_products(R)
    a, b = _dot_4(products[0], e), _dot_4(products[1], e)
    c, d = _dot_4(products[2], e), _dot_4(products[3], e)
    length = norm_of((a, b, c, d))
    return a / length, b / length, c / length, d / length


@compiled
def _dot_4(a: Four, b: Four) -> float:
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])


@compiled
def turn_of(e: Quaternion, change: Quaternion) -> Vector:
    """Return the small turn that a change of the Euler parameters is, 2 e* ∘ de, body frame, (3,) [rad]."""
    a, b, c, d = change
    return (
        2 * ((e[0] * b - e[1] * a) - (e[2] * d - e[3] * c)),
        2 * ((e[0] * c - e[2] * a) + (e[1] * d - e[3] * b)),
        2 * ((e[0] * d - e[3] * a) + (e[2] * b - e[1] * c)),
    )


@compiled
def quaternion_rate(e: Quaternion, w: Vector) -> Quaternion:
    """Return ė = ½ e ∘ ω, the inverse of eq. (17) of Strzalko et al. 2008 on the unit sphere.

    Args:
        e: Euler parameters, body to space, (4,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return (
        (-e[1] * w[0] - e[2] * w[1] - e[3] * w[2]) / 2,
        (e[0] * w[0] - e[3] * w[1] + e[2] * w[2]) / 2,
        (e[3] * w[0] + e[0] * w[1] - e[1] * w[2]) / 2,
        (-e[2] * w[0] + e[1] * w[1] + e[0] * w[2]) / 2,
    )
