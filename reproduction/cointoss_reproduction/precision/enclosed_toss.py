"""The motion of a planar coin in interval arithmetic, from its release to a proved face."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import Any

from flint import acb, arb, fmpq

from cointoss import Outcome
from cointoss_reproduction.precision.certified_gap import Gap, polynomial
from cointoss_reproduction.precision.double_double import exact
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_ending import PlanarEnding
from cointoss_reproduction.precision.taylor_models import TaylorModel, UndecidedError, middle, whole, zero

MOST_IMPACTS = 5000
IN_HAND = 0
"""No rim point: the coin is caught."""
TURN = 2.0
"""At most this angle is flown on one series in air [rad]."""


@dataclass(frozen=True, kw_only=True)
class Enclosed:
    """An impact as it is known."""

    heads: bool
    """Whether heads is up."""
    impulse: Any
    """Upward, an enclosure [m sqrt(g r)]."""


@dataclass
class EnclosedState:
    """The state of the coin in its own units, numbers that are enclosed or vary with the release."""

    z: Any
    v: Any
    tilt: Any
    w: Any
    u: Any
    heads: bool = True
    time: Any = field(default_factory=arb)
    """At most so long after the release; of a coin in vacuum."""

    def tighten(self) -> None:
        """Let numbers that vary forget what is no longer true of their enclosures."""
        for name in ("z", "v", "tilt", "w", "u"):
            if isinstance(x := getattr(self, name), TaylorModel):
                setattr(self, name, x.tightened())


def ball(number: Fraction) -> Any:
    """Return the enclosure of a number."""
    return arb(fmpq(number.numerator, number.denominator))


def _sign(x: Any) -> int:
    if x > 0:
        return 1
    if x < 0:
        return -1
    raise UndecidedError


class EnclosedToss:
    """The coin's numbers as enclosures, and its motion."""

    def __init__(self, coin: PlanarCoin, bits: int, ending: PlanarEnding) -> None:
        """Enclose the numbers of a coin, and of what ends its toss."""
        self.coin, self.bits, self.ending = coin, bits, ending
        pairs = coin.inertia, coin.restitution, coin.slowing, coin.drag_mean, coin.drag_difference
        self.J, self.chi, self.k, self.a, self.b = (ball(exact(pair)) for pair in pairs)
        drifts = 1.0 if coin.rough else (coin.sliding_share if coin.in_air else 0.0)
        self.share = arb(drifts if ending.counts_drift else 0.0)
        self.hand, self.max_time = (None if x is None else ball(x) for x in (ending.caught, ending.max_time))
        self.last_energy: Any = None

    def run(self, state: EnclosedState, impacts: list[Enclosed]) -> Outcome:
        """Toss until the face is proved."""
        corners: tuple[int, ...] = ()
        start = None
        while len(impacts) < (self.ending.max_impacts or MOST_IMPACTS):
            corner = self.fly(state, corners, start)
            start = None
            corner = corner * self.turn_within(state)
            if corner == IN_HAND:
                return Outcome.HEADS if state.heads else Outcome.TAILS
            impulse = self.hit(state, corner)
            impacts.append(Enclosed(heads=state.heads, impulse=impulse))
            corners = (corner,)
            if self.is_settled(state):
                if self.hand is not None:
                    raise UndecidedError
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

    def energy(self, state: EnclosedState) -> Any:
        """Return the energy that counts against the barrier 1."""
        return state.z + (state.v**2 + self.J * state.w**2 + self.share * state.u**2) / 2

    def is_settled(self, state: EnclosedState) -> bool:
        """Return whether the energy is proved to be below the barrier."""
        return self.energy(state) < 1

    def turn_within(self, state: EnclosedState) -> int:
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

    def rim_velocity(self, state: EnclosedState, corner: int) -> Any:
        """Return the upward velocity of a rim point."""
        return state.v + corner * state.tilt.cos() * state.w

    def hit(self, state: EnclosedState, corner: int) -> Any:
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

    def series(self, state: EnclosedState, length: float) -> tuple[list[Any], list[Any], Any]:
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

    def fly(self, state: EnclosedState, corners: tuple[int, ...], start: Any) -> int:
        """Fly to the first touch, or into the hand; return the rim point that touches, or `IN_HAND`."""
        caught = self.catch(state)
        while True:
            v, z, w = (float(x.mid()) for x in (state.v, state.z, state.w))
            length = v + math.sqrt(v * v + 2 * max(z, 0.0)) + 1e-3
            if self.coin.in_air:
                length = min(1.1 * length, TURN / abs(w) if w else 10.0, 10.0)
            if caught is not None:
                length = float(caught.upper()) * (1 + 1e-15)
            heights, drifts, tail = self.series(state, length)
            best, who = None, IN_HAND
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
            if caught is not None and best is None:
                self.move(state, heights, drifts, tail, caught)
                return IN_HAND
            if caught is not None and not caught > best:
                raise UndecidedError
            at = limit if best is None else self.touch(partial(gap_of, who), best)
            self.move(state, heights, drifts, tail, at)
            if best is not None:
                return who
            if not self.coin.in_air:
                raise UndecidedError
            corners, start = (), None

    def catch(self, state: EnclosedState) -> Any:
        """Return the clock at which C comes down to the hand; None where it does not rise above it."""
        if self.hand is None:
            return None
        above = state.z - self.hand
        rises = not (isinstance(state.v, arb) and state.v == 0) and _sign(state.v) > 0
        if _sign(above + state.v**2 / 2 if rises else above) < 0:
            return None
        return state.v + (state.v**2 + 2 * above).sqrt()

    def pass_time(self, state: EnclosedState, lasting: Any) -> None:
        """Let time pass, which is not to be up."""
        state.time = state.time + lasting.upper()
        if self.max_time is not None and not state.time < self.max_time:
            raise UndecidedError

    def touch(self, gap_of: Callable[[Callable[[Any], Any]], Gap], root: Any) -> Any:
        """Return the clock of a touch that is enclosed for all releases; where they vary, as they do."""
        gap = gap_of(_itself)
        if not isinstance(gap.w, TaylorModel):
            return root
        of_middle = gap_of(middle).enclosed(root.lower())
        if of_middle is None:
            raise UndecidedError
        return zero(gap.at, of_middle, root)

    def move(self, state: EnclosedState, heights: list[Any], drifts: list[Any], tail: Any, s: Any) -> None:
        """Let the coin fly up to a clock, by the series of its flight."""
        left = 1 - self.k * s
        state.z = polynomial(heights, s) + tail
        state.v = left * (polynomial([n * c for n, c in enumerate(heights)][1:], s) + tail * len(heights) * 4)
        state.u = polynomial(drifts, s) + tail
        state.tilt, state.w = state.tilt + state.w * s, left * state.w
        state.tighten()
        self.pass_time(state, s)

    def chatter(self, state: EnclosedState, corner: int) -> Any:
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
        if not (near or (e - loss > 1 and e < 1 + self.J / 2)):
            return None
        self.pass_time(state, lasting)
        return loss

    def lift_off(self, state: EnclosedState) -> Any:
        """Return the clock up to which a rim point at rest on the floor, but drawn up, does not touch."""
        drawn = state.z * state.w**2 - 1
        if _sign(drawn) < 0:
            raise UndecidedError
        return 1.5 * drawn / abs(state.w) ** 3

    def contact(self, state: EnclosedState, corner: int, loss: Any) -> tuple[tuple[int, ...], Any]:
        """Follow contact as `planar_contact.keep_contact` does; return the rim points that leave the floor.

        They are none where the coin lies, and its face is that of the state. With s = |sin θ| the coin turns
        about the rim point at θ'² = 2 (e - s)/(J + 1 - s²), and leaves it, or lies, within
        4 √((J + 1)/(2 |e - 1|)): so long it takes at most from where it turns back, 1 - s² being more than
        1 - e, or over the rim.
        """
        if self.hand is not None or self.ending.max_impacts is not None:
            raise UndecidedError
        e = self.energy(state)
        e = e - loss / 2 + (loss / 2) * arb(0, 1)
        self.last_energy = e
        if self.max_time is not None:
            self.pass_time(state, 4 * ((self.J + 1) / (2 * abs(e - 1))).sqrt())
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
