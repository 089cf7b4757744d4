"""The toss of a planar coin in interval arithmetic of any length, from its release to a proved face.

python-flint's `arb` encloses every number. The first touch of a flight is proved to be the first: a bound on
the gap's second derivative keeps the gap positive from each point to the next. A toss is undecided where
an enclosure holds both signs of what decides.
"""

import math
from collections.abc import Sequence
from typing import Any

from flint import acb, arb, ctx

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_gap import Gap, polynomial, slopes
from cointoss_reproduction.precision.planar_state import Impact, State, UndecidedError, ball, sign

MOST_IMPACTS = 5000
MOST_TURNED = 5000
"""The largest turn in a flight [rad]."""
SLAPS = 1000
"""The most impacts of a flat coin on its two rim points in turn."""
TURN = 4.0
"""The largest turn on one series in air [rad]."""
TERMS = 8
"""After each group of this many terms of a series the toss checks whether they suffice."""


class PlanarToss:
    """The coin's numbers as enclosures, its motion, and what is proved of its course."""

    def __init__(self, coin: PlanarCoin) -> None:
        """Enclose the numbers of a coin."""
        self.coin, self.bits = coin, ctx.prec
        numbers = coin.inertia, coin.restitution, coin.slowing, coin.drag_mean, coin.drag_difference
        self.J, self.chi, self.k, self.a, self.b = map(ball, numbers)
        self.share = arb(1.0 if coin.rough else (coin.sliding_share if coin.in_air else 0.0))
        self.impacts: list[Impact] = []
        self.contacts: list[tuple[int, ...]] = []
        """The contacts that lasted: how many impacts came before, and the rim points that leave the floor."""
        self.last_energy: Any = None
        """With which the toss was settled [m g r]: after its last impact, or in contact before it lay."""

    def run(self, state: State) -> Outcome:
        """Toss until the face is proved.

        Raises:
            UndecidedError: where it is not.
        """
        corners: tuple[int, ...] = ()
        start = None
        while len(self.impacts) < MOST_IMPACTS:
            corner = self.fly(state, corners, start)
            start = None
            corner = corner * self.turn_within(state)
            self.touched(state)
            impulse = self.hit(state, corner)
            e = self.energy(state)
            self.impacts.append(Impact(state.heads, corner, impulse, (state.z, state.v, state.w), e))
            corners = (corner,)
            if self.is_over(e):
                self.last_energy = e
                break
            loss = self.chatter(state, corner)
            if loss is None and self.coin.restitution == 0:
                start = self.lift_off(state)
            elif loss is not None:
                corners, start = self.contact(state, corner, loss)
                self.contacts.append((len(self.impacts), *corners))
                if not corners:
                    break
        else:
            raise UndecidedError
        return Outcome.HEADS if state.heads else Outcome.TAILS

    def kept(self, x: Any) -> Any:
        """Return what is kept of the enclosure of a number of the state: all of it."""
        return x

    def touched(self, state: State) -> None:
        """Take note of a touch."""

    def energy(self, state: State) -> Any:
        """Return the energy that counts against the barrier 1, in m g r.

        On a smooth floor that of drift cannot lift the coin; in air no more than a share of it can.
        """
        return state.z + (state.v**2 + self.J * state.w**2 + self.share * state.u**2) / 2

    def is_over(self, e: Any) -> bool:
        """Return whether a coin in flight whose energy is proved to be below the barrier needs no more."""
        return e < 1

    def turn_within(self, state: State) -> int:
        """Reduce the tilt to ±π/2; return -1 where the other face is up and the corners change names."""
        pi = arb.pi()
        if not abs(state.tilt).upper() < MOST_TURNED:
            raise UndecidedError
        halves = round(float((state.tilt / pi).mid()))
        state.tilt = state.tilt - halves * pi
        if not abs(state.tilt) < pi / 2:
            raise UndecidedError
        if halves % 2:
            state.heads = not state.heads
            return -1
        return 1

    def rim_velocity(self, state: State, corner: int) -> Any:
        """Return the upward velocity of a rim point."""
        return state.v + corner * state.tilt.cos() * state.w

    def hit(self, state: State, corner: int) -> Any:
        """Change the state by Newton's law at a rim point that comes down; return the upward impulse."""
        down = self.rim_velocity(state, corner)
        if not down < 0:
            raise UndecidedError
        return self.push(state, corner, -(1 + self.chi) * down)

    def push(self, state: State, corner: int, wanted: Any) -> Any:
        """Change a rim point's vertical velocity by a given amount; a rough floor also stops it sideways.

        Returns:
            The upward impulse.
        """
        sine, cosine = state.tilt.sin_cos()
        y, z = corner * cosine, corner * sine
        # K is what an impulse at (y, z) from C does to the velocity there.
        K_zz = 1 + y**2 / self.J
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
        state.let(self.kept)
        return S_z

    def series(self, state: State, length: float) -> tuple[list[Any], list[Any], Any]:
        """Return coefficients of height and drift in the clock s, and a bound on what they leave out.

        In the clock of the slowing spin, dt = ds/(1 - k s), the angle is linear in s, and height and velocity
        have power series whose terms follow from three before; in vacuum they end with the second.
        """
        if not self.coin.in_air:
            return [state.z, state.v, arb(-0.5)], [state.u], arb(0)
        k, a, b, i = self.k, self.a, self.b, acb(0, 1)
        u, turn, E = acb(state.u, state.v), 2 * i * state.w, (2 * i * state.tilt).exp()
        z, p, before = state.z, E * acb(state.u, -state.v), acb(0)
        heights, drifts, rho, gravity = [z], [state.u], 1 / (2 * arb(length)), i
        for n in range(1, 4 * self.bits):
            slows, last = k * (n - 1) - a, (z, u, p, E)
            z, u, p, before, E = (
                (k * (n - 1) * z + u.imag) / n,
                (slows * u - b * p - gravity) / n,
                (slows * p + turn * (p - k * before) - b * u + i * E) / n,
                p,
                E * turn / n,
            )
            heights.append(z)
            drifts.append(u.real)
            gravity = acb(0)
            if n % TERMS == 0:
                # From here on every coefficient is at most C rho^n: the recursion grows by less than rho.
                grows = k + (a + abs(b) + abs(turn) * (1 + k / rho) + 1) / (n + 1)
                sizes = (max(abs(x).upper() for x in terms) for terms in ((z, u, p, E), last))
                tail = 2 * max(size * rho ** (by - n) for by, size in enumerate(sizes)) * arb(2) ** (-n)
                if grows < rho and tail < arb(2) ** (-self.bits - 20):
                    return heights, drifts, tail.upper() * arb(0, 1)
        raise UndecidedError

    def fly(self, state: State, corners: tuple[int, ...], start: Any) -> int:
        """Fly to the first touch; return the rim point that touches."""
        while True:
            v, z, w = (float(x.mid()) for x in (state.v, state.z, state.w))
            length = v + math.sqrt(v * v + 2 * max(z, 0.0)) + 1e-3
            if self.coin.in_air:
                length = min(1.1 * length, TURN / abs(w) if w else 10.0, 10.0)
            heights, drifts, tail = self.series(state, length)
            at, who = None, None
            for side in (-1, 1):
                limit = length if at is None else float(at.upper()) * (1 + 1e-15)
                root = Gap(heights, tail, state.tilt, state.w, corners, start, side).first_zero(limit)
                if root is not None and (at is None or sign(at - root) > 0):
                    at, who = root, side
            if at is None and not self.coin.in_air:
                raise UndecidedError
            self.move(state, heights, drifts, tail, arb(length) if at is None else at)
            if who is not None:
                return who
            corners, start = (), None

    def move(self, state: State, heights: Sequence[Any], drifts: Sequence[Any], tail: Any, s: Any) -> None:
        """Let the coin fly up to a clock, by the series of its flight."""
        left = 1 - self.k * s
        state.z = polynomial(heights, s) + tail
        state.v = left * (polynomial(slopes(heights), s) + tail * len(heights) * 4)
        state.u = polynomial(drifts, s) + tail
        state.tilt, state.w = state.tilt + state.w * s, left * state.w
        state.let(self.kept)

    def chatter(self, state: State, corner: int) -> Any:
        """Bound the energy that the bounces still to come lose from above, once they are proved to end.

        While the rim point stays in a small neighbourhood its acceleration lies in [-fastest, -slowest], so
        each bounce starts with at most the part χ sqrt(fastest/slowest) of the speed of the one before.

        Returns:
            None where that is not proved.
        """
        v = self.rim_velocity(state, corner).upper()
        if self.coin.in_air or self.coin.rough:
            if v < 2.0**-60 and not state.z * state.w**2 > 1:
                raise UndecidedError
            return None
        if not v < 1e-8 or not state.z * state.w**2 < 1:
            return None
        # Within `reach` of time and all speeds' changes.
        reach = arb(float(v) * 1e3) * arb(0, 1)
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
        return loss

    def lift_off(self, state: State) -> Any:
        """Return the clock up to which a rim point at rest on the floor, but drawn up, does not touch."""
        drawn = state.z * state.w**2 - 1
        if sign(drawn) < 0:
            raise UndecidedError
        return 1.5 * drawn / abs(state.w) ** 3

    def contact(self, state: State, corner: int, loss: Any) -> tuple[tuple[int, ...], Any]:
        """Follow contact on a smooth floor in vacuum; return the rim points that leave the floor, and when.

        They are none where the coin lies, and its face is that of the state. The motion has one degree of
        freedom and keeps its energy: with s = |sin θ| the coin turns about the rim point at
        θ'² = 2 (e - s)/(J + 1 - s²), presses while s² - 2 e s + 1 + J > 0, and leaves it, or lies, within
        4 √((J + 1)/(2 |e - 1|)): so long it takes at most from where it turns back, 1 - s² being more than
        1 - e, or over the rim.
        """
        e = self.energy(state)
        e = e - loss / 2 + (loss / 2) * arb(0, 1)
        self.last_energy = e
        # The rates change by no more than the speed that is lost, over the least moment.
        slack = 10 * self.rim_velocity(state, corner) * arb(0, 1)
        rises = sign(state.v + slack) > 0 and not e < 1
        if rises and sign(e - 1 - self.J / 2) > 0:
            s = e - (e**2 - 1 - self.J).sqrt()
            state.z, state.tilt = s, (-corner * s).asin()
            state.w = -corner * (2 * (e - s) / (self.J + 1 - s**2)).sqrt()
            state.v = -corner * state.tilt.cos() * state.w
            return (corner,), 2 * state.v / state.w**2
        if rises and sign(e - 1) > 0:
            state.heads, corner = not state.heads, -corner
        state.v = -(2 * e / (1 + self.J)).sqrt()
        return self.slap(state, corner)

    def slap(self, state: State, corner: int) -> tuple[tuple[int, ...], Any]:
        """Lay the coin on the floor, a rim point at rest there; both hit the floor in turn.

        Returns:
            Both, where they leave the floor in the end, else none.
        """
        state.z, state.tilt, state.w = arb(0), arb(0), -corner * state.v
        for turn in range(SLAPS):
            if self.energy(state) < 1:
                return (), None
            side = -corner if turn % 2 == 0 else corner
            if turn > 0 and sign(self.rim_velocity(state, side)) > 0:
                return (-1, 1), None
            self.hit(state, side)
        raise UndecidedError
