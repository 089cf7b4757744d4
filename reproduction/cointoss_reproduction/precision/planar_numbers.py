"""Many planar tosses, how each went, and where neighbours diverge."""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import ctx

from cointoss import Outcome
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_state import (
    Impact,
    State,
    UndecidedError,
    in_own_units,
    released,
)
from cointoss_reproduction.precision.planar_toss import BITS, PlanarToss

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
    with ctx.workprec(BITS):
        return [
            _toss(PlanarToss(coin, to_contact=to_contact), released(*in_own_units(units, release)))
            for release in releases
        ]


def _toss(toss: PlanarToss, state: State) -> Toss:
    outcome = Outcome.UNDECIDED
    state.keep_middles()
    with suppress(UndecidedError):
        outcome = toss.run(state)
    return Toss(
        outcome=outcome,
        impacts=tuple(toss.impacts),
        contacts=tuple(toss.contacts),
        from_upright=toss.nearest,
        flattest=toss.flattest,
    )
