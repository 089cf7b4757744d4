"""Planar tosses whose face is proved, or which are undecided.

More bits decide what is undecided, but for tosses on a boundary.
"""

from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_state import (
    Impact,
    UndecidedError,
    in_own_units,
    precision,
    released,
)
from cointoss_reproduction.precision.planar_toss import PlanarToss


@dataclass(frozen=True, kw_only=True)
class Certified:
    """What is proved of a toss."""

    outcome: Outcome
    """Heads or tails, proved; else undecided."""
    impacts: tuple[Impact, ...]
    """The impacts that are proved to happen, in this order."""
    energy: Any
    """An enclosure of the energy with which it was settled [m g r]; see `planar_toss.PlanarToss`."""
    bits: int


def certified_toss(
    coin: PlanarCoin,
    units: Units,
    release: PlanarRelease,
    *,
    bits: int = 200,
    most_bits: int = 1600,
) -> Certified:
    """Toss a planar coin with more and more bits until its face is proved.

    Args:
        coin: the coin.
        units: of it.
        release: heads up.
        bits: to begin with; doubled while the toss is undecided.
        most_bits: where that ends.
    """
    while True:
        with precision(bits):
            toss, outcome = PlanarToss(coin), Outcome.UNDECIDED
            with suppress(UndecidedError):
                outcome = toss.run(released(*in_own_units(units, release)))
        if outcome != Outcome.UNDECIDED or 2 * bits > most_bits:
            return Certified(outcome=outcome, impacts=tuple(toss.impacts), energy=toss.last_energy, bits=bits)
        bits *= 2
