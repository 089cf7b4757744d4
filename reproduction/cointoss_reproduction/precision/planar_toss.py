"""The toss of a planar coin in numbers of `BITS` bits, from its release until its face is settled.

The first touch of a flight is enclosed by python-flint's `arb`: a bound on the gap's second derivative keeps
the gap positive from each point to the next. Of all other enclosures the middle is kept, and nothing is
proved. Contact that lasts on a rough floor, or in air, follows an ordinary differential equation, solved by
power series. A step errs by 1e-13 or so, as a smooth function of where it starts: that moves the boundaries
between heads and tails, and leaves what they look like at any scale.
"""

import math
from collections.abc import Sequence
from typing import Any

from flint import acb, arb, arb_poly, arb_series, ctx

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_gap import Gap, polynomial, slopes
from cointoss_reproduction.precision.planar_state import Impact, State, UndecidedError, ball, sign

BITS = 128
ORDER = 24
"""The order of a series in time in a contact."""
STEP, SLOW = 0.15, 0.4
"""A series is used for as long as the coin turns by the first angle, at the second rate above its own."""
MOST_STEPS = 2000
NEWTON_STEPS = 60
CHATTERING, CHATTERING_ROUGH = 1e-10, 1e-15
"""The coin stays on the floor when all bounces to come are this short, compared with the other motion. The
error of contact grows as its third power on a smooth floor, as its second power on a rough floor."""
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
    """The coin's numbers, its motion, and its course."""

    def __init__(self, coin: PlanarCoin, *, to_contact: bool = False) -> None:
        """Take a coin, and whether it is followed until it lies when it is settled."""
        self.coin, self.to_contact = coin, to_contact
        numbers = coin.inertia, coin.restitution, coin.slowing, coin.drag_mean, coin.drag_difference
        self.J, self.chi, self.k, self.a, self.b = map(ball, numbers)
        self.share = arb(1.0 if coin.rough else (coin.sliding_share if coin.in_air else 0.0))
        self.impacts: list[Impact] = []
        self.contacts: list[tuple[int, ...]] = []
        """The contacts that lasted: how many impacts came before, and the rim points that leave the floor."""
        self.nearest = self.flattest = float("inf")

    def run(self, state: State) -> Outcome:
        """Toss until the face is settled.

        Raises:
            UndecidedError: where a limit is reached, or a sign cannot be decided.
        """
        corners: tuple[int, ...] = ()
        start = None
        while len(self.impacts) < MOST_IMPACTS:
            corner = self.fly(state, corners, start)
            start = None
            corner = corner * self.turn_within(state)
            if self.energy(state) >= 1:
                self.flattest = min(self.flattest, abs(float(state.tilt)))
            impulse = self.hit(state, corner)
            e = self.energy(state)
            self.impacts.append(Impact(state.heads, corner, impulse, (state.z, state.v, state.w), e))
            corners = (corner,)
            if e < 1 and not self.to_contact:
                break
            if self.stays(state, corner):
                corners, start = self.contact(state, corner)
                self.contacts.append((len(self.impacts), *corners))
                if not corners:
                    break
            elif self.coin.restitution == 0:
                start = self.lift_off(state)
        else:
            raise UndecidedError
        return Outcome.HEADS if state.heads else Outcome.TAILS

    def energy(self, state: State) -> Any:
        """Return the energy that counts against the barrier 1, in m g r.

        On a smooth floor that of drift cannot lift the coin; in air no more than a share of it can.
        """
        return state.z + (state.v**2 + self.J * state.w**2 + self.share * state.u**2) / 2

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
        state.keep_middles()
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
        for n in range(1, 4 * ctx.prec):
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
                if grows < rho and tail < arb(2) ** (-ctx.prec - 20):
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
        state.keep_middles()

    def stays(self, state: State, corner: int) -> bool:
        """Stop the rim point where all its bounces to come are short; return whether they are."""
        sinking = 1 - float(state.z * state.w**2)
        if sinking <= 0:
            return False
        v, limit = self.rim_velocity(state, corner), CHATTERING_ROUGH if self.coin.rough else CHATTERING
        # They last for 2 v/(sinking (1 - χ)).
        if 2 * v * (1 + abs(state.w) ** 3) >= limit * sinking**2 * (1 - self.chi):
            return False
        self.push(state, corner, -v)
        return True

    def lift_off(self, state: State) -> Any:
        """Return the clock up to which a rim point at rest on the floor, but drawn up, does not touch."""
        drawn = state.z * state.w**2 - 1
        if sign(drawn) < 0:
            raise UndecidedError
        return 1.5 * drawn / abs(state.w) ** 3

    def from_upright(self, state: State) -> float:
        """Return how far a coin in contact is from standing upright at rest; see `Toss`."""
        return float((state.v**2 + self.J * state.w**2) / 2 + 1 - state.z)

    def contact(self, state: State, corner: int) -> tuple[tuple[int, ...], Any]:
        """Follow contact; return the rim points that leave the floor, and up to when freely.

        They are none where the coin lies, and its face is that of the state. On a smooth floor in vacuum the
        motion has one degree of freedom and keeps its energy: with s = |sin θ| the coin turns about the rim
        point at θ'² = 2 (e - s)/(J + 1 - s²), presses while s² - 2 e s + 1 + J > 0, and leaves it, or lies.
        """
        if self.coin.in_air or self.coin.rough:
            return self.follow(state, corner)
        e, before, rises = self.energy(state), state.z, sign(state.v) > 0
        top = e if rises else before
        if rises and sign(e - 1 - self.J / 2) > 0:
            s = e - (e**2 - 1 - self.J).sqrt()
            state.z, state.tilt = s, (-corner * s).asin()
            state.w = -corner * (2 * (e - s) / (self.J + 1 - s**2)).sqrt()
            state.v = -corner * state.tilt.cos() * state.w
            self.nearest = abs(float(e + 1 - 2 * before.max(s)))
            return (corner,), 2 * state.v / state.w**2
        if rises and sign(e - 1) > 0:
            state.heads, corner, top = not state.heads, -corner, 1
        self.nearest = abs(float(e + 1 - 2 * top))
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

    def follow(self, state: State, corner: int) -> tuple[tuple[int, ...], Any]:
        """Follow a coin whose rim point rolls, or slides, until it lies flat or the floor would have to pull.

        A rim point that rolls slips freely where a rough floor would have to pull.
        """
        self.nearest = self.from_upright(state)
        rolls = self.coin.rough
        for _ in range(MOST_STEPS):
            motion = self.motion(state, corner, rolls)
            *_, height, force = motion
            at = (STEP / (SLOW + abs(state.w))).mid()
            pulls, down = (f(at) <= 0 for f in (force, height))
            if force[0] <= 0:
                at = arb(0)
            elif pulls or down:
                at = _zero(force if pulls else height, at)
            state.tilt, state.w, state.u, state.v, state.z = (f(at).mid() for f in motion[:-1])
            pulls = pulls or force[0] <= 0
            if not pulls and down:
                return self.slap(state, corner)
            if pulls and not (rolls and state.z * state.w**2 < 1):
                drawn = state.z * state.w**2 - 1
                return (corner,), (1.5 * drawn / abs(state.w) ** 3).max(state.v / state.w**2)
            rolls = rolls and not pulls
            self.nearest = min(self.nearest, self.from_upright(state))
            corner = corner * self.turn_within(state)
        raise UndecidedError

    def motion(self, state: State, corner: int, rolls: bool) -> Sequence[Any]:
        """Return polynomials in time: tilt, spin, drift, fall, height and the floor's force."""
        start = state.tilt, state.w, state.u
        numbers = [arb_series([x]) for x in start]
        before = ctx.cap
        for ctx.cap in range(2, ORDER + 1):
            rates, _ = self.rates(numbers, corner, rolls)
            numbers = [x + rate.integral() for x, rate in zip(start, rates, strict=True)]
        _, others = self.rates(numbers, corner, rolls)
        ctx.cap = before
        return [arb_poly(f.coeffs()) for f in (*numbers, *others)]

    def rates(self, numbers: list[Any], corner: int, rolls: bool) -> tuple[list[Any], list[Any]]:
        """Return the rates of tilt, spin and drift of a coin in contact; and fall, height and force.

        N = 1 - F_z + dv/dt, J dw/dt = σ cos θ N - σ sin θ S - d w with S = 0 where it slides; where it rolls
        the rim point is at rest.
        """
        tilt, w, u = numbers
        sine, cosine = tilt.sin_cos()
        v, twice = -corner * cosine * w, 2 * tilt
        s2, c2 = twice.sin_cos()
        F_y = -(self.a * u + self.b * (c2 * u + s2 * v))
        F_z = -(self.a * v + self.b * (s2 * u - c2 * v))
        turning = self.k * self.J * w
        if rolls:
            spinning = (corner * (cosine * (1 - F_z) + sine * F_y) - turning) / (self.J + 1)
            drifting = corner * (cosine * w**2 + sine * spinning)
        else:
            free = 1 - F_z + corner * sine * w**2
            spinning = (corner * cosine * free - turning) / (self.J + cosine**2)
            drifting = F_y
        force = 1 - F_z + corner * (sine * w**2 - cosine * spinning)
        return [w, spinning, drifting], [v, -corner * sine, force]


def _zero(f: Any, at: Any) -> Any:
    """Return a zero of a polynomial near a number, by Newton's rule."""
    slope = f.derivative()
    for _ in range(NEWTON_STEPS):
        change = (f(at) / slope(at)).mid()
        at = (at - change).mid()
        if abs(change) < 1e-34:
            break
    return at
