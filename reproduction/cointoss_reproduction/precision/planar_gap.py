"""The gap between a planar coin's rim point and the floor in a flight, and its first zero, enclosed."""

import math
from collections.abc import Sequence
from typing import Any

from flint import arb, arb_poly, ctx

from cointoss_reproduction.precision.planar_state import UndecidedError

MOST_STEPS = 20_000
"""The most steps of the search for a touch."""
NEAR = 1e-9
"""Below this gap, plus its uncertainty, a zero is enclosed from the rate at which the gap falls."""
TINY = 2.0**-43
"""For an angle below this the first term of the series is used [rad]."""
NEWTON_STEPS = 12
"""The most Newton steps for the middle of an enclosure."""
_DOUBLINGS = 100


def polynomial(coefficients: Sequence[Any], s: Any) -> Any:
    """Return a polynomial's value, lowest coefficient first."""
    return arb_poly(coefficients)(s)


def slopes(coefficients: Sequence[Any]) -> list[Any]:
    """Return the coefficients of a polynomial's derivative, lowest first."""
    return [n * c for n, c in enumerate(coefficients)][1:]


class Gap:
    """The gap of a rim point over the clock of a flight."""

    def __init__(
        self,
        heights: list[Any],
        tail: Any,
        tilt: Any,
        w: Any,
        corners: tuple[int, ...],
        start: Any,
        side: int,
    ) -> None:
        """Take a flight, the rim points that it starts from, and one of them.

        Args:
            heights: of the coin's centre, a series in the clock.
            tail: what the series leaves out.
            tilt: at the start.
            w: the spin there.
            corners: the rim points that are on the floor there.
            start: the clock before which none of these touches again; None where that is not known.
            side: 1 or -1, the rim point.
        """
        sine, cosine = tilt.sin_cos()
        self.sn, self.cs, self.w = side * sine, side * cosine, w
        self.f0 = arb(0) if side in corners else heights[0] + self.sn
        self.f1 = heights[1] + self.cs * self.w
        self.start = 0.0
        if side in corners and start is not None:
            self.f1, self.start = arb(0), float(start.lower()) * (1 - 1e-9)
        self.rest, self.tail = [arb(0), arb(0), *heights[2:]], tail
        self.slopes = slopes(self.rest)
        self.bends = slopes(self.slopes)

    def at(self, s: Any) -> tuple[Any, Any]:
        """Return the gap and its rate."""
        angle = self.w * s
        half = (angle / 2).sin()
        less, sine = 2 * half**2, angle.sin()
        f = self.f0 + self.f1 * s + polynomial(self.rest, s) + self.tail
        turned = sine - angle
        if abs(angle) < TINY:
            # Without cancellation: between -x³/6 and -x³/6 (1 - x²/20).
            turned = -(angle**3) / 6 * (1 - angle**2 * arb(0.025, 0.025))
        f = f + self.cs * turned - self.sn * less
        rate = self.f1 + polynomial(self.slopes, s) + self.tail * len(self.rest) * 4
        return f, rate - self.w * (self.sn * sine + self.cs * less)

    def bend(self, s: Any) -> Any:
        """Return the gap's second derivative."""
        sine, cosine = (self.w * s).sin_cos()
        tail = self.tail * len(self.rest) ** 2 * 16
        return polynomial(self.bends, s) + tail - self.w**2 * (self.sn * cosine + self.cs * sine)

    def bounds(self, length: float) -> tuple[float, float]:
        """Bound how fast the rate and the second derivative fall, up to a clock."""
        rising = [arb(0), *(abs(c) for c in self.bends[1:])]
        tail = abs(self.tail) * len(self.rest) ** 3 * 64 / min(length, 1.0) ** 3
        second = polynomial(rising, arb(length)) - self.bends[0] + self.w**2 + tail
        third = polynomial(slopes(rising), arb(length)) + abs(self.w) ** 3 + tail
        return float(second.upper()) * (1 + 1e-12), float(third.upper()) * (1 + 1e-12)

    def first_zero(self, limit: float) -> Any:
        """Return an enclosure of the first zero up to the limit; None where there is proved to be none."""
        bounds = self.bounds(limit)
        s = arb(self.start)
        for _ in range(MOST_STEPS):
            if s > limit:
                return None
            f, rate = self.at(s)
            low, slope = float(f.lower()), float(rate.lower())
            if s > 0 and f.mid() < NEAR + 2 * f.rad() and rate < 0 and (root := self.enclosed(s)) is not None:
                return root
            if s == 0 and self.f0 == 0:
                low = 0.0
            elif not f > 0:
                raise UndecidedError
            step = safe_step(low, slope, float(self.bend(s).lower()), bounds) * (1 - 1e-12)
            if not step > 0:
                raise UndecidedError
            s = (s + arb(step)).mid()
        raise UndecidedError

    def enclosed(self, s: Any) -> Any:
        """Enclose a zero after s, up to which the gap falls; None where that is not proved."""
        x, (f, rate) = s, self.at(s)
        for _ in range(NEWTON_STEPS):
            if 8 * abs(f.mid()) < f.rad():
                break
            x = (x - f.mid() / rate.mid()).mid()
            f, rate = self.at(x)
        wide = 4 * abs(f).upper() / abs(rate).lower() + arb(2) ** (-2 * ctx.prec)
        low, high = (x - wide).lower(), (x + wide).upper()
        whole = s.union(high)
        f_low, f_high = self.at(low)[0], self.at(high)[0]
        if self.at(whole)[1] < 0 and f_low > 0 and f_high < 0:
            return low.union(high)
        return None


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


def _parabola_step(gap: float, rate: float, falls: float) -> float:
    """Return the zero of gap + rate h - falls h²/2, infinite where it has none."""
    root = math.sqrt(rate * rate + 2 * falls * gap)
    if rate < 0:
        return 2 * gap / (root - rate)
    return (rate + root) / falls if falls > 0 else math.inf
