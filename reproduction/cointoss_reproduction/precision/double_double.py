"""Arithmetic of 106 bits in compiled code: a number is the unevaluated sum of two doubles, (high, low).

T. J. Dekker, Numer. Math. 18, 224 (1971); Y. Hida, X. S. Li, D. H. Bailey, ARITH-15 (2001). Products split
their factors, so none may exceed 1e300. An operation errs by a few parts in 2**104.
"""

import math
from fractions import Fraction

import numpy as np

from cointoss_reproduction.precision.compiled import compiled

Pair = tuple[float, float]
ONE: Pair = (1.0, 0.0)
_SPLITTER = 134217729.0  # 2**27 + 1
_TERMS = 14
_HALVINGS = 3
"""Sine and cosine are summed for an eighth of the angle."""
_HALF_PI = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591833e-33)


def pair_of(number: Fraction | float) -> Pair:
    """Return the pair nearest to an exact number."""
    high = float(number)
    return high, float(Fraction(number) - Fraction(high))


def exact(pair: Pair) -> Fraction:
    """Return the exact number that a pair is."""
    return Fraction(pair[0]) + Fraction(pair[1])


_INVERSE_FACTORIALS = np.array([pair_of(Fraction(1, math.factorial(n))) for n in range(2 * _TERMS + 2)])


@compiled
def _two_sum(a: float, b: float) -> Pair:
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


@compiled
def _quick_two_sum(a: float, b: float) -> Pair:
    s = a + b
    return s, b - (s - a)


@compiled
def _two_product(a: float, b: float) -> Pair:
    p = a * b
    t = _SPLITTER * a
    a_high = t - (t - a)
    a_low = a - a_high
    t = _SPLITTER * b
    b_high = t - (t - b)
    b_low = b - b_high
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


@compiled
def add(a: Pair, b: Pair) -> Pair:
    """Return a + b."""
    s, e = _two_sum(a[0], b[0])
    t, f = _two_sum(a[1], b[1])
    s, e = _quick_two_sum(s, e + t)
    return _quick_two_sum(s, e + f)


@compiled
def subtract(a: Pair, b: Pair) -> Pair:
    """Return a - b."""
    return add(a, (-b[0], -b[1]))


@compiled
def multiply(a: Pair, b: Pair) -> Pair:
    """Return a b."""
    p, e = _two_product(a[0], b[0])
    return _quick_two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))


@compiled
def scale(a: Pair, x: float) -> Pair:
    """Return a x, x a double."""
    p, e = _two_product(a[0], x)
    return _quick_two_sum(p, e + a[1] * x)


@compiled
def negative(a: Pair) -> Pair:
    """Return -a."""
    return -a[0], -a[1]


@compiled
def divide(a: Pair, b: Pair) -> Pair:
    """Return a/b."""
    q = a[0] / b[0]
    rest = subtract(a, scale(b, q))
    q2 = rest[0] / b[0]
    rest = subtract(rest, scale(b, q2))
    high, low = _quick_two_sum(q, q2)
    return add((high, low), (rest[0] / b[0], 0.0))


@compiled
def square_root(a: Pair) -> Pair:
    """Return the square root of a, a >= 0."""
    if a[0] <= 0:
        return 0.0, 0.0
    x = math.sqrt(a[0])
    rest = subtract(a, _two_product(x, x))
    y = _quick_two_sum(x, rest[0] / (2 * x))
    rest = subtract(a, multiply(y, y))
    return add(y, (rest[0] / (2 * x), 0.0))


@compiled
def sine_cosine(a: Pair) -> tuple[Pair, Pair]:
    """Return sine and cosine of an angle of moderate size, both within a few parts in 2**104 of 1."""
    quarter = np.round(a[0] / _HALF_PI[0])
    x = subtract(a, _two_product(quarter, _HALF_PI[0]))
    x = subtract(x, _two_product(quarter, _HALF_PI[1]))
    x = subtract(x, (quarter * _HALF_PI[2], 0.0))
    sine, less = _summed(scale(x, 0.5**_HALVINGS))
    for _ in range(_HALVINGS):
        # With less = 1 - cos: sin 2x = 2 sin x - 2 sin x less, 1 - cos 2x = 2 sin² x.
        less, sine = (
            scale(multiply(sine, sine), 2.0),
            scale(subtract(sine, multiply(sine, less)), 2.0),
        )
    cosine = subtract(ONE, less)
    turn = int(quarter) & 3
    if turn == 0:
        return sine, cosine
    if turn == 1:
        return cosine, negative(sine)
    if turn == 2:
        return negative(sine), negative(cosine)
    return negative(cosine), sine


@compiled
def _series(square: Pair, first: int, last: int) -> Pair:
    """Return the sum of 1/first! - x²/(first + 2)! + x⁴/(first + 4)! - ... up to that of 1/last!."""
    total = _INVERSE_FACTORIALS[last, 0], _INVERSE_FACTORIALS[last, 1]
    for n in range(last - 2, first - 1, -2):
        term = _INVERSE_FACTORIALS[n, 0], _INVERSE_FACTORIALS[n, 1]
        total = subtract(term, multiply(square, total))
    return total


@compiled
def _summed(x: Pair) -> tuple[Pair, Pair]:
    """Return sin x and 1 - cos x of a small angle by their series."""
    square = multiply(x, x)
    sine = subtract(x, multiply(multiply(x, square), _series(square, 3, 2 * _TERMS + 1)))
    return sine, multiply(square, _series(square, 2, 2 * _TERMS))


@compiled
def sine_minus_angle(x: Pair, sine: Pair) -> Pair:
    """Return sin x - x without cancellation; `sine` is sin x."""
    if abs(x[0]) > 0.5:
        return subtract(sine, x)
    square = multiply(x, x)
    return negative(multiply(multiply(x, square), _series(square, 3, 2 * _TERMS + 1)))


@compiled
def cosine_minus_parabola(x: Pair, less: Pair) -> Pair:
    """Return cos x - 1 + x²/2 without cancellation; `less` is 1 - cos x."""
    square = multiply(x, x)
    if abs(x[0]) > 0.5:
        return subtract(scale(square, 0.5), less)
    return multiply(multiply(square, square), _series(square, 4, 2 * _TERMS))
