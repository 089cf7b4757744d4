"""Taylor models: numbers of a toss as functions of a component of its release, enclosed for all of a range.

With p in [-1, 1] across the releases, a number x(p) is kept as the coefficients of its series about p = 0 and
about every p at once. Taylor's theorem with the remainder of the last order joins them: a plain enclosure for
all p would grow at every step by what it forgets, that all numbers belong to one release. (Makino & Berz,
Taylor models and other validated functional inclusion methods, 2003.)
"""

import operator
from collections.abc import Callable
from functools import reduce
from math import comb
from typing import Any

from flint import arb, arb_series

ORDER = 2
"""The order of the remainder; a higher one would not help margins, because touches change their order
first."""
ACROSS = arb(0, 1)
"""The enclosure of all p."""


class UndecidedError(Exception):
    """An enclosure is too wide."""


def _of_one(name: str) -> Callable[["TaylorModel"], "TaylorModel"]:
    """Return a function of one number by the name of its method of a series."""
    call = operator.methodcaller(name)
    return lambda x: TaylorModel(call(x.middle), call(x.whole))


def _of_two(op: Callable[[Any, Any], Any]) -> Callable[["TaylorModel", Any], "TaylorModel"]:
    """Return an operation on two numbers, the other of which may be an enclosure."""
    return lambda x, y: TaylorModel(
        op(_part(x, "middle"), _part(y, "middle")), op(_part(x, "whole"), _part(y, "whole"))
    )


def _of_all(name: str) -> Callable[["TaylorModel"], Any]:
    """Return a function of the enclosure of a number for all p by the name of its method."""
    call = operator.methodcaller(name)
    return lambda x: call(x.whole[0])


def _quotient(x: Any, y: Any) -> "TaylorModel":
    """Return x/y, unless y may be 0."""
    if not (whole(y) > 0 or whole(y) < 0):
        raise UndecidedError
    return _of_two(operator.truediv)(x, y)


class TaylorModel:
    """A number x(p)."""

    def __init__(self, middle: Any, whole: Any) -> None:
        """Keep the coefficients about p = 0, and enclosures of those about every p."""
        self.middle, self.whole = middle, whole

    __add__ = __radd__ = _of_two(operator.add)
    __sub__ = _of_two(operator.sub)
    __rsub__ = _of_two(lambda x, y: y - x)
    __mul__ = __rmul__ = _of_two(operator.mul)
    __truediv__ = _quotient
    __pow__ = _of_two(operator.pow)
    __neg__, sin, cos, sqrt, asin = map(_of_one, ("__neg__", "sin", "cos", "sqrt", "asin"))

    def __rtruediv__(self, other: Any) -> "TaylorModel":
        """Return y/x."""
        return _quotient(other, self)

    def __abs__(self) -> "TaylorModel":
        """Return |x|; where its sign changes only its enclosure."""
        if self > 0:
            return self
        return -self if self < 0 else constant(abs(self.whole[0]))

    def sin_cos(self) -> tuple["TaylorModel", "TaylorModel"]:
        """Return sin x and cos x."""
        return self.sin(), self.cos()

    mid, upper, lower = map(_of_all, ("mid", "upper", "lower"))

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
            last = comb(ORDER, k) * self.whole[ORDER]
            total = reduce(lambda total, c: total * ACROSS + c, reversed(known), last)
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


def _part(x: Any, name: str) -> Any:
    """Return the series of a number, about its middle or about every p."""
    return getattr(x, name) if isinstance(x, TaylorModel) else x


def _common(one: Any, other: Any) -> Any:
    """Return what two enclosures of a number have in common; the first where one is not finite."""
    if not other.is_finite():
        return one
    return one.intersection(other) if one.is_finite() else other
