"""Rotation in Euler parameters: how they change with the angular velocity."""

from models.compiled import compiled


@compiled
def quaternion_rate(e, w):
    """Give ė = ½ e ∘ ω, the inverse of eq. (17) of Strzalko et al. 2008 on the unit sphere.

    Args:
        e: Euler parameters, body to space, (4,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return (
        (-e[1] * w[0] - e[2] * w[1] - e[3] * w[2]) / 2,
        (e[0] * w[0] + e[2] * w[2] - e[3] * w[1]) / 2,
        (e[0] * w[1] + e[3] * w[0] - e[1] * w[2]) / 2,
        (e[0] * w[2] + e[1] * w[1] - e[2] * w[0]) / 2,
    )


@compiled
def rotation_change(e, de):
    """Give the change of the rotation matrix R(e), as `models.attitude` writes it, with e.

    Args:
        e: Euler parameters, body to space, (4,).
        de: their change, (4,).

    Returns:
        dR: a tuple of three rows.
    """
    e0, e1, e2, e3 = e[0], e[1], e[2], e[3]
    d0, d1, d2, d3 = de[0], de[1], de[2], de[3]
    return (
        (
            -4 * (e2 * d2 + e3 * d3),
            2 * (e1 * d2 + d1 * e2 - e0 * d3 - d0 * e3),
            2 * (e0 * d2 + d0 * e2 + e1 * d3 + d1 * e3),
        ),
        (
            2 * (e1 * d2 + d1 * e2 + e0 * d3 + d0 * e3),
            -4 * (e1 * d1 + e3 * d3),
            2 * (e2 * d3 + d2 * e3 - e0 * d1 - d0 * e1),
        ),
        (
            2 * (e1 * d3 + d1 * e3 - e0 * d2 - d0 * e2),
            2 * (e0 * d1 + d0 * e1 + e2 * d3 + d2 * e3),
            -4 * (e1 * d1 + e2 * d2),
        ),
    )
