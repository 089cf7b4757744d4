"""Roots in a bracket, by Chandrupatla's method (Adv. Eng. Softw. 28 (1997) 145).

The caller tries `next_try(bracket)`, tells the value there to `narrowed`, and goes on until the bracket is
narrow: so the function may be a step of an integrator, which writes a state beside its value.
"""

from typing import NamedTuple

from cointoss.models.kernel.compiled import compiled


class Bracket(NamedTuple):
    """Two places between which a function falls through zero, and where to try next."""

    low: float
    """The last place found at which it is positive."""
    high: float
    """The last at which it is not."""
    new: float
    """The end of the bracket tried last."""
    new_value: float
    old: float
    """The other end."""
    old_value: float
    share: float
    """The part of the way from `new` to `old` at which to try next."""


@compiled
def bracket_between(low: float, low_value: float, high: float, high_value: float) -> Bracket:
    """Return the `Bracket` of a function that is positive at `low` and not at `high`."""
    return Bracket(low, high, high, high_value, low, low_value, 0.5)


@compiled
def next_try(bracket: Bracket) -> float:
    """Return the place to try next."""
    return bracket.new + bracket.share * (bracket.old - bracket.new)


@compiled
def is_narrow(bracket: Bracket, tolerance: float) -> bool:
    """Return whether the bracket is at most twice as wide as the tolerance."""
    return tolerance > 0.5 * (bracket.high - bracket.low)


@compiled
def narrowed(bracket: Bracket, tried: float, value: float, tolerance: float) -> Bracket:
    """Return the bracket narrowed by the value at the place tried; the next is inside by the tolerance."""
    low, high = (tried, bracket.high) if value > 0 else (bracket.low, tried)
    # Of the three last places `tried` and `old` bracket the root.
    if (value > 0) == (bracket.new_value > 0):
        third, third_value, old, old_value = bracket.new, bracket.new_value, bracket.old, bracket.old_value
    else:
        third, third_value, old, old_value = bracket.old, bracket.old_value, bracket.new, bracket.new_value
    least = tolerance / (high - low)
    share = min(max(_zero_between(tried, value, old, old_value, third, third_value), least), 1 - least)
    return Bracket(low, high, tried, value, old, old_value, share)


@compiled
def _zero_between(x_1: float, f_1: float, x_2: float, f_2: float, x_3: float, f_3: float) -> float:
    """Return the part of the way from x_1 to x_2 where the inverse parabola through all three passes zero.

    A half where that parabola would not be one-valued between them.
    """
    place, height = (x_1 - x_2) / (x_3 - x_2), (f_1 - f_2) / (f_3 - f_2)
    if not (height * height < place and (1 - height) * (1 - height) < 1 - place):
        return 0.5
    return f_1 / (f_2 - f_1) * f_3 / (f_2 - f_3) + (x_3 - x_1) / (x_2 - x_1) * f_1 / (f_3 - f_1) * f_2 / (
        f_3 - f_2
    )
