"""Cosines and sines of parts of a turn, rounded correctly: the same numbers on every machine."""

from decimal import Context, Decimal, localcontext

import numpy as np

from cointoss.models.kernel.arrays import Array

EXACT = Context(prec=50)
"""Digits with which numbers are computed that are rounded to a float once."""
_PI = Decimal("3.14159265358979323846264338327950288419716939937510")


def on_circle(n: int, count: int) -> tuple[Array, Array]:
    """Return the cosines and the sines of i/n of a turn, i = 0 ... count - 1, (count,) each.

    numpy's depend on the processor, and Python's on the system.
    """
    with localcontext(EXACT):
        angle = 2 * _PI / n
        cosine, sine, term, k = Decimal(0), Decimal(0), Decimal(1), 0
        while abs(term) > Decimal("1e-50"):
            cosine, sine = (cosine + term, sine) if k % 2 == 0 else (cosine, sine + term)
            k += 1
            term *= angle / k if k % 2 else -angle / k
        points, c, s = [], Decimal(1), Decimal(0)
        for _ in range(count):
            points.append((float(round(c, 40)), float(round(s, 40))))
            c, s = c * cosine - s * sine, c * sine + s * cosine
    found = np.array(points) + 0.0  # no negative zeros
    return found[:, 0].copy(), found[:, 1].copy()
