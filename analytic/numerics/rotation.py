"""Rotation in Euler parameters: axis and angle, the rotation matrix, and angular velocity."""

import math

from cointoss.analytic.numerics.fours import Four
from cointoss.models.attitude import Quaternion, norm_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector


def quaternion_from_axis(axis: Vector, angle: float) -> Quaternion:
    """Return the Euler parameters of a turn about an axis; Strzalko et al. 2008, eqs (11)-(12).

    Args:
        axis: v, the axis, of any length but 0; its components are the same in body and space frame, (3,).
        angle: φ [rad].

    Returns:
        e: Euler parameters, scalar first, body to space, norm 1.

    Raises:
        ValueError: if the axis has no direction.
    """
    length = math.hypot(*axis)
    if not 0 < length < math.inf:
        raise ValueError(f"axis: given {tuple(axis)}; accepted is a finite vector other than zero")
    part = math.sin(angle / 2) / length
    return math.cos(angle / 2), part * axis[0], part * axis[1], part * axis[2]


def axis_and_angle(e: Quaternion) -> tuple[Vector, float]:
    """Return the axis and the angle of a turn, the inverse of eqs (11)-(12).

    e and -e are the same attitude, reached by φ about v and by 2π - φ about -v; each gives its own pair, so
    that `quaternion_from_axis` gives back this e.

    Args:
        e: Euler parameters, (4,), norm 1.

    Returns:
        axis: v, of length 1, (3,).
        angle: φ, between 0 and 2π [rad].

    Raises:
        ValueError: if e turns nothing, e = (±1, 0, 0, 0), where every axis would do.
    """
    length = math.hypot(e[1], e[2], e[3])
    if length == 0:
        raise ValueError(f"e: given {tuple(e)}, which turns nothing and so has no axis")
    return (e[1] / length, e[2] / length, e[3] / length), 2 * math.atan2(length, e[0])


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


def quaternion_from_matrix(R: Matrix) -> Quaternion:
    """Return the Euler parameters of a rotation matrix, the inverse of eq. (15).

    R determines all products e_i e_j. The largest square is found first and the others divided by its root,
    so no digit is lost at any attitude, half turns included.

    Args:
        R: rotation matrix, body to space, rows, (3, 3).

    Returns:
        e: Euler parameters, norm 1; of e and -e the one whose largest component is positive.
    """
    squares, products = attitude_products(R)
    row = products[squares.index(max(squares))]
    length = math.hypot(*row)
    return row[0] / length, row[1] / length, row[2] / length, row[3] / length


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


@compiled
def body_spin(e: Quaternion, e_rate: Quaternion) -> Vector:
    """Return the angular velocity in the body frame, eq. (17): the vector part of 2 ē ∘ ė [rad/s].

    Args:
        e: Euler parameters, body to space, (4,), norm 1.
        e_rate: ė, (4,) [1/s].
    """
    return (
        2 * (e[0] * e_rate[1] - e[1] * e_rate[0] - e[2] * e_rate[3] + e[3] * e_rate[2]),
        2 * (e[0] * e_rate[2] - e[2] * e_rate[0] - e[3] * e_rate[1] + e[1] * e_rate[3]),
        2 * (e[0] * e_rate[3] - e[3] * e_rate[0] - e[1] * e_rate[2] + e[2] * e_rate[1]),
    )


@compiled
def space_spin(e: Quaternion, e_rate: Quaternion) -> Vector:
    """Return the angular velocity in the space frame, eq. (19): the vector part of 2 ė ∘ ē [rad/s].

    Args:
        e: Euler parameters, body to space, (4,), norm 1.
        e_rate: ė, (4,) [1/s].
    """
    return (
        2 * (e[0] * e_rate[1] - e[1] * e_rate[0] + e[2] * e_rate[3] - e[3] * e_rate[2]),
        2 * (e[0] * e_rate[2] - e[2] * e_rate[0] + e[3] * e_rate[1] - e[1] * e_rate[3]),
        2 * (e[0] * e_rate[3] - e[3] * e_rate[0] + e[1] * e_rate[2] - e[2] * e_rate[1]),
    )


@compiled
def body_spin_rate(e: Quaternion, e_acceleration: Quaternion) -> Vector:
    """Return the angular acceleration ω̇ in the body frame, eq. (18): the vector part of 2 ē ∘ ë [rad/s²].

    It is the derivative of eq. (17), in which the products ė ė cancel.

    Args:
        e: Euler parameters, body to space, (4,), norm 1.
        e_acceleration: ë, (4,) [1/s²].
    """
    return body_spin(e, e_acceleration)
