"""The air's force on a cylinder for 0 < b <= 1, by adaptive quadrature.

Lengths are in radii r and speeds in |v| + r |ω|, so every integral is of order one and the tolerance is one
number. The integrals:

- pressure on both faces, one whole disc, over the angle φ of its chords across the slope of the speed;
- friction on a face over its rim: with s the speed of the rim's point at τ, U the speed of the centre and
  ω_ζ the spin, Gauss's theorem and partial integration leave F = U r² ∮ s^b sin²τ dτ and
  M = ω_ζ r⁴/(b + 4) ∮ s^b (1 + 2 b q - b (2 - b) q²/3) dτ, q = (U sin τ/s)² <= 1, which hold for all U, ω_ζ;
- pressure on the wall along ζ, closed around; and friction on it, over the angle and then along ζ.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.models.body import AirLaw
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector

TOLERANCE = 1e-11
"""Largest difference of the two rules on an accepted piece. The error of the finer one is far smaller."""
NARROWEST = 1e-14
"""A piece is not halved below this [rad, or r]: what it holds is below rounding."""
PRESSURE_ON_FACES, FRICTION_ON_UPPER, FRICTION_ON_LOWER, PRESSURE_ON_WALL, FRICTION_ON_WALL = range(5)

Sums = tuple[float, float, float, float, float, float]
_NOTHING: Sums = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_COARSE_X, _COARSE_W = np.polynomial.legendre.leggauss(10)
_FINE_X, _FINE_W = np.polynomial.legendre.leggauss(16)
_FOUR_X, _FOUR_W = np.polynomial.legendre.leggauss(4)
_SIX_X, _SIX_W = np.polynomial.legendre.leggauss(6)


class ScaledMotion(NamedTuple):
    """A coin in motion, in radii and in units of speed."""

    exponent: float
    half: float
    """Half the thickness."""
    v: Vector
    """The velocity of B, body frame."""
    w: Vector
    """Body frame."""


class LineVelocity(NamedTuple):
    """The velocity along a line of the wall: T = C + D z around, and B along ζ."""

    B: float
    C: float
    D: float


@compiled
def air_force(radius: float, thickness: float, air: AirLaw, v: Vector, w: Vector) -> tuple[Vector, Vector]:
    """Return the air's force on a coin and its moment about B. Strzalko et al. 2008, eqs (49)-(74).

    Args:
        radius: r [m].
        thickness: h, 0 for the thin coin [m].
        air: its law, with an exponent.
        v: velocity of B, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        f: force, body frame, (3,) [N].
        m_B: moment about B, body frame, (3,) [N m].
    """
    r, b = radius, air.exponent or 0.0
    speed = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) ** 0.5
    speed += r * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) ** 0.5
    if speed == 0:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    k = 1 / speed
    motion = ScaledMotion(
        b,
        thickness / (2 * r),
        (k * v[0], k * v[1], k * v[2]),
        (k * r * w[0], k * r * w[1], k * r * w[2]),
    )
    total = _NOTHING
    if air.normal > 0:
        total = _plus(total, -air.normal, _pressure(motion))
    if air.tangential > 0:
        total = _plus(total, -air.tangential, _friction(motion))
    size = r * r * speed ** (1 + b)
    f_0, f_1, f_2, m_0, m_1, m_2 = total
    return (size * f_0, size * f_1, size * f_2), (size * r * m_0, size * r * m_1, size * r * m_2)


@compiled
def _pressure(motion: ScaledMotion) -> Sums:
    """Integrate over both faces, and over the wall, from where the normal velocity vanishes or is least."""
    v, w, half = motion.v, motion.w, motion.half
    W = math.hypot(w[0], w[1])
    still = math.acos(v[2] / W) if abs(v[2]) < W else 0.0
    total = _NOTHING
    for end in (0.0, math.pi):
        total = _plus(total, 1.0, _integral(PRESSURE_ON_FACES, motion, still, end, 0.0))
    if half > 0:
        slowest = (v[1] * w[0] - v[0] * w[1]) / (W * W) if W * W > 0 else 0.0
        slowest = min(max(slowest, -half), half)
        least = math.hypot(v[0] + w[1] * slowest, v[1] - w[0] * slowest)
        layer = least / W if W > 0 else 0.0
        for end in (-half, half):
            total = _plus(total, 1.0, _integral(PRESSURE_ON_WALL, motion, slowest, end, layer))
    return total


@compiled
def _friction(motion: ScaledMotion) -> Sums:
    """Integrate over both faces, from the slowest point of the rim, and over the wall."""
    v, w, half = motion.v, motion.w, motion.half
    total = _NOTHING
    for part, z in ((FRICTION_ON_UPPER, half), (FRICTION_ON_LOWER, -half)):
        U, spin = math.hypot(v[0] + z * w[1], v[1] - z * w[0]), abs(w[2])
        layer = abs(U - spin) / (U * spin) ** 0.5 if U * spin > 0 else 0.0
        total = _plus(total, 1.0, _integral(part, motion, 0.0, math.pi, layer))
    return total if half == 0 else _plus(total, 1.0, _friction_on_wall(motion))


@compiled
def _friction_on_wall(motion: ScaledMotion) -> Sums:
    """Integrate from the angles where a velocity of the wall vanishes, or is least, half way to the next one.

    Along ζ it is B = v_ζ + ω_ξ sin θ - ω_η cos θ, around it is C = ω_ζ - v_ξ sin θ + v_η cos θ at z = 0.
    """
    v, w = motion.v, motion.w
    W, V = math.hypot(w[0], w[1]), math.hypot(v[0], v[1])
    middle_B, middle_C = math.atan2(-w[0], w[1]), math.atan2(v[0], -v[1])
    still_B = math.acos(min(max(v[2] / W, -1.0), 1.0)) if W > 0 else 0.0
    still_C = math.acos(min(max(w[2] / V, -1.0), 1.0)) if V > 0 else 0.0
    starts = np.array((middle_B - still_B, middle_B + still_B, middle_C - still_C, middle_C + still_C))
    turn = 2 * math.pi
    for i in range(4):  # no remainder, for which LLVM asks the C library
        start, place = starts[i] + (turn if starts[i] < 0 else -turn if starts[i] >= turn else 0.0), i
        while place > 0 and starts[place - 1] > start:
            starts[place] = starts[place - 1]
            place -= 1
        starts[place] = start
    total = _NOTHING
    for i in range(4):
        start = starts[i]
        before = starts[i - 1] if i > 0 else starts[3] - turn
        after = starts[i + 1] if i < 3 else starts[0] + turn
        B, C, D = _velocities_of_wall(motion, math.sin(start), math.cos(start))
        layer = math.hypot(math.hypot(B, C), D * motion.half) / math.hypot(V, W) if V + W > 0 else 0.0
        for end in ((start + before) / 2, (start + after) / 2):
            total = _plus(total, 1.0, _integral(FRICTION_ON_WALL, motion, start, end, layer))
    return total


@compiled
def _velocities_of_wall(motion: ScaledMotion, sine: float, cosine: float) -> LineVelocity:
    """Return the `LineVelocity` at an angle."""
    v, w = motion.v, motion.w
    return LineVelocity(
        v[2] + w[0] * sine - w[1] * cosine,
        w[2] - v[0] * sine + v[1] * cosine,
        -w[1] * sine - w[0] * cosine,
    )


@compiled
def _plus(total: Sums, k: float, part: Sums) -> Sums:
    return (
        total[0] + k * part[0],
        total[1] + k * part[1],
        total[2] + k * part[2],
        total[3] + k * part[3],
        total[4] + k * part[4],
        total[5] + k * part[5],
    )


@compiled
def _integral(part: int, motion: ScaledMotion, start: float, end: float, layer: float) -> Sums:
    """Integrate one part of the surface between start and end in pieces on which two rules of Gauss agree.

    The first piece is as wide as the layer at the start in which the integrand bends, where there is one:
    so narrow that both rules could miss it on a wider piece.
    """
    total, length, way = _NOTHING, abs(end - start), 1.0 if end > start else -1.0
    done, width = 0.0, layer if layer > NARROWEST else length
    while done < length:
        width = min(width, length - done)
        at, step = start + way * done, way * width
        fine = _by_rule(part, motion, at, step, _FINE_X, _FINE_W)
        coarse = _by_rule(part, motion, at, step, _COARSE_X, _COARSE_W)
        if _apart(fine, coarse) > TOLERANCE and width > NARROWEST:
            width /= 2
            continue
        total = _plus(total, 1.0, fine)
        done = length if width == length - done else done + width
        width *= 2
    return total


@compiled
def _apart(a: Sums, b: Sums) -> float:
    largest = 0.0
    for difference in _plus(a, -1.0, b):
        largest = max(largest, abs(difference))
    return largest


@compiled
def _by_rule(part: int, motion: ScaledMotion, start: float, width: float, x: Array, weights: Array) -> Sums:
    total = _NOTHING
    for i in range(len(x)):
        at = start + width * (1 + x[i]) / 2
        total = _plus(total, weights[i] * abs(width) / 2, _integrand(part, motion, at))
    return total


@compiled
def _integrand(part: int, motion: ScaledMotion, at: float) -> Sums:
    """Return what a part of the surface adds to force and moment, without -λ."""
    if part == PRESSURE_ON_FACES:
        return _pressure_on_chord(motion, at)
    if part == FRICTION_ON_UPPER:
        return _friction_at_rim(motion, motion.half, at)
    if part == FRICTION_ON_LOWER:
        return _friction_at_rim(motion, -motion.half, at)
    if part == PRESSURE_ON_WALL:
        return _pressure_on_circle(motion, at)
    return _friction_along_wall(motion, at)


@compiled
def _power(square: float, b: float) -> float:
    """Return |s|^b from s²."""
    return square**0.5 if b == 1 else square ** (b / 2)


@compiled
def _pressure_on_chord(motion: ScaledMotion, phi: float) -> Sums:
    """On the chord at -cos φ along the direction in which the normal velocity grows."""
    w = motion.w
    W = math.hypot(w[0], w[1])
    along = (-w[1] / W, w[0] / W) if W > 0 else (1.0, 0.0)
    u = -math.cos(phi)
    speed = motion.v[2] + W * u
    strip = 2 * math.sin(phi) ** 2 * _power(speed * speed, motion.exponent) * speed
    return 0.0, 0.0, strip, strip * u * along[1], -strip * u * along[0], 0.0


@compiled
def _friction_at_rim(motion: ScaledMotion, z: float, tau: float) -> Sums:
    """On the face at height z; both halves of its rim at once."""
    b, v, w = motion.exponent, motion.v, motion.w
    U_0, U_1 = v[0] + z * w[1], v[1] - z * w[0]
    U = math.hypot(U_0, U_1)
    spin = abs(w[2])
    square = (U - spin) ** 2 + 4 * U * spin * math.sin(tau / 2) ** 2
    if square == 0:
        return _NOTHING
    power, across = 2 * _power(square, b), math.sin(tau) ** 2
    q = U * U * across / square
    f_0, f_1 = U_0 * power * across, U_1 * power * across
    turn = w[2] / (b + 4) * power * (1 + 2 * b * q - b * (2 - b) / 3 * q * q)
    return f_0, f_1, 0.0, -z * f_1, z * f_0, turn


@compiled
def _pressure_on_circle(motion: ScaledMotion, z: float) -> Sums:
    """On the circle of the wall at height z: |A|^b A with the velocity A of its centre, times ∫ cos^(b+2)."""
    b, v, w = motion.exponent, motion.v, motion.w
    A_0, A_1 = v[0] + w[1] * z, v[1] - w[0] * z
    around = math.pi**0.5 * math.exp(math.lgamma((b + 3) / 2) - math.lgamma(b / 2 + 2))
    k = around * _power(A_0 * A_0 + A_1 * A_1, b)
    return k * A_0, k * A_1, 0.0, -z * k * A_1, z * k * A_0, 0.0


@compiled
def _friction_along_wall(motion: ScaledMotion, theta: float) -> Sums:
    """On the line of the wall at θ, where the velocity is T = C + D z around and B along ζ."""
    sine, cosine = math.sin(theta), math.cos(theta)
    line = _velocities_of_wall(motion, sine, cosine)
    along, around, around_z = _along_line(motion.exponent, motion.half, line)
    return (
        -sine * around,
        cosine * around,
        along,
        sine * along - cosine * around_z,
        -cosine * along - sine * around_z,
        around,
    )


@compiled
def _along_line(b: float, half: float, line: LineVelocity) -> tuple[float, float, float]:
    """Return ∫ |V|^b B dz, ∫ |V|^b T dz and ∫ |V|^b T z dz over |z| <= half, T = C + D z, |V|² = B² + T².

    |V| vanishes at z_0 ± i δ alone, z_0 = -C/D and δ = |B/D|. Where that is far off, one of Gauss's rules
    serves; else with z = z_0 + δ sinh x, in which |V| = |B| cosh x, in pieces.
    """
    B, C, D = line
    far = (B * B + C * C) / (half * half)
    if far > 2500 * D * D:
        return _by_gauss(b, half, line, _FOUR_X, _FOUR_W)
    if far > 121 * D * D:
        return _by_gauss(b, half, line, _SIX_X, _SIX_W)
    if far > 9 * D * D:
        return _by_gauss(b, half, line, _COARSE_X, _COARSE_W)
    middle, wide = -C / D, max(abs(B / D), 1e-20 * half)
    low, high = math.asinh((-half - middle) / wide), math.asinh((half - middle) / wide)
    pieces = math.ceil((high - low) / 2)
    piece = (high - low) / pieces
    along, around, around_z = 0.0, 0.0, 0.0
    for number in range(pieces):
        for i in range(len(_FINE_X)):
            grown = wide / 2 * math.exp(low + piece * (number + (1 + _FINE_X[i]) / 2))
            shrunk = wide * wide / (4 * grown)
            T, z = D * (grown - shrunk), middle + (grown - shrunk)
            strip = _FINE_W[i] * piece / 2 * (grown + shrunk) * _power(B * B + T * T, b)
            along, around, around_z = along + strip * B, around + strip * T, around_z + strip * T * z
    return along, around, around_z


@compiled
def _by_gauss(
    b: float, half: float, line: LineVelocity, x: Array, weights: Array
) -> tuple[float, float, float]:
    B, C, D = line
    along, around, around_z = 0.0, 0.0, 0.0
    for i in range(len(x)):
        z = half * x[i]
        T = C + D * z
        strip = weights[i] * half * _power(B * B + T * T, b)
        along, around, around_z = along + strip * B, around + strip * T, around_z + strip * T * z
    return along, around, around_z
