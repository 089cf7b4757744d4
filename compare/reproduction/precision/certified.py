"""A planar toss in interval arithmetic of any length: its face is proved, or the toss is undecided.

python-flint's `arb` encloses every number. The first touch of a flight is proved to be the first: a bound on
the gap's second derivative keeps the gap positive from each point to the next. A toss is undecided where
an enclosure holds both signs of what decides; more bits then decide, but for tosses on a boundary.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from flint import acb, arb, ctx, fmpq

from cointoss.compare.reproduction.precision.certified_gap import Gap, polynomial
from cointoss.compare.reproduction.precision.double_double import exact
from cointoss.compare.reproduction.precision.planar_coin import PlanarCoin, Units, square_root
from cointoss.compare.reproduction.precision.taylor_models import (
    ORDER,
    TaylorModel,
    UndecidedError,
    middle,
    varying,
    whole,
    zero,
)
from cointoss.models.records import Outcome

MOST_IMPACTS = 5000
TURN = 2.0
"""At most this angle is flown on one series in air [rad]."""
LEAST = Fraction(1, 2**40)
"""Part of a change that is still tried."""


class PlanarRelease(NamedTuple):
    """A release, or how far one is from another."""

    height: Fraction = Fraction(0)
    """[m]."""
    spin: Fraction = Fraction(0)
    """[rad/s]."""
    tilt: Fraction = Fraction(0)
    """[rad]."""


@dataclass(frozen=True, kw_only=True)
class Enclosed:
    """An impact as it is known."""

    heads: bool
    """Whether heads is up."""
    impulse: Any
    """Upward, an enclosure [m sqrt(g r)]."""


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


@dataclass
class _State:
    z: Any
    v: Any
    tilt: Any
    w: Any
    u: Any
    heads: bool = True

    def tighten(self) -> None:
        """Let numbers that vary forget what is no longer true of their enclosures."""
        for name in ("z", "v", "tilt", "w", "u"):
            if isinstance(x := getattr(self, name), TaylorModel):
                setattr(self, name, x.tightened())


def certified_toss(
    coin: PlanarCoin,
    units: Units,
    *,
    height: Fraction | float,
    spin: Fraction | float,
    tilt: Fraction | float = 0.0,
    bits: int = 200,
    most_bits: int = 1600,
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
    """
    while True:
        with _precision(bits):
            release = _in_own_units(
                units, PlanarRelease(Fraction(height), Fraction(spin), Fraction(tilt)), bits
            )
            toss = _toss(coin, release, bits)
        if toss.outcome != Outcome.UNDECIDED or 2 * bits > most_bits:
            return toss
        bits *= 2


def outcome_within(
    coin: PlanarCoin, units: Units, *, release: PlanarRelease, change: PlanarRelease, bits: int = 200
) -> Outcome:
    """Return the outcome that all releases up to a change away, to both sides, are proved to have.

    Args:
        coin: in vacuum.
        units: of it.
        release: the one in their middle.
        change: those are meant that are this one times -1 to 1 away.
        bits: of the proof.

    Returns:
        Heads or tails; undecided where they differ, or where that is not proved.

    Raises:
        ValueError: of a coin in air.
    """
    _require_vacuum(coin)
    with _precision(bits):
        middles, changes = (_in_own_units(units, numbers, bits) for numbers in (release, change))
        return _toss(coin, [*map(varying, middles, changes)], bits).outcome


def proved_part(coin: PlanarCoin, units: Units, *, release: PlanarRelease, change: PlanarRelease) -> Fraction:
    """Return the largest 1, 1/2, 1/4, ... of a change within which the outcome is proved to be the same.

    Args:
        coin: in vacuum.
        units: of it.
        release: of the toss.
        change: to both sides of it.

    Returns:
        The part; 0 where the outcome of the toss is not proved, or that of its neighbours within `LEAST`.

    Raises:
        ValueError: of a coin in air.
    """
    _require_vacuum(coin)
    toss = certified_toss(coin, units, height=release.height, spin=release.spin, tilt=release.tilt)
    part = Fraction(1)
    while toss.outcome != Outcome.UNDECIDED and part >= LEAST:
        within = PlanarRelease(*(part * x for x in change))
        if outcome_within(coin, units, release=release, change=within, bits=toss.bits) == toss.outcome:
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


def _ball(number: Fraction) -> Any:
    return arb(fmpq(number.numerator, number.denominator))


def _in_own_units(units: Units, release: PlanarRelease, bits: int) -> tuple[Any, Any, Any]:
    """Return height, spin and tilt."""
    time = square_root(units.length / units.gravity, 2 * bits)
    return _ball(release.height / units.length), _ball(release.spin * time), _ball(release.tilt)


def _toss(coin: PlanarCoin, release: Sequence[Any], bits: int) -> Certified:
    """Toss a coin whose height, spin and tilt are enclosures, or vary."""
    z, w, tilt = release
    state = _State(z=z, v=arb(0), tilt=tilt, w=w, u=arb(0))
    impacts: list[Enclosed] = []
    toss = _Toss(coin, bits)
    outcome = Outcome.UNDECIDED
    with suppress(UndecidedError):
        outcome = toss.run(state, impacts)
    return Certified(outcome=outcome, impacts=tuple(impacts), energy=toss.last_energy, bits=bits)


def _sign(x: Any) -> int:
    if x > 0:
        return 1
    if x < 0:
        return -1
    raise UndecidedError


class _Toss:
    """The coin's numbers as enclosures, and its motion."""

    def __init__(self, coin: PlanarCoin, bits: int) -> None:
        self.coin, self.bits = coin, bits
        pairs = coin.inertia, coin.restitution, coin.slowing, coin.drag_mean, coin.drag_difference
        self.J, self.chi, self.k, self.a, self.b = (_ball(exact(pair)) for pair in pairs)
        self.share = arb(1.0 if coin.rough else (coin.sliding_share if coin.in_air else 0.0))
        self.last_energy: Any = None

    def run(self, state: _State, impacts: list[Enclosed]) -> Outcome:
        """Toss until the face is proved."""
        corners: tuple[int, ...] = ()
        start = None
        while len(impacts) < MOST_IMPACTS:
            corner = self.fly(state, corners, start)
            start = None
            corner = corner * self.turn_within(state)
            impulse = self.hit(state, corner)
            impacts.append(Enclosed(heads=state.heads, impulse=impulse))
            corners = (corner,)
            if self.is_settled(state):
                self.last_energy = self.energy(state)
                return Outcome.HEADS if state.heads else Outcome.TAILS
            loss = self.chatter(state, corner)
            if loss is None and self.coin.restitution[0] == 0 and not self.coin.in_air:
                start = self.lift_off(state)
            elif loss is not None:
                corners, start = self.contact(state, corner, loss)
                if not corners:
                    return Outcome.HEADS if state.heads else Outcome.TAILS
        raise UndecidedError

    def energy(self, state: _State) -> Any:
        """Return the energy that counts against the barrier 1."""
        return state.z + (state.v**2 + self.J * state.w**2 + self.share * state.u**2) / 2

    def is_settled(self, state: _State) -> bool:
        return self.energy(state) < 1

    def turn_within(self, state: _State) -> int:
        """Reduce the tilt to ±π/2; return -1 where the other face is up and the corners change names."""
        pi = arb.pi()
        if not abs(state.tilt).upper() < MOST_IMPACTS:
            raise UndecidedError
        halves = round(float((state.tilt / pi).mid()))
        state.tilt = state.tilt - halves * pi
        if not abs(state.tilt) < pi / 2:
            raise UndecidedError
        if halves % 2:
            state.heads = not state.heads
            return -1
        return 1

    def rim_velocity(self, state: _State, corner: int) -> Any:
        return state.v + corner * state.tilt.cos() * state.w

    def hit(self, state: _State, corner: int) -> Any:
        """Newton's law at a rim point, on a rough floor it stops aside; return the upward impulse."""
        sine, cosine = state.tilt.sin_cos()
        y, z = corner * cosine, corner * sine
        down = state.v + y * state.w
        if not down < 0:
            raise UndecidedError
        wanted, K_zz = -(1 + self.chi) * down, 1 + y**2 / self.J
        if self.coin.rough:
            K_yy, K_yz = 1 + z**2 / self.J, -y * z / self.J
            aside = -(state.u - z * state.w)
            determinant = K_yy * K_zz - K_yz**2
            S_y = (K_zz * aside - K_yz * wanted) / determinant
            S_z = (K_yy * wanted - K_yz * aside) / determinant
            state.u, moment = state.u + S_y, y * S_z - z * S_y
        else:
            S_z = wanted / K_zz
            moment = y * S_z
        state.v, state.w = state.v + S_z, state.w + moment / self.J
        state.tighten()
        return S_z

    def series(self, state: _State, length: float) -> tuple[list[Any], list[Any], Any]:
        """Return coefficients of height and drift in the clock s, and a bound on what they leave out."""
        if not self.coin.in_air:
            return [state.z, state.v, arb(-0.5)], [state.u], arb(0)
        k, a, b, w = self.k, self.a, self.b, state.w
        u = acb(state.u, state.v)
        E = (acb(0, 2) * state.tilt).exp()
        p, before = E * acb(state.u, -state.v), acb(0)
        z, turn = state.z, acb(0, 2) * w
        heights, drifts, rho = [z], [state.u], 1 / (2 * arb(length))
        size = arb(1)
        n = 0
        while True:
            z, u, p, before, E = (
                (k * n * z + u.imag) / (n + 1),
                ((k * n - a) * u - b * p - (acb(0, 1) if n == 0 else 0)) / (n + 1),
                ((k * n - a) * p + turn * (p - k * before) - b * u + acb(0, 1) * E) / (n + 1),
                p,
                E * turn / (n + 1),
            )
            n += 1
            heights.append(z)
            drifts.append(u.real)
            # From here on every coefficient is at most C rho^n: the recursion grows by less than rho.
            grows = k + (a + abs(b) + abs(turn) * (1 + k / rho) + 1) / (n + 1)
            size_before, size = size, arb.max(abs(z), arb.max(abs(u), arb.max(abs(p), abs(E))))
            tail = 2 * arb.max(size * rho ** (-n), size_before * rho ** (1 - n)) * arb(2) ** (-n)
            if grows < rho and tail < arb(2) ** (-self.bits - 20):
                return heights, drifts, tail.upper() * arb(0, 1)
            if n > 4 * self.bits:
                raise UndecidedError

    def fly(self, state: _State, corners: tuple[int, ...], start: Any) -> int:
        """Fly to the first touch; return the rim point that touches."""
        while True:
            v, z, w = (float(x.mid()) for x in (state.v, state.z, state.w))
            length = v + math.sqrt(v * v + 2 * max(z, 0.0)) + 1e-3
            if self.coin.in_air:
                length = min(1.1 * length, TURN / abs(w) if w else 10.0, 10.0)
            heights, drifts, tail = self.series(state, length)
            best, who = None, 0
            limit = arb(length)
            gap_of = partial(Gap, heights, tail, state.tilt, state.w, corners, start)
            for side in (-1, 1):
                root = gap_of(side, whole).first_zero(
                    float(length) if best is None else float(best.upper()) * (1 + 1e-15)
                )
                if root is not None:
                    if best is not None and not (root < best or root > best):
                        raise UndecidedError
                    if best is None or root < best:
                        best, who = root, side
            at = limit if best is None else self.touch(partial(gap_of, who), best)
            self.move(state, heights, drifts, tail, at)
            if best is not None:
                return who
            if not self.coin.in_air:
                raise UndecidedError
            corners, start = (), None

    def touch(self, gap_of: Callable[[Callable[[Any], Any]], Gap], root: Any) -> Any:
        """Return the clock of a touch that is enclosed for all releases; where they vary, as they do."""
        gap = gap_of(_itself)
        if not isinstance(gap.w, TaylorModel):
            return root
        of_middle = gap_of(middle).enclosed(root.lower())
        if of_middle is None:
            raise UndecidedError
        return zero(gap.at, of_middle, root)

    def move(self, state: _State, heights: list[Any], drifts: list[Any], tail: Any, s: Any) -> None:
        left = 1 - self.k * s
        state.z = polynomial(heights, s) + tail
        state.v = left * (polynomial([n * c for n, c in enumerate(heights)][1:], s) + tail * len(heights) * 4)
        state.u = polynomial(drifts, s) + tail
        state.tilt, state.w = state.tilt + state.w * s, left * state.w
        state.tighten()

    def chatter(self, state: _State, corner: int) -> Any:
        """Bound the energy that the bounces still to come lose from above, once they are proved to end.

        While the rim point stays in a small neighbourhood its acceleration lies in [-fastest, -slowest], so
        each bounce starts with at most the part χ sqrt(fastest/slowest) of the speed of the one before.

        Returns:
            None where that is not proved.
        """
        if self.coin.in_air or self.coin.rough:
            v = self.rim_velocity(state, corner)
            if v < 2.0**-60 and not state.z * state.w**2 > 1:
                raise UndecidedError
            return None
        v = self.rim_velocity(state, corner).upper()
        if not v < 1e-8 or not state.z * state.w**2 < 1:
            return None
        # Within `reach` of time and all speeds' changes.
        reach = arb(float(v.upper()) * 1e3) * arb(0, 1)
        tilt, w = state.tilt + reach, state.w + reach
        sinking = 1 - abs(tilt.sin()) * w**2
        if not sinking > 0:
            return None
        fastest, slowest = sinking.upper(), sinking.lower()
        part = self.chi * (fastest / slowest).sqrt()
        lasting = 2 * v / (slowest * (1 - part))
        changed = (1 + self.chi) * v / (1 - part) / self.J
        turned = lasting * (abs(state.w) + changed)
        rad = v * 1e3
        if not (part < 1 and turned < rad and changed < rad):
            return None
        loss = (v**2 / (1 - part**2)).upper()
        e = self.energy(state)
        near = loss < arb(2) ** (-self.bits // 2)
        return loss if near or (e - loss > 1 and e < 1 + self.J / 2) else None

    def lift_off(self, state: _State) -> Any:
        """Return the clock up to which a rim point at rest on the floor, but drawn up, does not touch."""
        drawn = state.z * state.w**2 - 1
        if _sign(drawn) < 0:
            raise UndecidedError
        return 1.5 * drawn / abs(state.w) ** 3

    def contact(self, state: _State, corner: int, loss: Any) -> tuple[tuple[int, ...], Any]:
        """Follow contact as `planar_contact.keep_contact` does; return the rim points that leave the floor.

        They are none where the coin lies, and its face is that of the state.
        """
        e = self.energy(state)
        e = e - loss / 2 + (loss / 2) * arb(0, 1)
        self.last_energy = e
        # The rates change by no more than the speed that is lost, over the least moment.
        slack = 10 * self.rim_velocity(state, corner) * arb(0, 1)
        rises = _sign(state.v + slack) > 0
        if rises and e < 1:
            rises = False
        if rises and _sign(e - 1 - self.J / 2) > 0:
            s = e - (e**2 - 1 - self.J).sqrt()
            state.z, state.tilt = s, (-corner * s).asin()
            state.w = -corner * (2 * (e - s) / (self.J + 1 - s**2)).sqrt()
            state.v = -corner * state.tilt.cos() * state.w
            return (corner,), 2 * state.v / state.w**2
        if rises and _sign(e - 1) > 0:
            state.heads, corner = not state.heads, -corner
        state.z, state.tilt = arb(0), arb(0)
        state.v = -(2 * e / (1 + self.J)).sqrt()
        state.w = -corner * state.v
        for turn in range(1000):
            if self.is_settled(state):
                return (), None
            side = -corner if turn % 2 == 0 else corner
            if turn > 0 and _sign(self.rim_velocity(state, side)) > 0:
                return (-1, 1), None
            self.hit(state, side)
        raise UndecidedError


def _itself(x: Any) -> Any:
    return x
