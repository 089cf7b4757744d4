"""How long a flight given by power series surely stays clear of the floor: the gap's sign as a polynomial.

The rim of the face at ζ = ±h/2, whose centre is at height q, is clear while F = q² - r² (u_ξ² + u_η²) > 0. q
and u are polynomials of time, and so is F. By Descartes' rule it has no more zeros in a time than changes of
sign among its Bernstein coefficients: none where all are positive, and one where they change once.
"""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.flight.power_series import HEIGHT, ORDER, UP
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.lanes import four, read_four

DEGREE = 2 * ORDER
# Rounding of F, against the sum of all products in it, and terms of it that are left out.
_ROUNDING, _SMALLEST = 1e-15, 1e-17
# A time to be shown clear is tried, then a third of it, and so on.
_SHORTER, _TRIES = 1 / 3, 8
# A fall through zero is sought from this part of the time on, in so many steps, until one is this part of it;
# the coin is clear to this part before it.
_START, _MOST_STEPS, _STEP, _BEFORE = 0.8, 20, 1e-7, 1e-13


class GapPolynomials(NamedTuple):
    """F of tails' and of heads' rim as polynomials of the time since the start of a step."""

    coefficients: Array
    """The coefficients of the two polynomials, (2, DEGREE + 1)."""
    degree: int
    rounding: float
    """The most by which rounding changes F [m²]."""


class TimeWindow(NamedTuple):
    """A time of interest within a step."""

    start: float
    """Since the start of the step [s]."""
    length: float
    """The longest time of interest [s]."""
    least: float
    """Shorter times are of no use [s]."""


@compiled
def gap_polynomials(
    body: Body, series: Array, order: int, length: float, coefficients: Array
) -> GapPolynomials:
    """Return the `GapPolynomials` of a step.

    Args:
        body: the coin.
        series: of the flight, see `power_series.expand_flight`.
        order: of the series.
        length: of the step [s].
        coefficients: where they go, (2, DEGREE + 1).
    """
    # Of q - (h/2) u_ζ, q + (h/2) u_ζ, r u_ξ and r u_η.
    parts, c = np.empty((order + 1, 4)), body.center
    height, level, power = 0.0, 0.0, 1.0
    for k in range(order + 1):
        up = series[k, UP[0]], series[k, UP[1]], series[k, UP[2]]
        q, lift = series[k, HEIGHT] - c[0] * up[0] - c[1] * up[1] - c[2] * up[2], body.thickness / 2 * up[2]
        across, along = body.radius * up[0], body.radius * up[1]
        parts[k, 0], parts[k, 1], parts[k, 2], parts[k, 3] = q - lift, q + lift, across, along
        height += (abs(q) + abs(lift)) * power
        level += (abs(across) + abs(along)) * power
        power *= length
    size, degree, power = height * height + level * level, 0, 1.0
    for k in range(2 * order + 1):
        # The squares of the four.
        square = four(0.0, 0.0, 0.0, 0.0)
        for j in range(max(0, k - order), (k + 1) // 2):
            square += read_four(parts, j, 0) * read_four(parts, k - j, 0)
        square *= 2.0
        if k % 2 == 0:
            middle = read_four(parts, k // 2, 0)
            square += middle * middle
        level = square[2] + square[3]
        tails, heads = square[0] - level, square[1] - level
        coefficients[0, k], coefficients[1, k] = tails, heads
        if max(abs(tails), abs(heads)) * power > _SMALLEST * size:
            degree = k
        elif k > max(degree + 2, order):
            break
        power *= length
    return GapPolynomials(coefficients, degree, _ROUNDING * size)


@compiled
def time_surely_clear(body: Body, polynomials: GapPolynomials, sink: float, window: TimeWindow) -> float:
    """Return a time from the window's start on during which a coin above the floor surely stays there.

    Args:
        body: the coin.
        polynomials: of the step.
        sink: how far below zero F may be before the touch: not at all, or what rounding hides [m²].
        window: of time.

    Returns:
        The time, all but that to the touch where it is found, 0 where none of use is [s].
    """
    coefficients, degree, rounding = polynomials
    inside, least = window.start, window.least
    shifted, bernstein = np.empty((2, degree + 1)), np.empty(degree + 1)
    rims = 2 if body.thickness > 0 else 1
    for rim in range(rims):
        for k in range(degree + 1):
            shifted[rim, k] = 0.0
        # Horner's scheme at inside + t; written so that all sums of a round are independent.
        for m in range(degree, -1, -1):
            left = coefficients[rim, m] + (sink - rounding if m == 0 else 0.0)
            for k in range(degree - m + 1):
                left, shifted[rim, k] = shifted[rim, k], inside * shifted[rim, k] + left
    time = window.length
    for _ in range(_TRIES):
        if time < least:
            break
        clear = time
        for rim in range(rims):
            if clear > 0:
                clear = min(clear, _positive_until(shifted, rim, time, sink, bernstein))
        if clear > least:
            return clear
        time *= _SHORTER
    return 0.0


@compiled
def _positive_until(polynomials: Array, rim: int, length: float, sink: float, bernstein: Array) -> float:
    """Return a time up to which a polynomial is positive, at most `length`; 0 where none is known.

    Args:
        polynomials: the coefficients of both rims, (2, n).
        rim: number of the one in question.
        length: of the time of interest [s].
        sink: where the polynomial falls through zero once, the time is one at which it still exceeds this.
        bernstein: work space, (n,).
    """
    degree, scale = len(bernstein) - 1, 1.0
    # The last coefficient comes first.
    for k in range(degree + 1):
        bernstein[degree - k] = polynomials[rim, k] * scale
        # The next power of the length, over the next binomial coefficient.
        scale *= length * ((k + 1) / max(degree - k, 1))
    for i in range(degree):
        for k in range(degree - i):
            bernstein[k] += bernstein[k + 1]
    if not bernstein[degree] > 0:
        return 0.0
    changes = 0
    for k in range(degree):
        changes += (bernstein[k] > 0) != (bernstein[k + 1] > 0)
    if changes == 0:
        return length
    return _before_fall(polynomials, rim, length, sink) if changes == 1 else 0.0


@compiled
def _before_fall(polynomials: Array, rim: int, length: float, least: float) -> float:
    """Return a time just before a polynomial falls through `least` for good, by Newton's method.

    Args:
        polynomials: the coefficients of both rims, (2, n).
        rim: number of the one in question.
        length: of the time in which it falls once below zero [s].
        least: small, not negative.
    """
    low, high, t = 0.0, length, _START * length
    for _ in range(_MOST_STEPS):
        value, rate = _value_and_rate(polynomials, rim, t)
        value -= least
        if value > 0:
            low = t
        else:
            high = t
        new = t - value / rate if rate < 0 else low
        if not low < new < high:
            new = (low + high) / 2
        step, t = abs(new - t), new
        if step <= _STEP * t:
            break
    before = t * (1 - _BEFORE)
    return before if before > low and _value_and_rate(polynomials, rim, before)[0] > least else low


@compiled
def _value_and_rate(polynomials: Array, rim: int, t: float) -> tuple[float, float]:
    """Return the value of the polynomial of a rim, and its derivative."""
    value, rate = 0.0, 0.0
    for k in range(polynomials.shape[1] - 1, -1, -1):
        rate = rate * t + value
        value = value * t + polynomials[rim, k]
    return value, rate
