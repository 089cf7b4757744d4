"""What ends the toss of a planar coin before its face is settled."""

from fractions import Fraction
from typing import NamedTuple

from cointoss import EndingTest, Scenario
from cointoss_reproduction.precision.planar_coin import square_root, units


class PlanarEnding(NamedTuple):
    """The criteria of a scenario in units of the coin, r and √(r/g)."""

    caught: Fraction | None = None
    """Height at which C is caught as it comes down."""
    max_time: Fraction | None = None
    max_impacts: int | None = None
    """The face is settled by these, and not by bounces without number that come to lasting contact."""
    counts_drift: bool = True
    """Whether the energy of horizontal motion counts against the barrier."""


def planar_ending(scenario: Scenario) -> PlanarEnding:
    """Return how a scenario's toss ends.

    Raises:
        ValueError: where a settled face does not end it.
    """
    ending, (length, gravity) = scenario.ending, units(scenario)
    if ending.test == EndingTest.LYING:
        accepted = ", ".join(str(test) for test in EndingTest if test != EndingTest.LYING)
        raise ValueError(f"ending.test: {ending.test}, accepted: {accepted}")
    return PlanarEnding(
        caught=None if ending.caught is None else Fraction(ending.caught) / length,
        max_time=Fraction(ending.max_time) / square_root(length / gravity),
        max_impacts=ending.max_impacts,
        counts_drift=ending.test != EndingTest.PAPER_SMOOTH,
    )
