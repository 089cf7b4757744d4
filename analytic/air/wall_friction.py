"""The air's friction on the wall of a coin, for 0 < b <= 1.

At the point (r cos θ, r sin θ, z) the tangential velocity T has the parts T_θ = C(θ) + D(θ) z, around, and
T_ζ = B(θ), along the wall. The integrand |T|^b T is not smooth only where T_θ ± i T_ζ = 0. At a given z that
is a quadratic equation for exp(iθ): the branch points of the integral around are known, and each rule is
chosen by their distance. The integral around, as a function of z, is not smooth only where two of them meet
on both sides of the circle: at z_i where C + D z = 0 = B, and at z_d where the quadratic's discriminant
vanishes. These are known too.
"""

import math

import numpy as np

from analytic.air.law import changed_law
from analytic.air.quadrature import gauss_rule
from models.kernel.compiled import compiled

TURN = 96
"""Points of the full rectangle rule around; coarser ones take every second, third, fourth or sixth."""
_TURN_COS, _TURN_SIN = (part(2 * np.pi * np.arange(TURN) / TURN) for part in (np.cos, np.sin))
_SHORT_X, _SHORT_W = gauss_rule(6)
_MIDDLE_X, _MIDDLE_W = gauss_rule(12)
_LONG_X, _LONG_W = gauss_rule(24)
_NO_SUMS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def wall_friction_change(body, v, w, dv, dw, nodes):
    """Return how the friction on the wall, at B, changes with the motion, from eqs (53) and (74).

    Arguments and returns as those of `air.force.change_about_B`.
    """
    half = body.thickness / 2
    total = _NO_SUMS
    breaks, number, decay = _breaks_along(body, v, w, nodes.digits)
    if number == 0:
        if decay * 2 * 6 > nodes.digits:
            total = _plain(body, v, w, dv, dw, nodes, _SHORT_X, _SHORT_W)
        elif decay * 2 * 12 > nodes.digits:
            total = _plain(body, v, w, dv, dw, nodes, _MIDDLE_X, _MIDDLE_W)
        else:
            total = _plain(body, v, w, dv, dw, nodes, _LONG_X, _LONG_W)
    else:
        # From each break half way to its neighbours, and all the way to the ends.
        for i in range(number):
            low = -half if i == 0 else (breaks[i - 1] + breaks[i]) / 2
            high = half if i == number - 1 else (breaks[i] + breaks[i + 1]) / 2
            for end in (low, high):
                for j in range(len(nodes.along_x)):
                    z = breaks[i] + (end - breaks[i]) * nodes.along_x[j]
                    strip = abs(end - breaks[i]) * nodes.along_weights[j]
                    if strip > 0:
                        total = _add(total, strip, _around(body, v, w, dv, dw, z, nodes))
    k = -body.air.tangential * body.radius
    f_0, f_1, f_2, m_0, m_1, m_2 = total
    return (k * f_0, k * f_1, k * f_2), (k * m_0, k * m_1, k * m_2)


@compiled
def _add(total, k, part):
    return (
        total[0] + k * part[0],
        total[1] + k * part[1],
        total[2] + k * part[2],
        total[3] + k * part[3],
        total[4] + k * part[4],
        total[5] + k * part[5],
    )


@compiled
def _plain(body, v, w, dv, dw, nodes, z_x, z_weights):
    h, total = body.thickness, _NO_SUMS
    for j in range(len(z_x)):
        around = _around(body, v, w, dv, dw, h * (z_x[j] - 0.5), nodes)
        total = _add(total, h * z_weights[j], around)
    return total


@compiled
def _breaks_along(body, v, w, digits):
    """Find the heights at which the integral around is not smooth, and how far they are.

    Returns:
        breaks: increasing heights to grade to [m], where Gauss's rules would need too many nodes; space
            for 4.
        number: how many they are.
        decay: n nodes of Gauss's rule err by exp(-2 n decay), where there are no breaks.
    """
    r, half = body.radius, body.thickness / 2
    breaks, number, decay = np.empty(4), 0, np.inf
    W_square = w[0] * w[0] + w[1] * w[1]
    if W_square == 0:
        return breaks, number, decay
    W = W_square**0.5
    # B = v_ζ - r W cos ψ vanishes at a real or complex ψ = ± still.
    cosine = v[2] / (r * W)
    sine = complex(1 - cosine * cosine, 0.0) ** 0.5
    across = (v[0] * w[0] + v[1] * w[1]) / W
    middle = (v[1] * w[0] - v[0] * w[1]) / W_square
    apart = r * w[2] + cosine * across
    offset = 0j
    if apart != 0:
        offset = apart / (W * sine) if W * sine != 0 else complex(np.inf, 0.0)
    # The discriminant g_0² - g_c² - g_s² of `_branch_points`, as a quadratic in z - middle.
    g_0 = complex(r * w[2], v[2])
    A_0, A_1 = v[0] + w[1] * middle, v[1] - w[0] * middle
    shifted_0, shifted_1 = complex(A_0, -r * w[0]), complex(A_1, -r * w[1])
    mean = (shifted_1 * w[0] - shifted_0 * w[1]) / W_square
    product = (shifted_0 * shifted_0 + shifted_1 * shifted_1 - g_0 * g_0) / W_square
    spread = (mean * mean - product) ** 0.5
    for point in (middle + offset, middle - offset, middle + mean + spread, middle + mean - spread):
        ratio = point / half
        if not (abs(ratio) < 1e8):
            continue
        root = (ratio * ratio - 1) ** 0.5
        distance = math.log(max(abs(ratio + root), abs(ratio - root)))
        decay = min(decay, distance)
        if distance * 2 * 24 < digits:
            z = min(max(point.real, -half), half)
            i = number
            while i > 0 and breaks[i - 1] > z:
                breaks[i] = breaks[i - 1]
                i -= 1
            breaks[i] = z
            number += 1
    return breaks, number, decay


@compiled
def _branch_points(body, v, w, z):
    """Find where T_θ + i T_ζ = g_0 + g_c cos θ + g_s sin θ vanishes, for complex θ.

    Returns:
        Real part and size of the imaginary part of both solutions; infinite where there is none.
    """
    r = body.radius
    g_0 = complex(r * w[2], v[2])
    g_c = complex(v[1] - w[0] * z, -r * w[1])
    g_s = complex(-v[0] - w[1] * z, r * w[0])
    root = (g_0 * g_0 - g_c * g_c - g_s * g_s) ** 0.5
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
    return theta_1, away_1, theta_2, away_2


@compiled
def _around(body, v, w, dv, dw, z, nodes):
    """Integrate over θ at one height: by the rectangle rule, or by graded rules between the branch points."""
    theta_1, away_1, theta_2, away_2 = _branch_points(body, v, w, z)
    away = min(away_1, away_2)
    total = _NO_SUMS
    if away * TURN > nodes.digits:
        stride = 1
        for part in (2, 3, 4, 6):
            if away * TURN > part * nodes.digits:
                stride = part
        for i in range(0, TURN, stride):
            total = _add(total, 1.0, _at(body, v, w, dv, dw, z, _TURN_COS[i], _TURN_SIN[i]))
        return _add(_NO_SUMS, 2 * math.pi * stride / TURN, total)
    if away_1 == np.inf:
        theta_1 = theta_2
    elif away_2 == np.inf:
        theta_2 = theta_1
    first, second = min(theta_1, theta_2), max(theta_1, theta_2)
    # Two arcs, each graded from both ends to its middle.
    for start, length in (
        (first, (second - first) / 2),
        (second, (first - second) / 2),
        (second, math.pi - (second - first) / 2),
        (first, (second - first) / 2 - math.pi),
    ):
        if length == 0:
            continue
        for i in range(len(nodes.x)):
            theta = start + length * nodes.x[i]
            value = _at(body, v, w, dv, dw, z, math.cos(theta), math.sin(theta))
            total = _add(total, abs(length) * nodes.weights[i], value)
    return total


@compiled
def _at(body, v, w, dv, dw, z, cosine, sine):
    """Return the change of |T|^b T at one point of the wall as force and moment, per area."""
    b, r = body.air.exponent, body.radius
    T_around = r * w[2] - (v[0] + w[1] * z) * sine + (v[1] - w[0] * z) * cosine
    T_along = v[2] + r * (w[0] * sine - w[1] * cosine)
    dT_around = r * dw[2] - (dv[0] + dw[1] * z) * sine + (dv[1] - dw[0] * z) * cosine
    dT_along = dv[2] + r * (dw[0] * sine - dw[1] * cosine)
    K_around, K_along = changed_law(T_around, T_along, dT_around, dT_along, b)
    return (
        -sine * K_around,
        cosine * K_around,
        K_along,
        r * sine * K_along - z * cosine * K_around,
        -z * sine * K_around - r * cosine * K_along,
        r * K_around,
    )
