"""The air's friction on the two faces of a coin, for 0 < b <= 1."""

import math

from cointoss.analytic.air.law import AirMotion, power
from cointoss.analytic.air.quadrature import Nodes
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector

FAR = 1.5
"""The instantaneous centre is far enough for the series beyond this number of radii."""


@compiled
def face_friction_change(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Return how the friction on both faces, at B, changes with the motion, from eqs (51) and (73).

    Arguments and returns as those of `air.force.change_about_B`.
    """
    b, v, w, dv, dw = motion
    r, half = body.radius, body.thickness / 2
    f_0, f_1, m_0, m_1, m_2 = 0.0, 0.0, 0.0, 0.0, 0.0
    for side in (half, -half):
        U_0, U_1 = v[0] + side * w[1], v[1] - side * w[0]
        dU_0, dU_1 = dv[0] + side * dw[1], dv[1] - side * dw[0]
        U = math.hypot(U_0, U_1)
        e_0, e_1 = (U_0 / U, U_1 / U) if U > 0 else (1.0, 0.0)
        D_UU, D_across, D_Uw, D_ww = disc_dissipation(b, r, U, abs(w[2]), nodes)
        if w[2] < 0:
            D_Uw = -D_Uw
        along, across = dU_0 * e_0 + dU_1 * e_1, dU_1 * e_0 - dU_0 * e_1
        K_along, K_across = D_UU * along + D_Uw * dw[2], D_across * across
        K_0, K_1 = K_along * e_0 - K_across * e_1, K_along * e_1 + K_across * e_0
        f_0 += K_0
        f_1 += K_1
        m_0 -= side * K_1
        m_1 += side * K_0
        m_2 += D_Uw * along + D_ww * dw[2]
    k = -body.air.tangential
    return (k * f_0, k * f_1, 0.0), (k * m_0, k * m_1, k * m_2)


@compiled
def disc_dissipation(
    b: float, r: float, U: float, w: float, nodes: Nodes
) -> tuple[float, float, float, float]:
    """Return the second derivatives of D(U, ω) = ∫ |V|^(b+2)/(b+2) dA over a disc that slides and spins.

    V = U + ω ζ × p. The gradient of D is force and moment for λ_τ = 1, so its second derivatives are their
    changes. They are homogeneous of degree b.

    Near, U <= `FAR` ω r: V is a rotation about the instantaneous centre p_0, homogeneous in p - p_0, so by
    the divergence theorem ∫ F dA = ∮ F (p - p_0) . n ds/(q + 2) for every F of degree q in it, which leaves
    the rim, graded towards its point nearest to p_0. Far: the hypergeometric series
    D = π r² U^a/a F(-a/2, -a/2; 2; (ω r/U)²), a = b + 2, which needs no p_0.

    Args:
        b: exponent.
        r: radius [m].
        U: speed of the centre [m/s], not negative.
        w: angular velocity about the normal [rad/s], not negative.
        nodes: of the graded rules.

    Returns:
        Along U twice, across U twice, along U and in ω, in ω twice.
    """
    if U == 0 and w == 0:
        return 0.0, 0.0, 0.0, 0.0
    if U > FAR * w * r:
        return _from_afar(b, r, U, w)
    D_UU, D_across, D_U, D_w = 0.0, 0.0, 0.0, 0.0
    for i in range(len(nodes.x)):
        tau = math.pi * nodes.x[i]
        cosine, sine, half_sine = math.cos(tau), math.sin(tau), math.sin(tau / 2)
        square = (U - w * r) ** 2 + 4 * w * r * U * half_sine * half_sine
        if square == 0:
            continue
        V_along, V_across = U - w * r * cosine, w * r * sine
        strip = nodes.weights[i] * (r - U / w * cosine) * power(square, b)
        D_UU += strip * (1 + b * V_along * V_along / square)
        D_across += strip * (1 + b * V_across * V_across / square)
        D_U += strip * V_along
        D_w += strip * square / w
    rim = 2 * math.pi * r
    D_UU *= rim / (b + 2)
    D_across *= rim / (b + 2)
    D_U *= rim / (b + 3)
    D_w = rim / (b + 4) * D_w - U / w * D_U
    D_Uw = ((1 + b) * D_U - U * D_UU) / w
    return D_UU, D_across, D_Uw, ((1 + b) * D_w - U * D_Uw) / w


@compiled
def _from_afar(b: float, r: float, U: float, w: float) -> tuple[float, float, float, float]:
    """Sum the series of `disc_dissipation` until a term is below rounding."""
    a, y, turn = b + 2, (w * r / U) ** 2, w * r / U
    D_UU, D_U, D_Uw, D_ww = a * (a - 1), a, 0.0, 0.0
    c, before = 1.0, 1.0  # coefficient of y^n, and y^(n-1)
    for n in range(1, 200):
        c *= (n - 1 - a / 2) ** 2 / (n * (n + 1))
        term = c * before
        D_ww += 2 * n * (2 * n - 1) * term
        D_Uw += (a - 2 * n) * 2 * n * term * turn
        D_U += (a - 2 * n) * term * y
        D_UU += (a - 2 * n) * (a - 2 * n - 1) * term * y
        if 4 * n * n * abs(term) < 1e-17:
            break
        before *= y
    k = math.pi * r * r * power(U * U, b) / a
    return k * D_UU, k * D_U, k * r * D_Uw, k * r * r * D_ww
