"""Planar tosses whose face is proved, one toss or all tosses near it, or which are undecided.

More bits decide what is undecided, but for tosses on a boundary.
"""

from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_ending import PlanarEnding
from cointoss_reproduction.precision.planar_state import Impact, in_own_units, precision, released
from cointoss_reproduction.precision.planar_toss import UNTIL_SETTLED, PlanarToss
from cointoss_reproduction.precision.taylor_models import ORDER, UndecidedError, varying

LEAST = Fraction(1, 2**40)
"""The least part of a change that is tried."""


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
    ending: PlanarEnding = UNTIL_SETTLED,
) -> Certified:
    """Toss a planar coin with more and more bits until its face is proved.

    Args:
        coin: the coin.
        units: of it.
        release: heads up.
        bits: to begin with; doubled while the toss is undecided.
        most_bits: where that ends.
        ending: of a toss in vacuum, what ends it before its face is settled.

    Raises:
        ValueError: for an ending in air.
    """
    if ending != UNTIL_SETTLED:
        _require_vacuum(coin)
    while True:
        with precision(bits, ORDER + 1):
            toss = _toss(coin, in_own_units(units, release), ending)
        if toss.outcome != Outcome.UNDECIDED or 2 * bits > most_bits:
            return toss
        bits *= 2


def outcome_within(
    coin: PlanarCoin,
    units: Units,
    *,
    release: PlanarRelease,
    change: PlanarRelease,
    bits: int = 200,
    ending: PlanarEnding = UNTIL_SETTLED,
) -> Outcome:
    """Return the outcome that all releases up to a change away, to both sides, are proved to have.

    Args:
        coin: in vacuum.
        units: of it.
        release: the one in their middle.
        change: the largest; the releases differ from the middle by this change times -1 to 1.
        bits: of the proof.
        ending: what ends a toss before its face is settled.

    Returns:
        Heads or tails; undecided where they differ, or where that is not proved.

    Raises:
        ValueError: of a coin in air.
    """
    _require_vacuum(coin)
    with precision(bits, ORDER + 1):
        middles, changes = (in_own_units(units, numbers) for numbers in (release, change))
        return _toss(coin, [*map(varying, middles, changes)], ending).outcome


def proved_part(
    coin: PlanarCoin,
    units: Units,
    *,
    release: PlanarRelease,
    change: PlanarRelease,
    ending: PlanarEnding = UNTIL_SETTLED,
) -> Fraction:
    """Return the largest 1, 1/2, 1/4, ... of a change within which the outcome is proved to be the same.

    Args:
        coin: in vacuum.
        units: of it.
        release: of the toss.
        change: to both sides of it.
        ending: what ends a toss before its face is settled.

    Returns:
        The part; 0 where the outcome of the toss is not proved, or that of its neighbours within `LEAST`.

    Raises:
        ValueError: of a coin in air.
    """
    _require_vacuum(coin)
    toss = certified_toss(coin, units, release, ending=ending)
    part = Fraction(1)
    while toss.outcome != Outcome.UNDECIDED and part >= LEAST:
        within = PlanarRelease(*(part * x for x in change))
        found = outcome_within(coin, units, release=release, change=within, bits=toss.bits, ending=ending)
        if found == toss.outcome:
            return part
        part /= 2
    return Fraction(0)


def _require_vacuum(coin: PlanarCoin) -> None:
    if coin.in_air:
        raise ValueError("air: releases about another one are enclosed in vacuum only")


def _toss(coin: PlanarCoin, release: list[Any], ending: PlanarEnding) -> Certified:
    """Toss a coin whose height, spin and tilt are enclosures, or vary."""
    toss, outcome = PlanarToss(coin, ending), Outcome.UNDECIDED
    with suppress(UndecidedError):
        outcome = toss.run(released(*release))
    return Certified(outcome=outcome, impacts=tuple(toss.impacts), energy=toss.last_energy, bits=toss.bits)
