"""The flight of a planar coin to the first touch, in 106 bits.

Drawn up in the clock s of the slowing spin, dt = ds/(1 - k s), the angle is linear in s, and height and
velocity have power series whose terms follow from three before; in vacuum they end with the second.
The gap of a rim point is height ± sin of the angle. It is searched by steps that cannot pass over a zero,
for its second derivative has a bound: in doubles, and near a zero in 106 bits.
"""

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cointoss.study import Array
from cointoss_reproduction.precision.compiled import compiled
from cointoss_reproduction.precision.double_double import (
    ONE,
    Pair,
    add,
    cosine_minus_parabola,
    multiply,
    negative,
    pair_of,
    scale,
    sine_cosine,
    sine_minus_angle,
    subtract,
)
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_state import DRIFT, FALL, HEIGHT, SPIN, TILT, part, put

ORDER = 60
"""Of the series in air, at most; it ends with terms below `LAST_TERM`."""
LAST_TERM = 1e-34
TURN = 3.0
"""At most this angle is flown on one series in air [rad]."""
NEAR = 1e-11
"""A gap below this part of its terms is computed in 106 bits, until it is ten times that."""
ZERO = 1e-30
"""A gap below this part of its terms is a touch."""
_INVERSES = np.array([pair_of(Fraction(1, n + 1)) for n in range(ORDER + 1)])
_DOUBLINGS = 100
MOST_STEPS, MOST_IN_FULL = 20_000, 1000
"""Of a search in doubles, and in 106 bits; where it takes more the touch is missed, the toss undecided."""
BELOW = -1.0
"""A coin whose centre is below this height has missed its touch: it is all below the floor."""
CAREFUL = 1 - 1e-14
"""A step computed in doubles, times it, is no longer than an exact one."""


class Series(NamedTuple):
    """Room for the series of a flight, (ORDER + 2, 2) each."""

    heights: Array
    """Of C."""
    drifts: Array
    """Of its velocity aside."""


class RimGap(NamedTuple):
    """The gap of one rim point in a flight, pairs."""

    heights: Array
    """The series of the height of C."""
    order: int
    """Of the series."""
    w: Pair
    """Spin at the start."""
    sine: Pair
    """Of the point's angle at the start."""
    cosine: Pair
    first: tuple[Pair, Pair, Pair]
    """Coefficients of 1, s and s²/2 in the gap."""


@compiled
def room_for_series() -> Series:
    """Return the `Series` of a flight, yet to be written."""
    return Series(np.empty((ORDER + 2, 2)), np.empty((ORDER + 2, 2)))


@compiled
def fly(coin: PlanarCoin, state: Array, corner: int, start: float, series: Series) -> int:
    """Fly to the first touch; the state becomes that at the touch, its tilt not reduced.

    Args:
        coin: the coin.
        state: (5, 2).
        corner: rim point that leaves the floor now, 1 or -1; 0 for none, 2 for both.
        start: before this clock nothing touches.
        series: work space.

    Returns:
        Rim point that touches, 1 or -1; 0 if none does.
    """
    for _ in range(100_000):
        length, order = expand(coin, state, series)
        w = part(state, SPIN)
        sine, cosine = sine_cosine(part(state, TILT))
        bounds = _derivative_bounds(series.heights, order, w[0], length)
        touched, best, who = False, (length, 0.0), 0
        for side in (-1, 1):
            sn, cs = scale(sine, float(side)), scale(cosine, float(side))
            on_floor = corner in (side, 2)
            f0 = (0.0, 0.0) if on_floor else add(part(state, HEIGHT), sn)
            f1 = add(part(series.heights, 1), multiply(cs, w))
            f2 = subtract(scale(part(series.heights, 2), 2.0), multiply(sn, multiply(w, w)))
            if on_floor and start > 0:
                f1 = (0.0, 0.0)
            gap = RimGap(series.heights, order, w, sn, cs, (f0, f1, f2))
            touches, s = _first_zero(gap, bounds, start if on_floor else 0.0, best)
            if touches:
                touched, best, who = True, s, side
        _move(coin, state, series, order, best)
        if touched:
            return who
        corner, start = 0, 0.0
        if not coin.in_air or state[HEIGHT, 0] < BELOW:
            return 0
    return 0


@compiled
def expand(coin: PlanarCoin, state: Array, series: Series) -> tuple[float, int]:
    """Write the series of height and of velocity aside.

    Returns:
        The clock up to which they are good, and the order of the height's.
    """
    heights, drifts = series
    heights[0], heights[1] = state[HEIGHT], state[FALL]
    drifts[0] = state[DRIFT]
    w = part(state, SPIN)
    # By then the rim is below the floor, were the air not to hold it up.
    v, z = state[FALL, 0], state[HEIGHT, 0]
    longest = v + math.sqrt(v * v + 2 * max(z, 0.0)) + 1e-3
    if not coin.in_air:
        heights[2, 0], heights[2, 1] = -0.5, 0.0
        drifts[1] = 0.0
        return longest, 2
    length = min(TURN / abs(w[0]), 1.1 * longest) if w[0] != 0 else longest
    length = min(length, 1.0 / (4 * coin.slowing[0] + 1e-9))
    k, a, b = coin.slowing, coin.drag_mean, coin.drag_difference
    sine, cosine = sine_cosine(part(state, TILT))
    # e^(2iθ) and the velocity u = x + i y, and p = e^(2iθ) u*.
    c2 = subtract(multiply(cosine, cosine), multiply(sine, sine))
    s2 = scale(multiply(sine, cosine), 2.0)
    x, y = part(state, DRIFT), part(state, FALL)
    px, py = add(multiply(c2, x), multiply(s2, y)), subtract(multiply(s2, x), multiply(c2, y))
    before_x, before_y = (0.0, 0.0), (0.0, 0.0)
    ex, ey = c2, s2
    z, power = part(state, HEIGHT), 1.0
    w2 = scale(w, 2.0)
    for n in range(ORDER + 1):
        kn = scale(k, float(n))
        z_next = add(multiply(kn, z), y)
        x_next = subtract(multiply(subtract(kn, a), x), multiply(b, px))
        y_next = subtract(multiply(subtract(kn, a), y), multiply(b, py))
        if n == 0:
            y_next = subtract(y_next, ONE)
        gx, gy = subtract(px, multiply(k, before_x)), subtract(py, multiply(k, before_y))
        px_next = subtract(multiply(subtract(kn, a), px), multiply(b, x))
        py_next = subtract(multiply(subtract(kn, a), py), multiply(b, y))
        px_next = subtract(subtract(px_next, multiply(w2, gy)), ey)
        py_next = add(add(py_next, multiply(w2, gx)), ex)
        before_x, before_y = px, py
        over = (_INVERSES[n, 0], _INVERSES[n, 1])
        x, y, z = multiply(x_next, over), multiply(y_next, over), multiply(z_next, over)
        px, py = multiply(px_next, over), multiply(py_next, over)
        ex, ey = negative(multiply(multiply(w2, ey), over)), multiply(multiply(w2, ex), over)
        heights[n + 1, 0], heights[n + 1, 1] = z[0], z[1]
        drifts[n + 1, 0], drifts[n + 1, 1] = x[0], x[1]
        power *= length
        size = (abs(x[0]) + abs(y[0]) + abs(px[0]) + abs(py[0]) + abs(ex[0]) + abs(ey[0])) * power
        if size < LAST_TERM and n > 2:
            return length, n + 1
    return length, ORDER + 1


@compiled
def _derivative_bounds(heights: Array, order: int, w: float, length: float) -> tuple[float, float]:
    """Bound how fast a gap's rate, and its second derivative, can fall."""
    second, third, power = -2 * heights[2, 0], 0.0, 1.0
    for n in range(3, order + 1):
        third += n * (n - 1) * (n - 2) * abs(heights[n, 0]) * power
        power *= length
        second += n * (n - 1) * abs(heights[n, 0]) * power
    return (second + w * w) * (1 + 1e-12), (third + abs(w) ** 3) * (1 + 1e-12) + 1e-30


@compiled
def _first_zero(gap: RimGap, bounds: tuple[float, float], start: float, limit: Pair) -> tuple[bool, Pair]:
    """Return whether the gap has a zero up to the limit, and the first."""
    # Both rim points of a coin that lands flat touch within less than a double tells apart: up to there the
    # search goes in doubles, and on in full.
    s, in_full, edge = start, 0, limit[0] * CAREFUL
    for _ in range(MOST_STEPS):
        height, rate, second, terms = _gap(gap, s)
        if s > 0 and height <= NEAR * terms:
            exact = (s, 0.0)
            while True:
                in_full += 1
                if in_full > MOST_IN_FULL or subtract(exact, limit)[0] >= 0:
                    return False, limit
                height, rate, second, terms = _gap_in_full(gap, exact)
                if height < -ZERO * terms and rate < 0:
                    # Doubles went beyond the zero by their rounding.
                    exact = add(exact, (-height / rate, 0.0))
                    continue
                if height <= ZERO * terms:
                    return True, exact
                if height > 10 * NEAR * terms and rate > 0:
                    break
                exact = add(exact, (safe_step(height, rate, second, bounds) * CAREFUL, 0.0))
            s = exact[0]
        elif s >= edge:
            break
        else:
            s = min(s + safe_step(height, rate, second, bounds) * CAREFUL, edge)
    return False, limit


@compiled
def safe_step(gap: float, rate: float, second: float, bounds: tuple[float, float]) -> float:
    """Return a step within which a gap >= 0 cannot fall below 0.

    Over a step h its second derivative is above -bounds[0], and above second - bounds[1] h.
    """
    best = _parabola_step(gap, rate, bounds[0])
    reach = max(best, second / bounds[1])
    for _ in range(_DOUBLINGS):
        falls = bounds[1] * reach - second
        step = min(_parabola_step(gap, rate, max(falls, 0.0)), reach)
        if falls >= bounds[0] or step < best:
            break
        best, reach = step, 2 * reach
    return best


@compiled
def _parabola_step(gap: float, rate: float, falls: float) -> float:
    """Return the zero of gap + rate h - falls h²/2, infinite where it has none."""
    root = math.sqrt(rate * rate + 2 * falls * gap)
    if rate < 0:
        return 2 * gap / (root - rate)
    return (rate + root) / falls if falls > 0 else np.inf


@compiled
def _gap(gap: RimGap, s: float) -> tuple[float, float, float, float]:
    """Return the gap, its first two derivatives, and the size of its terms; good for small s, too."""
    heights, w, sn, cs = gap.heights, gap.w[0], gap.sine[0], gap.cosine[0]
    f = (gap.first[0][0], gap.first[1][0], gap.first[2][0])
    p, dp, ddp = 0.0, 0.0, 0.0
    for n in range(gap.order, 2, -1):
        ddp = ddp * s + n * (n - 1) * heights[n, 0]
        dp = dp * s + n * heights[n, 0]
        p = p * s + heights[n, 0]
    p, dp, ddp = p * s**3, dp * s**2, ddp * s
    angle = w * s
    half = math.sin(angle / 2)
    less, sine = 2 * half * half, math.sin(angle)
    q, r = cs * _sine_minus(angle, sine), sn * _cosine_minus(angle, less)
    rate = f[1] + f[2] * s + dp + w * (sn * (angle - sine) - cs * less)
    second = f[2] + ddp + w * w * (sn * less - cs * sine)
    linear, square = f[1] * s, f[2] * s * s / 2
    terms = abs(f[0]) + abs(linear) + abs(square) + abs(p) + abs(q) + abs(r)
    return f[0] + linear + square + p + q + r, rate, second, terms


@compiled
def _sine_minus(angle: float, sine: float) -> float:
    """Return sin x - x."""
    if abs(angle) > 0.5:
        return sine - angle
    square, total = angle * angle, 1.0
    for n in range(8, 1, -1):
        total = 1 - total * square / (2 * n * (2 * n + 1))
    return -angle * square / 6 * total


@compiled
def _cosine_minus(angle: float, less: float) -> float:
    """Return cos x - 1 + x²/2; `less` is 1 - cos x."""
    square = angle * angle
    if abs(angle) > 0.5:
        return square / 2 - less
    total = 1.0
    for n in range(8, 2, -1):
        total = 1 - total * square / (2 * n * (2 * n - 1))
    return square * square / 24 * total


@compiled
def _gap_in_full(gap: RimGap, s: Pair) -> tuple[float, float, float, float]:
    """Return the same in 106 bits, rounded at the end."""
    heights, order, w, sn, cs, f = gap
    p, dp, ddp = (0.0, 0.0), 0.0, 0.0
    for n in range(order, 2, -1):
        ddp = ddp * s[0] + n * (n - 1) * heights[n, 0]
        dp = dp * s[0] + n * heights[n, 0]
        p = add(multiply(p, s), part(heights, n))
    p, dp, ddp = multiply(multiply(multiply(p, s), s), s), dp * s[0] ** 2, ddp * s[0]
    angle = multiply(w, s)
    half_sine, half_cosine = sine_cosine(scale(angle, 0.5))
    less = scale(multiply(half_sine, half_sine), 2.0)
    sine = scale(multiply(half_sine, half_cosine), 2.0)
    turned = sine_minus_angle(angle, sine)
    q, r = multiply(cs, turned), multiply(sn, cosine_minus_parabola(angle, less))
    linear, square = multiply(f[1], s), scale(multiply(f[2], multiply(s, s)), 0.5)
    height = add(add(f[0], linear), add(square, add(p, add(q, r))))
    rate = f[1][0] + f[2][0] * s[0] + dp - w[0] * (sn[0] * turned[0] + cs[0] * less[0])
    second = f[2][0] + ddp + w[0] * w[0] * (sn[0] * less[0] - cs[0] * sine[0])
    terms = abs(f[0][0]) + abs(linear[0]) + abs(square[0]) + abs(p[0]) + abs(q[0]) + abs(r[0])
    return height[0], rate, second, terms


@compiled
def _move(coin: PlanarCoin, state: Array, series: Series, order: int, s: Pair) -> None:
    """Change the state to that at the clock s of its series."""
    z, y, x = (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)
    for n in range(order, -1, -1):
        if n > 0:
            y = add(multiply(y, s), scale(part(series.heights, n), float(n)))
        z = add(multiply(z, s), part(series.heights, n))
    for n in range(order - 1, -1, -1):
        x = add(multiply(x, s), part(series.drifts, n))
    left = subtract(ONE, multiply(coin.slowing, s))
    w = part(state, SPIN)
    put(state, HEIGHT, z)
    put(state, FALL, multiply(left, y))  # dz/dt = (1 - k s) dz/ds
    put(state, DRIFT, x)
    put(state, TILT, add(part(state, TILT), multiply(w, s)))
    put(state, SPIN, multiply(left, w))
