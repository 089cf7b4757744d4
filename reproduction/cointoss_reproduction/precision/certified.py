"""A planar toss in interval arithmetic of any length: its face is proved, or the toss is undecided.

python-flint's `arb` encloses every number. The first touch of a flight is proved to be the first: a bound on
the gap's second derivative keeps the gap positive from each point to the next. A toss is undecided where
an enclosure holds both signs of what decides; more bits then decide, but for tosses on a boundary.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from flint import arb, ctx

from cointoss import Outcome
from cointoss_reproduction.precision.enclosed_toss import Enclosed, EnclosedState, EnclosedToss, ball
from cointoss_reproduction.precision.planar_coin import PlanarCoin, Units, square_root
from cointoss_reproduction.precision.planar_ending import PlanarEnding
from cointoss_reproduction.precision.taylor_models import ORDER, UndecidedError, varying

LEAST = Fraction(1, 2**40)
"""Part of a change that is still tried."""


UNTIL_SETTLED = PlanarEnding()


class PlanarRelease(NamedTuple):
    """A release, or how far one is from another."""

    height: Fraction = Fraction(0)
    """[m]."""
    spin: Fraction = Fraction(0)
    """[rad/s]."""
    tilt: Fraction = Fraction(0)
    """[rad]."""


@dataclass(frozen=True, kw_only=True)
class Certified:
    """What is proved of a toss."""

    outcome: Outcome
    """Heads or tails, proved; else undecided."""
    impacts: tuple[Enclosed, ...]
    """Those that are proved to happen, in this order."""
    energy: Any
    """An enclosure of the energy with which it was settled [m g r]; see `planar_toss.PlanarOutcomes`."""
    bits: int


def certified_toss(
    coin: PlanarCoin,
    units: Units,
    *,
    height: Fraction | float,
    spin: Fraction | float,
    tilt: Fraction | float = 0.0,
    bits: int = 200,
    most_bits: int = 1600,
    ending: PlanarEnding = UNTIL_SETTLED,
) -> Certified:
    """Toss a planar coin with more and more bits until its face is proved.

    Args:
        coin: the coin.
        units: of it.
        height: of C at the release [m].
        spin: there [rad/s].
        tilt: there, within ±π/2 [rad].
        bits: to begin with; doubled while the toss is undecided.
        most_bits: where that ends.
        ending: of a toss in vacuum, what ends it before its face is settled.

    Raises:
        ValueError: for an ending in air.
    """
    if ending != UNTIL_SETTLED:
        _require_vacuum(coin)
    while True:
        with _precision(bits):
            release = _in_own_units(
                units, PlanarRelease(Fraction(height), Fraction(spin), Fraction(tilt)), bits
            )
            toss = _toss(coin, release, bits, ending)
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
        change: those are meant that are this one times -1 to 1 away.
        bits: of the proof.
        ending: what ends a toss before its face is settled.

    Returns:
        Heads or tails; undecided where they differ, or where that is not proved.

    Raises:
        ValueError: of a coin in air.
    """
    _require_vacuum(coin)
    with _precision(bits):
        middles, changes = (_in_own_units(units, numbers, bits) for numbers in (release, change))
        return _toss(coin, [*map(varying, middles, changes)], bits, ending).outcome


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
    height, spin, tilt = release
    toss = certified_toss(coin, units, height=height, spin=spin, tilt=tilt, ending=ending)
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


@contextmanager
def _precision(bits: int) -> Iterator[None]:
    before = ctx.prec, ctx.cap
    ctx.prec, ctx.cap = bits, ORDER + 1
    try:
        yield
    finally:
        ctx.prec, ctx.cap = before


def _in_own_units(units: Units, release: PlanarRelease, bits: int) -> tuple[Any, Any, Any]:
    """Return height, spin and tilt."""
    time = square_root(units.length / units.gravity, 2 * bits)
    return ball(release.height / units.length), ball(release.spin * time), ball(release.tilt)


def _toss(coin: PlanarCoin, release: Sequence[Any], bits: int, ending: PlanarEnding) -> Certified:
    """Toss a coin whose height, spin and tilt are enclosures, or vary."""
    z, w, tilt = release
    state = EnclosedState(z=z, v=arb(0), tilt=tilt, w=w, u=arb(0))
    impacts: list[Enclosed] = []
    toss = EnclosedToss(coin, bits, ending)
    outcome = Outcome.UNDECIDED
    with suppress(UndecidedError):
        outcome = toss.run(state, impacts)
    return Certified(outcome=outcome, impacts=tuple(impacts), energy=toss.last_energy, bits=bits)
