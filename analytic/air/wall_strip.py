"""The air's friction on a strip along the wall of a coin: what it changes by, integrated over the strip.

At the height z of a strip the wall moves with the tangential velocity T = (C + D z, B), around and along it.
Friction is the gradient of -|T|^(b+2)/(b+2), 0 < b <= 1. The integrals of its second derivatives over
x = C + D z are closed forms but for Φ = ∫ (x² + B²)^(b/2) dx, a hypergeometric function of one variable.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.air.law import power
from cointoss.analytic.air.quadrature import gauss_rule
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled

_X, _WEIGHTS = gauss_rule(6)
# Where T vanishes so many half lengths of the strip from its middle, Gauss's rule errs by 1e-12 at most.
_FAR_ZERO = 6.0
# Φ is a series of (B/x)² beyond this x/|B|, below it one of x²/(x² + B²); so many terms reach rounding.
_FAR = 4 / 3
_FAR_TERMS, _NEAR_TERMS, _LEAST_TERM = 64, 80, 1e-17


class PhiSeries(NamedTuple):
    """The coefficients of Φ for one b."""

    near: NDArray[np.float64]
    """The series of F(-b/2, 1; 3/2; y), which is Φ/(x |T|^b), in y = x²/(x² + B²)."""
    far: NDArray[np.float64]
    """The series of Φ/x^(b+1) in (B/x)², but for the second term, which `_logarithm` has."""
    beyond: float
    """What Φ has beside that series for B = 1, so that its forms meet."""


class StripChange(NamedTuple):
    """Integrals over z of the second derivatives of |T|^(b+2)/(b+2), T = (T_θ, T_ζ)."""

    around: float
    """The integral of the second derivative by T_θ."""
    around_z: float
    """The same times z."""
    around_zz: float
    """The same times z²."""
    mixed: float
    """The integral of the derivative by T_θ and T_ζ."""
    mixed_z: float
    """The same times z."""
    along: float
    """The integral of the second derivative by T_ζ."""


@compiled
def strip_change(b: float, series: PhiSeries, half: float, B: float, C: float, D: float) -> StripChange:
    """Return the `StripChange` of the strip from z = -half to half.

    Where T vanishes, at a complex z, far from the strip, Gauss's rule does; near it the closed forms do not
    cancel. The speeds are in parts of the coin's, lest their cubes underflow.

    Args:
        b: exponent.
        series: the `PhiSeries` of b.
        half: half the length of the strip [m].
        B: velocity along the wall.
        C: velocity around it at z = 0.
        D: its change with z [1/m].
    """
    if B == 0 and C == 0 and D == 0:
        return StripChange(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if C * C + B * B > (_FAR_ZERO * D * half) ** 2:
        return _by_gauss(b, half, B, C, D)
    low, high = C - D * half, C + D * half
    low_square, high_square = low * low + B * B, high * high + B * B
    P, Q = power(low_square, b), power(high_square, b)
    F = _phi(b, series, high, B, Q) - _phi(b, series, low, B, P)
    first, second = high * Q - low * P, high * high * Q - low * low * P
    third = high * high * high * Q - low * low * low * P
    # ∫ x |T|^b and ∫ x² |T|^b
    odd = (high_square * Q - low_square * P) / (b + 2)
    even = (high * high_square * Q - low * low_square * P - B * B * F) / (b + 3)
    around, around_x, around_xx = first, second - odd, third - 2 * even
    mixed, mixed_x = B * (Q - P), B * (first - F)
    return StripChange(
        around / D,
        (around_x - C * around) / (D * D),
        (around_xx - C * (2 * around_x - C * around)) / (D * D * D),
        mixed / D,
        (mixed_x - C * mixed) / (D * D),
        ((2 + b) * F - first) / D,
    )


@compiled
def _by_gauss(b: float, half: float, B: float, C: float, D: float) -> StripChange:
    """Return the `StripChange` by Gauss's rule; for the arguments see `strip_change`."""
    around, around_z, around_zz, mixed, mixed_z, along = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(len(_X)):
        z = half * (2 * _X[i] - 1)
        x = C + D * z
        square = x * x + B * B
        strip = 2 * half * _WEIGHTS[i] * power(square, b)
        bent = b * strip / square
        by_around, by_both = strip + bent * x * x, bent * x * B
        around += by_around
        around_z += z * by_around
        around_zz += z * z * by_around
        mixed += by_both
        mixed_z += z * by_both
        along += strip + bent * B * B
    return StripChange(around, around_z, around_zz, mixed, mixed_z, along)


@compiled
def phi_series(b: float) -> PhiSeries:
    """Return the `PhiSeries` of b."""
    near, far = np.empty(_NEAR_TERMS), np.empty(_FAR_TERMS)
    term = 1.0
    for k in range(_NEAR_TERMS):
        near[k] = term
        term *= (k - b / 2) / (k + 1.5)
    term = 1.0
    for k in range(_FAR_TERMS):
        far[k] = term / (b + 1 - 2 * k) if k != 1 else 0.0
        term *= (b / 2 - k) / (k + 1)
    square = _FAR * _FAR
    meeting = _FAR * (square + 1) ** (b / 2) * _power_series(near, square / (square + 1))
    series = _FAR ** (b + 1) * _power_series(far, 1 / square) + b / 2 * _logarithm(b, _FAR, 1.0)
    return PhiSeries(near, far, meeting - series)


@compiled
def _phi(b: float, series: PhiSeries, x: float, B: float, speed_power: float) -> float:
    """Return Φ(x) = ∫_0^x (t² + B²)^(b/2) dt.

    Args:
        b: exponent.
        series: the `PhiSeries` of b.
        x: end of the integral.
        B: see above.
        speed_power: (x² + B²)^(b/2).
    """
    size, B = abs(x), abs(B)
    if size <= _FAR * B:
        if size == 0:
            return 0.0
        return x * speed_power * _power_series(series.near, x * x / (x * x + B * B))
    inner = B ** (b + 1) * (b / 2 * _logarithm(b, size, B) + series.beyond) if B > 0 else 0.0
    return math.copysign(size ** (b + 1) * _power_series(series.far, (B / size) ** 2) + inner, x)


@compiled
def _power_series(coefficients: Array, x: float) -> float:
    """Return the sum of a power series for 0 <= x < 1, as far as it matters.

    Its coefficients are at most about 1, and their number is four times another. Its four sums do not wait
    for each other.
    """
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    square, weight, k = x * x, 1.0, 0
    while k < len(coefficients) and weight > _LEAST_TERM:
        a += weight * coefficients[k]
        b += weight * coefficients[k + 1]
        c += weight * coefficients[k + 2]
        d += weight * coefficients[k + 3]
        weight *= square * square
        k += 4
    return a + x * b + square * (c + x * d)


@compiled
def _logarithm(b: float, x: float, B: float) -> float:
    """Return ((x/B)^(b-1) - 1)/(b - 1), for b = 1 its limit ln(x/B)."""
    logarithm = math.log(x) - math.log(B)
    return math.expm1((b - 1) * logarithm) / (b - 1) if b != 1 else logarithm
