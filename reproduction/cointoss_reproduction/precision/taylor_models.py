"""Taylor models: numbers of a toss as functions of a component of its release, enclosed for all of a range.

With p in [-1, 1] across the releases, a number x(p) is kept as the coefficients of its series about p = 0 and
about every p at once. Taylor's theorem with the remainder of the last order joins them: a plain enclosure for
all p would grow at every step by what it forgets, that all numbers belong to one release. (Makino & Berz,
Taylor models and other validated functional inclusion methods, 2003.)
"""

import operator
from collections.abc import Callable
from math import comb
from typing import Any

from flint import arb, arb_series

ORDER = 2
"""Of the remainder; of more orders the toss of a margin has no use, as its touches change places first."""
ACROSS = arb(0, 1)
"""All p."""


class UndecidedError(Exception):
    """An enclosure is too wide."""


class TaylorModel:
    """A number x(p)."""

    def __init__(self, middle: Any, whole: Any) -> None:
        """Keep the coefficients about p = 0, and enclosures of those about every p."""
        self.middle, self.whole = middle, whole

    def __add__(self, other: Any) -> "TaylorModel":
        """Return x + y."""
        return _both(operator.add, self, other)

    __radd__ = __add__

    def __sub__(self, other: Any) -> "TaylorModel":
        """Return x - y."""
        return _both(operator.sub, self, other)

    def __rsub__(self, other: Any) -> "TaylorModel":
        """Return y - x."""
        return _both(operator.sub, other, self)

    def __mul__(self, other: Any) -> "TaylorModel":
        """Return x y."""
        return _both(operator.mul, self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> "TaylorModel":
        """Return x/y."""
        _check_divisor(other)
        return _both(operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> "TaylorModel":
        """Return y/x."""
        _check_divisor(self)
        return _both(operator.truediv, other, self)

    def __pow__(self, power: int) -> "TaylorModel":
        """Return x^n."""
        return TaylorModel(self.middle**power, self.whole**power)

    def __neg__(self) -> "TaylorModel":
        """Return -x."""
        return TaylorModel(-self.middle, -self.whole)

    def __abs__(self) -> "TaylorModel":
        """Return |x|; where its sign changes only its enclosure."""
        if self > 0:
            return self
        return -self if self < 0 else constant(abs(self.whole[0]))

    def sin(self) -> "TaylorModel":
        """Return sin x."""
        return TaylorModel(self.middle.sin(), self.whole.sin())

    def cos(self) -> "TaylorModel":
        """Return cos x."""
        return TaylorModel(self.middle.cos(), self.whole.cos())

    def sin_cos(self) -> tuple["TaylorModel", "TaylorModel"]:
        """Return sin x and cos x."""
        (sine, cosine), (all_sine, all_cosine) = self.middle.sin_cos(), self.whole.sin_cos()
        return TaylorModel(sine, all_sine), TaylorModel(cosine, all_cosine)

    def sqrt(self) -> "TaylorModel":
        """Return the square root."""
        return TaylorModel(self.middle.sqrt(), self.whole.sqrt())

    def asin(self) -> "TaylorModel":
        """Return the inverse sine."""
        return TaylorModel(self.middle.asin(), self.whole.asin())

    def mid(self) -> Any:
        """Return the middle of all values."""
        return self.whole[0].mid()

    def upper(self) -> Any:
        """Return an upper bound of all values."""
        return self.whole[0].upper()

    def lower(self) -> Any:
        """Return a lower bound of all values."""
        return self.whole[0].lower()

    def __lt__(self, other: Any) -> bool:
        """Return whether x < y for all p."""
        return (self - other).tightened().whole[0] < 0

    def __gt__(self, other: Any) -> bool:
        """Return whether x > y for all p."""
        return (self - other).tightened().whole[0] > 0

    def tightened(self) -> "TaylorModel":
        """Return the number, its coefficients about every p no wider than Taylor's theorem leaves them."""
        found = []
        for k in range(ORDER + 1):
            known = [comb(k + j, k) * self.middle[k + j] for j in range(ORDER - k)]
            total = comb(ORDER, k) * self.whole[ORDER]
            for c in reversed(known):
                total = total * ACROSS + c
            found.append(_common(self.whole[k], total))
        return TaylorModel(self.middle, arb_series(found))


def varying(middle: Any, change: Any) -> TaylorModel:
    """Return middle + change p."""
    return TaylorModel(arb_series([middle, change]), arb_series([middle + change * ACROSS, change]))


def constant(x: Any) -> TaylorModel:
    """Return a number, or noise, within an enclosure for every p."""
    return TaylorModel(arb_series([x]), arb_series([x]))


def whole(x: Any) -> Any:
    """Return an enclosure of a number for all p."""
    return x.whole[0] if isinstance(x, TaylorModel) else x


def middle(x: Any) -> Any:
    """Return an enclosure of a number at p = 0."""
    return x.middle[0] if isinstance(x, TaylorModel) else x


def zero(
    f: Callable[[TaylorModel], tuple[TaylorModel, TaylorModel]], at_middle: Any, for_all: Any
) -> TaylorModel:
    """Return the number x(p) that makes a function of p and x zero.

    Args:
        f: gives the function and its derivative by x.
        at_middle: an enclosure of x(0).
        for_all: of x(p) for all p.
    """
    middle, whole = [at_middle], [for_all]
    for k in range(1, ORDER + 1):
        value, rate = f(TaylorModel(arb_series(middle), arb_series(whole)))
        middle.append(-value.middle[k] / rate.middle[0])
        whole.append(-value.whole[k] / rate.whole[0])
    return TaylorModel(arb_series(middle), arb_series(whole)).tightened()


def _both(op: Callable[[Any, Any], Any], x: Any, y: Any) -> TaylorModel:
    return TaylorModel(
        op(*(n.middle if isinstance(n, TaylorModel) else n for n in (x, y))),
        op(*(n.whole if isinstance(n, TaylorModel) else n for n in (x, y))),
    )


def _check_divisor(x: Any) -> None:
    """Refuse to divide by a number that may be 0."""
    if not (whole(x) > 0 or whole(x) < 0):
        raise UndecidedError


def _common(one: Any, other: Any) -> Any:
    """Return what two enclosures of a number have in common; the first where one is not finite."""
    if not other.is_finite():
        return one
    return one.intersection(other) if one.is_finite() else other
