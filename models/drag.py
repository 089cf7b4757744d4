"""Linear air drag (b = 0) on a cylinder in closed form: four coefficients at the geometric centre B."""

import math
from typing import NamedTuple

from cointoss.models.kernel.compiled import compiled

_SHARE_ERROR = 1e-9


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


@compiled
def linear_drag(radius: float, thickness: float, normal: float, tangential: float) -> Drag:
    """Integrate the air's force over both faces and the wall of a cylinder for b = 0.

    Strzalko et al. 2008, eqs (49)-(74). Pressure acts only where the surface moves outwards, eq. (58).
    Where one face has none its twin has all, so both together make one whole disc; on the wall the mean
    of cos² over the half that moves outwards is half of that over the whole. So force and moment are
    exactly linear, without cross terms, for every motion. `sliding_share` and `clearance.drag_bound` rest on
    these coefficients.

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
    # Powers of 3.0 and 4.0 are rounded once; those of integers would be multiplied out.
    return Drag(
        force_tangential=2 * pi * r**2 * lt + pi * r * h * lt + pi / 2 * r * h * ln,
        force_normal=pi * r**2 * ln + 2 * pi * r * h * lt,
        moment_tangential=(
            pi / 4 * r**4.0 * ln
            + pi / 2 * r**2 * h**2 * lt
            + pi / 24 * r * h**3.0 * ln
            + (pi * r**3.0 * h + pi / 12 * r * h**3.0) * lt
        ),
        moment_normal=(pi * r**4.0 + 2 * pi * r**3.0 * h) * lt,
    )


@compiled
def sliding_share(drag: Drag, offset: float) -> float:
    """Return the part a of its horizontal energy that air can still turn into height on a smooth floor.

    E - (1 - a) m v_h²/2 never grows: v_B, ω and the air's force and moment at B turn its rate of change into
    -(v_B · W D v_B + ω · d ω) + (1 - a) (ω × c)_h · D v_B, with D = diag(c_t, c_t, c_n) about the normal and
    W = diag(a, a, 1) about the vertical. It is never positive if 4 μ d >= ((1 - a) |c| c_max)², d the smaller
    moment coefficient and μ the least eigenvalue of the symmetric part of W D at any tilt; docs/ENDINGS.md
    derives it. For the balanced coin a = ((√κ - 1)/(√κ + 1))², κ = c_n/c_t.

    Args:
        drag: coefficients at B.
        offset: |c|, of C from B [m].

    Returns:
        The least such a, from above, within 1e-9; 1 without air.
    """
    largest = max(drag.force_normal, drag.force_tangential)
    least_moment = min(drag.moment_normal, drag.moment_tangential)
    low, high = 0.0, 1.0
    while high - low > _SHARE_ERROR:
        a = (low + high) / 2
        needed = ((1 - a) * offset * largest) ** 2
        mu = _least_eigenvalue(drag, a)
        if largest > 0 and mu >= 0 and 4 * mu * least_moment >= needed:
            high = a
        else:
            low = a
    return high


@compiled
def _least_eigenvalue(drag: Drag, a: float) -> float:
    """Return μ of `sliding_share`: with the sine of the tilt squared as x, it is convex in x."""
    across, apart = drag.force_tangential, drag.force_normal - drag.force_tangential
    # In the plane of normal and vertical: the trace is T - (1 - a) apart x, the discriminant A² + B x.
    trace, A = (1 + a) * across + apart, -(1 - a) * across - apart
    B = -(1 - a * a) * apart * (2 * across + apart)
    x = min(max((((1 + a) * (across + apart / 2)) ** 2 - A * A) / B, 0.0), 1.0) if B != 0 else 0.0
    least = a * across
    for tilt in (0.0, x, 1.0):
        root = math.sqrt(max(A * A + B * tilt, 0.0))
        least = min(least, (trace - (1 - a) * apart * tilt - root) / 2)
    return least
