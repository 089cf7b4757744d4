"""The air's pressure on the outward-moving parts of a coin's surface, for 0 < b <= 1."""

import math

from cointoss.analytic.air.law import AirMotion, changed_law, power
from cointoss.analytic.air.quadrature import Nodes
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add


@compiled
def pressure_change(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Return how pressure's force and moment at B change with the motion, from eqs (52), (54), (73), (74).

    Arguments and returns as those of `air.force.change_about_B`.
    """
    df, dm = _on_faces(body, motion, nodes)
    if body.thickness > 0:
        df_wall, dm_wall = _on_wall(body, motion, nodes)
        df, dm = add(df, df_wall), add(dm, dm_wall)
    return df, dm


@compiled
def _on_faces(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Integrate over both faces: eqs (80) and (83), which hold at any thickness.

    The normal velocity v_ζ + ω_ξ η - ω_η ξ is the same on both faces, and outward on exactly one of them:
    both together are one whole disc. It varies along one direction only, as v_ζ + W u with u = -r cos φ;
    across, chords are integrated in closed form. Both pieces of φ are graded towards where it vanishes, or
    nearly.
    """
    b, v, w, dv, dw = motion
    r = body.radius
    W = math.hypot(w[0], w[1])
    along = (-w[1] / W, w[0] / W) if W > 0 else (1.0, 0.0)
    d_along = -dw[1] * along[0] + dw[0] * along[1]
    d_across = dw[1] * along[1] + dw[0] * along[0]
    cosine = v[2] / (W * r) if abs(v[2]) < W * r else math.copysign(1.0, v[2])
    still = math.acos(cosine)
    whole, lever, lever_across = 0.0, 0.0, 0.0
    for end in (0.0, math.pi):
        for i in range(len(nodes.x)):
            phi = still + (end - still) * nodes.x[i]
            u, half_chord = -r * math.cos(phi), r * math.sin(phi)
            speed = v[2] + W * u
            strip = (
                abs(end - still) * nodes.weights[i] * 2 * half_chord * half_chord * power(speed * speed, b)
            )
            whole += strip * (dv[2] + d_along * u)
            lever += strip * (dv[2] + d_along * u) * u
            lever_across += strip * d_across * half_chord * half_chord / 3
    k = -body.air.normal * (1 + b)
    return (0.0, 0.0, k * whole), (
        k * (along[1] * lever + along[0] * lever_across),
        k * (-along[0] * lever + along[1] * lever_across),
        0.0,
    )


@compiled
def _on_wall(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Integrate over the wall.

    At the height z the normal velocity is |A| cos(θ - θ_A) with A = (v_ξ + ω_η z, v_η - ω_ξ z). Over the half
    turn in which it points outwards ∫ cos^(b+2) = √π Γ((b+3)/2)/Γ(b/2+2), which leaves |A|^b A along z. Both
    pieces of z are graded towards where |A| is least.
    """
    b, v, w, dv, dw = motion
    r, half = body.radius, body.thickness / 2
    W_square = w[0] * w[0] + w[1] * w[1]
    nearest = (v[1] * w[0] - v[0] * w[1]) / W_square if W_square > 0 else 0.0
    nearest = min(max(nearest, -half), half)
    f_0, f_1, m_0, m_1 = 0.0, 0.0, 0.0, 0.0
    for end in (-half, half):
        for i in range(len(nodes.x)):
            z = nearest + (end - nearest) * nodes.x[i]
            K_0, K_1 = changed_law(v[0] + w[1] * z, v[1] - w[0] * z, dv[0] + dw[1] * z, dv[1] - dw[0] * z, b)
            strip = abs(end - nearest) * nodes.weights[i]
            f_0 += strip * K_0
            f_1 += strip * K_1
            m_0 -= strip * z * K_1
            m_1 += strip * z * K_0
    around = math.pi**0.5 * math.exp(math.lgamma((b + 3) / 2) - math.lgamma(b / 2 + 2))
    k = -body.air.normal * r * around
    return (k * f_0, k * f_1, 0.0), (k * m_0, k * m_1, 0.0)
