"""The attitude of a body: Euler parameters, the rotation matrix, and the classical angles.

Sums of four terms are taken as (0 1) + (2 3): a mirror or half a turn exchanges the terms of a pair, or the
pairs, so that the mirror image of a motion is rounded as the motion is.
"""

import math

from cointoss.models.kernel.arrays import Array, Table, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, norm, scale

Quaternion = tuple[float, float, float, float]
# Euler parameters whose norm is 1 within rounding stay as they are: made from angles, or brought to norm 1
# before, they would change in their last digit.
_NORM_ROUNDING = 1e-15
_NO_TURN = 1e-300  # divides a sine of 0


@compiled
def norm_of(e: Quaternion) -> float:
    """Return the norm of Euler parameters."""
    return math.sqrt((e[0] * e[0] + e[1] * e[1]) + (e[2] * e[2] + e[3] * e[3]))


@compiled
def normalized(e: Quaternion) -> Quaternion:
    """Return Euler parameters brought to norm 1."""
    size = norm_of(e)
    if abs(size - 1) <= _NORM_ROUNDING:
        return e
    return e[0] / size, e[1] / size, e[2] / size, e[3] / size


@compiled
def quaternion_from_angles(angles: Vector) -> Quaternion:
    """Return the Euler parameters of the classical Euler angles (z-x-z).

    R = R_ζ(ψ) R_ξ(θ) R_ζ(φ), Strzalko et al. 2008, eqs (9)-(10), with Euler parameters as in eq. (11).

    Args:
        angles: ψ, θ, φ [rad].

    Returns:
        e: Euler parameters, scalar first, body to space, norm 1.
    """
    psi, theta, phi = angles
    half_sum, half_difference = (psi + phi) / 2, (psi - phi) / 2
    cos_half, sin_half = math.cos(theta / 2), math.sin(theta / 2)
    return (
        cos_half * math.cos(half_sum),
        sin_half * math.cos(half_difference),
        sin_half * math.sin(half_difference),
        cos_half * math.sin(half_sum),
    )


@compiled
def quaternion_product(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the quaternion product a b: of Euler parameters the turn b and then a, R(a b) = R(a) R(b)."""
    return (
        (a[0] * b[0] - a[1] * b[1]) - (a[2] * b[2] + a[3] * b[3]),
        (a[0] * b[1] + a[1] * b[0]) + (a[2] * b[3] - a[3] * b[2]),
        (a[0] * b[2] - a[1] * b[3]) + (a[2] * b[0] + a[3] * b[1]),
        (a[0] * b[3] + a[1] * b[2]) - (a[2] * b[1] - a[3] * b[0]),
    )


@compiled
def turn_by(vector: Vector) -> Quaternion:
    """Return the Euler parameters of the turn about a vector by its length [rad]."""
    angle = norm(vector)
    return (math.cos(angle / 2), *scale(math.sin(angle / 2) / max(angle, _NO_TURN), vector))


@compiled
def turn_each(attitudes: Table, turns: Table) -> None:
    """Turn bodies.

    Args:
        attitudes: their Euler parameters, body to space, (n, 4); written to.
        turns: about which vector, body frame, and by its length, (n, 3) [rad].
    """
    for i in range(len(attitudes)):
        e, turn = attitudes[i], turns[i]
        turned = quaternion_product((e[0], e[1], e[2], e[3]), turn_by((turn[0], turn[1], turn[2])))
        copy_into(attitudes[i], turned)


@compiled
def rotation_matrix(e: Quaternion | Array) -> Matrix:
    """Return R(e), body to space: x_space = R x_body. Strzalko et al. 2008, eq. (15).

    The diagonal is homogeneous, e0² + e3² - e1² - e2² in place of 2 (e0² + e3²) - 1: off the unit sphere, as
    inside a step of Runge and Kutta, the other form turns every coin a little towards one face.

    Args:
        e: Euler parameters, (4,), norm 1; of another norm, R is |e|² times a rotation.

    Returns:
        R: a tuple of three rows.
    """
    e0, e1, e2, e3 = e[0], e[1], e[2], e[3]
    squares = (e0 * e0, e1 * e1, e2 * e2, e3 * e3)
    xi = (squares[0] + squares[1]) - (squares[2] + squares[3])
    eta = (squares[0] + squares[2]) - (squares[1] + squares[3])
    zeta = (squares[0] + squares[3]) - (squares[1] + squares[2])
    return (
        (xi, 2 * (e1 * e2 - e0 * e3), 2 * (e0 * e2 + e1 * e3)),
        (2 * (e1 * e2 + e0 * e3), eta, 2 * (e2 * e3 - e0 * e1)),
        (2 * (e1 * e3 - e0 * e2), 2 * (e0 * e1 + e2 * e3), zeta),
    )
