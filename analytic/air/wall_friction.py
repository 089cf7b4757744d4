"""The air's friction on the wall of a coin, for 0 < b <= 1.

At the point (r cos θ, r sin θ, z) the wall moves with the tangential velocity T = (C(θ) + D(θ) z, B(θ)),
around and along it. What `wall_strip` integrates along z is not smooth in θ only where a point of a rim is at
rest, C ± D h/2 = 0 = B, or a point between the rims, where B = 0 and C + D z vanishes at a height of it. Both
are known, complex θ too, and the rule around is chosen by their distance.
"""

import cmath
import math

import numpy as np

from cointoss.analytic.air.law import AirMotion
from cointoss.analytic.air.quadrature import Nodes
from cointoss.analytic.air.wall_strip import PhiSeries, phi_series, strip_change
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.circle import on_circle
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm, scale

TURN = 96
"""Points of the full rectangle rule around; coarser ones take every second, third, fourth or sixth."""
_TURN_COS, _TURN_SIN = on_circle(TURN, TURN)
# Where B = 0 while C + D z vanishes at a height, complex too, above so many h/2, the integral along z is
# smooth: its path lies between the rims.
_HIGHEST = 2.0
_MOST_BREAKS = 6
Sums = tuple[float, float, float, float, float, float]
"""Force and moment."""
Pair = tuple[tuple[float, float], tuple[float, float]]
"""Real part and size of the imaginary part of two solutions, infinite where there is none."""
_NO_SUMS: Sums = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def wall_friction_change(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Return how the friction on the wall, at B, changes with the motion, from eqs (53) and (74).

    Arguments and returns as those of `air.force.change_about_B`.
    """
    b, v, w, dv, dw = motion
    r = body.radius
    size = norm(v) + r * norm(w)
    if size == 0:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    # It is homogeneous of degree b in the motion.
    of_size_one = AirMotion(b, scale(1 / size, v), scale(1 / size, w), dv, dw)
    f_0, f_1, f_2, m_0, m_1, m_2 = _around(body, of_size_one, nodes)
    k = -body.air.tangential * r * size**b
    return (k * f_0, k * f_1, k * f_2), (k * m_0, k * m_1, k * m_2)


@compiled
def _around(body: Body, motion: AirMotion, nodes: Nodes) -> Sums:
    """Integrate over θ: by the rectangle rule, or by rules between the points at which it is not smooth."""
    breaks, away, nearest = np.empty(_MOST_BREAKS), np.empty(_MOST_BREAKS), np.inf
    number = _breaks(body, motion.v, motion.w, breaks, away)
    for i in range(number):
        nearest = min(nearest, away[i])
    series, total = phi_series(motion.exponent), _NO_SUMS
    if nearest * TURN > nodes.digits:
        stride = 1
        for part in (2, 3, 4, 6):
            if nearest * TURN > part * nodes.digits:
                stride = part
        for i in range(0, TURN, stride):
            strip = _strip(body, motion, series, _TURN_COS[i], _TURN_SIN[i])
            total = _add(total, 2 * math.pi * stride / TURN, strip)
        return total
    number = _without_hidden(breaks, away, number)
    for i in range(number):
        # From each break half way to the next, and to the one before.
        ahead = breaks[i + 1] if i + 1 < number else breaks[0] + 2 * math.pi
        behind = breaks[i - 1] if i > 0 else breaks[number - 1] - 2 * math.pi
        for length in ((ahead - breaks[i]) / 2, (behind - breaks[i]) / 2):
            for j in range(len(nodes.around_x)):
                theta = breaks[i] + length * nodes.around_x[j]
                strip = _strip(body, motion, series, math.cos(theta), math.sin(theta))
                total = _add(total, abs(length) * nodes.around_weights[j], strip)
    return total


@compiled
def _without_hidden(breaks: Array, away: Array, number: int) -> int:
    """Keep the breaks that no other one hides, and return how many there are.

    From a break that hides it, which is nearer to the real axis, a hidden one is seen within 27° of the
    perpendicular; where that one is hidden too, within 45° from the last. So the rule graded towards the last
    converges for all.
    """
    kept, is_hidden = 0, np.zeros(_MOST_BREAKS, np.bool_)
    for i in range(number):
        for j in range(number):
            apart = abs(breaks[i] - breaks[j])
            is_nearer = away[j] < away[i] or (away[j] == away[i] and j < i)
            is_hidden[i] |= is_nearer and 2 * min(apart, 2 * math.pi - apart) <= away[i]
    for i in range(number):
        if not is_hidden[i]:
            breaks[kept], away[kept], kept = breaks[i], away[i], kept + 1
    return kept


@compiled
def _add(total: Sums, k: float, part: Sums) -> Sums:
    return (
        total[0] + k * part[0],
        total[1] + k * part[1],
        total[2] + k * part[2],
        total[3] + k * part[3],
        total[4] + k * part[4],
        total[5] + k * part[5],
    )


@compiled
def _breaks(body: Body, v: Vector, w: Vector, breaks: Array, away: Array) -> int:
    """Find where the integral along the wall is not smooth in θ.

    Args:
        body: the coin.
        v: velocity of B, body frame, (3,).
        w: angular velocity, body frame, (3,).
        breaks: where the real parts go, in increasing order, (6,).
        away: where the sizes of the imaginary parts go, (6,).

    Returns:
        Their number.
    """
    half, number = body.thickness / 2, 0
    on_rims = _rest_on_rim(body, v, w, -half), _rest_on_rim(body, v, w, half)
    for pair in (*on_rims, _rest_between_rims(body, v, w)):
        for theta, distance in pair:
            number = _insert(breaks, away, number, theta, distance)
    return number


@compiled
def _insert(breaks: Array, away: Array, number: int, theta: float, distance: float) -> int:
    """Insert a break, -2π < θ < 4π, in its place unless it is infinitely far; return how many there are."""
    if distance == np.inf:
        return number
    i = number
    if theta < 0:
        theta += 2 * math.pi
    elif theta >= 2 * math.pi:
        theta -= 2 * math.pi
    while i > 0 and breaks[i - 1] > theta:
        breaks[i], away[i] = breaks[i - 1], away[i - 1]
        i -= 1
    breaks[i], away[i] = theta, distance
    return number + 1


@compiled
def _rest_on_rim(body: Body, v: Vector, w: Vector, z: float) -> Pair:
    """Find where T_θ + i T_ζ = g_0 + g_c cos θ + g_s sin θ vanishes at the height z, for complex θ."""
    r = body.radius
    g_0 = complex(r * w[2], v[2])
    g_c = complex(v[1] - w[0] * z, -r * w[1])
    g_s = complex(-v[0] - w[1] * z, r * w[0])
    root = cmath.sqrt(g_0 * g_0 - g_c * g_c - g_s * g_s)
    if (g_0.conjugate() * root).real < 0:
        root = -root
    top, bottom = g_c + 1j * g_s, g_c - 1j * g_s
    theta_1, away_1, theta_2, away_2 = 0.0, np.inf, 0.0, np.inf
    if g_0 + root != 0:
        if bottom != 0:
            larger = -(g_0 + root) / bottom
            theta_1, away_1 = math.atan2(larger.imag, larger.real), abs(math.log(abs(larger)))
        if top != 0:
            smaller = -top / (g_0 + root)
            theta_2, away_2 = math.atan2(smaller.imag, smaller.real), abs(math.log(abs(smaller)))
    return (theta_1, away_1), (theta_2, away_2)


@compiled
def _rest_between_rims(body: Body, v: Vector, w: Vector) -> Pair:
    """Find where B vanishes and C + D z at a height of the wall, or near it, for complex θ.

    With α = θ - φ, φ the direction of ω's part across ζ and W its size: B = v_ζ + r W sin α, D = -W cos α and
    C = r ω_ζ + v_⊥ cos α - v_∥ sin α, v_∥ and v_⊥ being the parts of v along that direction and across it.
    """
    r, W = body.radius, math.hypot(w[0], w[1])
    theta_1, away_1, theta_2, away_2 = 0.0, np.inf, 0.0, np.inf
    if W == 0:
        return (theta_1, away_1), (theta_2, away_2)
    along, across = (v[0] * w[0] + v[1] * w[1]) / W, (v[1] * w[0] - v[0] * w[1]) / W
    sine, phi = -v[2] / (r * W), math.atan2(w[1], w[0])
    cosine = cmath.sqrt(complex(1 - sine * sine, 0.0))
    angle, distance = math.asin(min(max(sine, -1.0), 1.0)), math.acosh(max(abs(sine), 1.0))
    highest = _HIGHEST * body.thickness / 2 * W
    # C + D z = 0 at z = -C/D.
    if abs(r * w[2] + across * cosine - along * sine) <= highest * abs(cosine):
        theta_1, away_1 = phi + angle, distance
    if abs(r * w[2] - across * cosine - along * sine) <= highest * abs(cosine):
        theta_2, away_2 = phi + math.pi - angle, distance
    return (theta_1, away_1), (theta_2, away_2)


@compiled
def _strip(body: Body, motion: AirMotion, series: PhiSeries, cosine: float, sine: float) -> Sums:
    """Return the change of |T|^b T at one θ, integrated along the wall, as force and moment, per length."""
    r = body.radius
    B, C, D = _velocity(r, motion.v, motion.w, cosine, sine)
    dB, dC, dD = _velocity(r, motion.dv, motion.dw, cosine, sine)
    H = strip_change(motion.exponent, series, body.thickness / 2, B, C, D)
    K_around = H.around * dC + H.around_z * dD + H.mixed * dB
    K_around_z = H.around_z * dC + H.around_zz * dD + H.mixed_z * dB
    K_along = H.mixed * dC + H.mixed_z * dD + H.along * dB
    return (
        -sine * K_around,
        cosine * K_around,
        K_along,
        r * sine * K_along - cosine * K_around_z,
        -sine * K_around_z - r * cosine * K_along,
        r * K_around,
    )


@compiled
def _velocity(r: float, v: Vector, w: Vector, cosine: float, sine: float) -> tuple[float, float, float]:
    """Return B, C and D of the wall at one θ."""
    return (
        v[2] + r * (w[0] * sine - w[1] * cosine),
        r * w[2] - v[0] * sine + v[1] * cosine,
        -w[1] * sine - w[0] * cosine,
    )
