"""The state of a planar coin in long arithmetic, its release, and its impacts."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from flint import arb, ctx, fmpq

from cointoss_reproduction.precision.planar_coin import PlanarRelease, Units, square_root

_NAMES = ("z", "v", "tilt", "w", "u")


class UndecidedError(Exception):
    """A limit is reached, or an enclosure is too wide."""


class Impact(NamedTuple):
    """An impact as it is known, in the coin's own units."""

    heads: bool
    """Whether heads is up."""
    corner: int
    """The rim point that touches, 1 or -1: it lies at `corner` (cos θ, sin θ) from C."""
    impulse: Any
    """The impulse, upward."""
    state: tuple[Any, Any, Any]
    """Height of C, its velocity and the spin, after the impact."""
    energy: Any
    """The energy after the impact."""


@dataclass
class State:
    """The state of the coin in its own units, enclosures of numbers."""

    z: Any
    v: Any
    tilt: Any
    w: Any
    u: Any
    heads: bool = True

    def keep_middles(self) -> None:
        """Keep of the enclosure of each number its middle."""
        for name in _NAMES:
            setattr(self, name, getattr(self, name).mid())


def ball(number: Fraction) -> Any:
    """Return the enclosure of a number."""
    return arb(fmpq(number.numerator, number.denominator))


def in_own_units(units: Units, release: PlanarRelease) -> list[Any]:
    """Return enclosures of height, spin and tilt."""
    time = square_root(units.length / units.gravity, 2 * ctx.prec)
    return [ball(x) for x in (release.height / units.length, release.spin * time, release.tilt)]


def released(height: Any, spin: Any, tilt: Any) -> State:
    """Return the state of a coin released at rest but for its spin, of its numbers in its own units."""
    return State(z=height, v=arb(0), tilt=tilt, w=spin, u=arb(0))


def sign(x: Any) -> int:
    """Return the sign of a number that is proved not to be 0."""
    if x > 0:
        return 1
    if x < 0:
        return -1
    raise UndecidedError
