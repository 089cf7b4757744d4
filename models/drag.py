"""Linear air drag (b = 0) on a cylinder in closed form: four coefficients at the geometric centre B."""

import math
from typing import NamedTuple


class Drag(NamedTuple):
    """Coefficients of force and moment at B, diagonal in the body frame.

    f_B = -diag(c_t, c_t, c_n) v_B and m_B = -diag(d_t, d_t, d_n) ω.
    """

    force_tangential: float
    """c_t: along the faces [kg/s]."""
    force_normal: float
    """c_n: along the normal ζ [kg/s]."""
    moment_tangential: float
    """d_t: about the diameters ξ and η [kg m²/s]."""
    moment_normal: float
    """d_n: about the normal ζ [kg m²/s]."""


def linear_drag(radius: float, thickness: float, normal: float, tangential: float) -> Drag:
    """Integrate the air's force over both faces and the wall of a cylinder for b = 0.

    Strzalko et al. 2008, eqs (49)-(74). Pressure acts only where the surface moves outwards, eq. (58).
    Where one face has none its twin has all, so both together make one whole disc; on the wall the mean
    of cos² over the half that moves outwards is half of that over the whole. So force and moment are
    exactly linear, without cross terms, for every motion.

    Args:
        radius: r [m].
        thickness: h [m].
        normal: λ_n [kg m⁻² s⁻¹].
        tangential: λ_τ [kg m⁻² s⁻¹].

    Returns:
        The four coefficients at B.
    """
    r, h, ln, lt = radius, thickness, normal, tangential
    pi = math.pi
    return Drag(
        force_tangential=2 * pi * r**2 * lt + pi * r * h * lt + pi / 2 * r * h * ln,
        force_normal=pi * r**2 * ln + 2 * pi * r * h * lt,
        moment_tangential=(
            pi / 4 * r**4 * ln
            + pi / 2 * r**2 * h**2 * lt
            + pi / 24 * r * h**3 * ln
            + (pi * r**3 * h + pi / 12 * r * h**3) * lt
        ),
        moment_normal=(pi * r**4 + 2 * pi * r**3 * h) * lt,
    )
