"""Planar tosses followed in mere numbers of `BITS` bits: nothing is proved, and every contact is followed.

The algorithm is that of `planar_toss`; of each enclosure the middle is kept. Contact that lasts on a rough
floor, or in air, follows an ordinary differential equation, solved by power series. A step
errs by 1e-13 or so, as a smooth function of where it starts: that moves the boundaries between heads and
tails, and leaves what they look like at any scale.
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import arb, arb_poly, arb_series, ctx

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_state import (
    Impact,
    State,
    UndecidedError,
    in_own_units,
    precision,
    released,
)
from cointoss_reproduction.precision.planar_toss import PlanarToss

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
COMPARED = 400
"""The most touches that are compared with those of a neighbour."""
APART = 0.1
"""Two tosses have diverged when height, velocity and spin together differ by this much, or the faces
differ."""


@dataclass(frozen=True, kw_only=True)
class Toss:
    """How a toss went."""

    outcome: Outcome
    """Heads or tails; undecided where a limit was reached."""
    impacts: tuple[Impact, ...]
    """All impacts, including those of bounces that die away."""
    contacts: tuple[tuple[int, ...], ...]
    """The contacts that lasted: how many impacts came before, and the rim points that left the floor, if
    any."""
    energy: float
    """With which it was settled [m g r]: after its last impact, or in the contact that came before lying."""
    from_upright: float
    """How near it came to standing in its last contact: the energy of its motion and that which its height
    lacks [m g r]. By so much its energy differs from that of the coin that stands when it turns back below
    the upright, or passes it. Infinite where no contact lasted before it was settled."""
    flattest: float
    """The smallest tilt of a touch before it was settled [rad]."""

    @property
    def itinerary(self) -> tuple[Any, ...]:
        """Which rim points touch with which face up, how contacts end, and the outcome."""
        return self.outcome, self.contacts, tuple(impact[:2] for impact in self.impacts)


def energy_left(one: Toss, other: Toss) -> float:
    """Return the larger energy of two tosses after the first impact at which they have diverged [m g r].

    0 where they have not.
    """
    for a, b in zip(one.impacts[:COMPARED], other.impacts, strict=False):
        apart = sum(abs(float(x) - float(y)) for x, y in zip(a.state, b.state, strict=True))
        if apart > APART or a.heads != b.heads:
            return max(float(a.energy), float(b.energy))
    return 0.0


def spread(release: PlanarRelease, quantity: str, step: Fraction, points: int) -> list[PlanarRelease]:
    """Return releases in steps of one quantity from a first one."""
    first = getattr(release, quantity)
    return [release._replace(**{quantity: first + k * step}) for k in range(points)]


def toss_many(
    coin: PlanarCoin, units: Units, releases: Iterable[PlanarRelease], *, to_contact: bool = False
) -> list[Toss]:
    """Toss coins.

    Args:
        coin: the coin.
        units: of it.
        releases: heads up.
        to_contact: whether a settled coin is followed until it lies.
    """
    with precision(BITS, ORDER):
        return [
            _toss(NumericToss(coin, to_contact=to_contact), released(*in_own_units(units, release)))
            for release in releases
        ]


def _toss(toss: "NumericToss", state: State) -> Toss:
    outcome = Outcome.UNDECIDED
    state.let(toss.kept)
    with suppress(UndecidedError):
        outcome = toss.run(state)
    return Toss(
        outcome=outcome,
        impacts=tuple(toss.impacts),
        contacts=tuple(toss.contacts),
        energy=float("nan" if toss.last_energy is None else toss.last_energy),
        from_upright=toss.nearest,
        flattest=toss.flattest,
    )


class NumericToss(PlanarToss):
    """The same motion in mere numbers, and contact of any kind."""

    def __init__(self, coin: PlanarCoin, *, to_contact: bool = False) -> None:
        """Take a coin, and whether it is followed until it lies when it is settled."""
        super().__init__(coin)
        self.to_contact = to_contact
        self.nearest = self.flattest = float("inf")

    def kept(self, x: Any) -> Any:
        """Return the middle of a number."""
        return x.mid()

    def touched(self, state: State) -> None:
        """Take note of how flat the coin touches before it is settled."""
        if self.energy(state) >= 1:
            self.flattest = min(self.flattest, abs(float(state.tilt)))

    def is_over(self, e: Any) -> bool:
        """Return whether a coin in flight is settled, and need not be followed further."""
        return e < 1 and not self.to_contact

    def chatter(self, state: State, corner: int) -> Any:
        """Stop the rim point where all its bounces to come are short; return what they lose from then on."""
        sinking = 1 - float(state.z * state.w**2)
        if sinking <= 0:
            return None
        v, limit = self.rim_velocity(state, corner), CHATTERING_ROUGH if self.coin.rough else CHATTERING
        # They last for 2 v/(sinking (1 - χ)).
        if 2 * v * (1 + abs(state.w) ** 3) >= limit * sinking**2 * (1 - self.chi):
            return None
        self.push(state, corner, -v)
        return arb(0)

    def from_upright(self, state: State) -> float:
        """Return how far a coin in contact is from standing upright at rest; see `Toss`."""
        return float((state.v**2 + self.J * state.w**2) / 2 + 1 - state.z)

    def contact(self, state: State, corner: int, loss: Any) -> tuple[tuple[int, ...], Any]:
        """Follow contact of any kind; return the rim points that leave the floor, and up to when freely."""
        if self.coin.in_air or self.coin.rough:
            return self.follow(state, corner)
        before, heads, rises = state.z, state.heads, state.v > 0
        left, start = super().contact(state, corner, loss)
        e = self.last_energy
        if heads != state.heads:
            top = 1
        elif start is not None:
            top = before.max(state.z)
        else:
            top = e if rises else before
        self.nearest = abs(float(e + 1 - 2 * top))
        return left, start

    def follow(self, state: State, corner: int) -> tuple[tuple[int, ...], Any]:
        """Follow a coin whose rim point rolls, or slides, until it lies flat or the floor would have to pull.

        A rim point that rolls slips freely where a rough floor would have to pull.
        """
        self.last_energy, self.nearest = self.energy(state), self.from_upright(state)
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
        for ctx.cap in range(2, ORDER + 1):
            rates, _ = self.rates(numbers, corner, rolls)
            numbers = [x + rate.integral() for x, rate in zip(start, rates, strict=True)]
        _, others = self.rates(numbers, corner, rolls)
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
