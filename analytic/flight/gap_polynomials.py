"""How long a flight given by power series surely stays clear of the floor: the gap's sign as a polynomial.

The rim of the face at ζ = ±h/2, whose centre is at height q, is clear while F = q² - r² (u_ξ² + u_η²) > 0. q
and u are polynomials of time, and so is F. It is positive where all its Bernstein coefficients are: they
enclose its graph.
"""

import numpy as np

from analytic.flight.power_series import HEIGHT, ORDER, UP
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled

DEGREE = 2 * ORDER
# Rounding of F, against q² + r².
_ROUNDING = 4e-16
# A time to be shown clear is tried, then a third of it, and so on.
_SHORTER, _TRIES = 1 / 3, 8


@compiled
def gap_polynomials(body, series, order, length, polynomials):
    """Write F of tails' and of heads' rim as polynomials of the time since the start of a step.

    Args:
        body: the coin.
        series: of the flight, see `power_series.expand_flight`.
        order: of the series.
        length: of the step [s].
        polynomials: where the coefficients go, (2, DEGREE + 1).

    Returns:
        By how much rounding changes them at most [m²].
    """
    q, c, largest = np.empty(order + 1), body.center, 0.0
    for rim in range(2):
        zeta = (rim - 0.5) * body.thickness - c[2]
        reach, power = 0.0, 1.0
        for k in range(order + 1):
            q[k] = series[k, HEIGHT] - c[0] * series[k, UP] - c[1] * series[k, UP + 1]
            q[k] += zeta * series[k, UP + 2]
            reach += abs(q[k]) * power
            power *= length
        largest = max(largest, reach)
        for k in range(2 * order + 1):
            F = 0.0
            for j in range(max(0, k - order), min(k, order) + 1):
                tilt = series[j, UP] * series[k - j, UP] + series[j, UP + 1] * series[k - j, UP + 1]
                F += q[j] * q[k - j] - body.radius * body.radius * tilt
            polynomials[rim, k] = F
    return _ROUNDING * (largest * largest + body.radius * body.radius)


@compiled
def time_surely_clear(body, polynomials, degree, above, inside, window, least):
    """Return a time from `inside` on during which a coin above the floor surely stays there.

    Args:
        body: the coin.
        polynomials: see `gap_polynomials`.
        degree: of them.
        above: what they must exceed: their error, or less by what the coin may sink [m²].
        inside: time since the start of the step [s].
        window: the longest time of interest [s].
        least: shorter times are of no use [s].

    Returns:
        The time, 0 where none of use is found [s].
    """
    shifted, bernstein = np.empty((2, degree + 1)), np.empty(degree + 1)
    rims = 2 if body.thickness > 0 else 1
    for rim in range(rims):
        copy_into(shifted[rim], polynomials[rim])
        for i in range(degree):
            for k in range(degree - 1, i - 1, -1):
                shifted[rim, k] += inside * shifted[rim, k + 1]
    time = window
    for _ in range(_TRIES):
        if time < least:
            break
        positive = True
        for rim in range(rims):
            positive = positive and _is_above(shifted[rim], time, above, bernstein)
        if positive:
            return time
        time *= _SHORTER
    return 0.0


@compiled
def _is_above(polynomial, length, least, bernstein):
    """Return whether a polynomial surely exceeds `least` from 0 to `length`; `bernstein` is work space."""
    degree, scale = len(polynomial) - 1, 1.0
    for k in range(degree + 1):
        bernstein[k] = polynomial[k] * scale
        # The next power of the length, over the next binomial coefficient.
        scale *= length * (k + 1) / max(degree - k, 1)
    for i in range(1, degree + 1):
        for k in range(degree, i - 1, -1):
            bernstein[k] += bernstein[k - 1]
    above = True
    for k in range(degree + 1):
        above = above and bernstein[k] > least
    return above
