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
