"""The margin of a toss: the smallest change of its release that changes its outcome, by quantity."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from decimal import ROUND_DOWN, ROUND_UP, Context

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.compare.metrics.release_arrays import chosen
from cointoss.models.records import Array
from cointoss.models.releases import Releases, changed_releases, check_releases
from cointoss.models.scenario import Scenario
from cointoss.models.stages import counted

Codes = NDArray[np.int8]
"""Codes of `Outcome`."""
FINEST, DECADES = 1e-13, 13
"""Changes are tried from the finest on, in SI units; the last is 1."""
CUTS = 8
"""Parts into which a bisection cuts the change that was found."""
TOGETHER = 2048
"""Tosses that are made together, about: they keep all cores busy."""


@dataclass(frozen=True, kw_only=True)
class SearchResolution:
    """How closely changes are searched."""

    per_decade: int
    """Changes that are tried in each decade."""
    bisections: int
    """The change that is found is cut down so many times by `CUTS`."""

    @property
    def ladder(self) -> Array:
        """The changes that are tried, in SI units."""
        return FINEST * 10 ** (np.arange(DECADES * self.per_decade + 1) / self.per_decade)


FINE = SearchResolution(per_decade=4, bisections=8)
"""The resolution for one toss."""
MANY = SearchResolution(per_decade=2, bisections=2)
"""The resolution for many tosses: a third of the tosses."""


@dataclass(frozen=True)
class Quantity:
    """A component of the release, and how a toss is changed along it."""

    name: str
    unit: str
    factor: float
    """The number of its units in one SI unit."""
    change: Callable[[Releases, Array], Releases]
    """Adds numbers, in SI units, to releases of one coin."""


@dataclass(frozen=True)
class Margin:
    """The smallest change along one quantity that was found to change the outcome."""

    quantity: Quantity
    change: float
    """The change with its sign, in the quantity's unit; infinite where none up to 1 SI unit does."""
    proved: float = 0.0
    """No smaller change to either side does, in the quantity's unit, rounded down to two digits; 0 where that
    is not proved."""

    @property
    def finite(self) -> float | None:
        """The change; None where there is none."""
        return self.change if math.isfinite(self.change) else None

    @property
    def line(self) -> str:
        """The margin for a person; rounded up, what was found stays an upper bound."""
        unit = self.quantity.unit
        found = f"none found up to {self.quantity.factor:g} {unit}"
        if self.finite is not None:
            found = f"{_rounded(self.change, 3, ROUND_UP):+.3g} {unit}"
        if self.proved:
            found += f", proved to be above {self.proved:.2g} {unit}"
        return f"margin    {self.quantity.name:18}  {found}"


def _rounded(number: float, digits: int, rounding: str) -> float:
    return float(Context(prec=digits, rounding=rounding).create_decimal(number))


Differ = Callable[[NDArray[np.intp], Array], tuple[NDArray[np.bool_], NDArray[np.bool_]]]
"""Returns which changes, (rows, rungs), of some rows make a difference, and which are accepted."""
Proof = Callable[[Scenario, Quantity, float], float]
"""Returns how far a release may change with a proof that the outcome stays, given a change that changes it
along a quantity, both in SI units; 0 where none is proved."""


def _moved(field: str, axis: int) -> Callable[[Releases, Array], Releases]:
    def change(start: Releases, by: Array) -> Releases:
        return replace(start, **{field: getattr(start, field) + by[:, None] * np.eye(3)[axis]})

    return change


def _turned(axis: int) -> Callable[[Releases, Array], Releases]:
    def change(start: Releases, by: Array) -> Releases:
        e0, e = start.quaternion[:, 0], start.quaternion[:, 1:]
        cosine, sine = np.cos(by / 2), np.sin(by / 2)
        u = np.eye(3)[axis]
        turned = cosine[:, None] * e + sine[:, None] * (e0[:, None] * u + np.cross(e, u))
        first = cosine * e0 - sine * (e @ u)
        return replace(start, quaternion=np.column_stack([first, turned]))

    return change


QUANTITIES = (
    Quantity("height", "mm", 1e3, _moved("position", 2)),
    *(Quantity(f"velocity {axis}", "mm/s", 1e3, _moved("velocity", i)) for i, axis in enumerate("xyz")),
    *(Quantity(f"attitude about {axis}", "rad", 1.0, _turned(i)) for i, axis in enumerate(("ξ", "η", "ζ"))),
    *(
        Quantity(f"spin about {axis}", "rad/s", 1.0, _moved("angular_velocity", i))
        for i, axis in enumerate(("ξ", "η", "ζ"))
    ),
)
"""Horizontal position is left out: it changes nothing."""


def quantity_of(name: str) -> Quantity:
    """Return the quantity of a name, its axis in Greek or Latin letters.

    Raises:
        ValueError: naming what is accepted.
    """
    known = {_latin(quantity.name): quantity for quantity in QUANTITIES}
    if _latin(name) not in known:
        raise ValueError(f"{name}: accepted: {', '.join(known)}")
    return known[_latin(name)]


def _latin(name: str) -> str:
    return name.replace("ξ", "xi").replace("η", "eta").replace("ζ", "zeta")


def is_planar(scenario: Scenario) -> bool:
    """Return whether a thin coin is released flat in vacuum, at rest but for its spin about ξ."""
    release = scenario.release
    others = (*release.velocity, *release.attitude[1:], *release.angular_velocity[1:])
    return not (scenario.coin.thickness or any(others) or any(scenario.body.drag))


def margins(
    scenario: Scenario,
    proved_change: Proof | None = None,
    *,
    settings: analytic.AnalyticSettings = analytic.MANY,
) -> tuple[Margin, ...]:
    """Return the margin of a scenario's toss along each of `QUANTITIES`.

    Changes are tried on a ladder, up and down; the first that changes the outcome is cut down by bisection.
    A stripe between two rungs goes unseen, so the margin is an upper bound.

    Args:
        scenario: whose coin is tossed.
        proved_change: gives a lower bound too; none is given without.
        settings: of the engine.
    """
    start = changed_releases(scenario.release, 1, {})

    def outcomes(releases: Releases) -> Codes:
        return analytic.toss_many(scenario, releases, settings=settings).outcome

    def margin_along(quantity: Quantity) -> Margin:
        found = smallest_changes(scenario, start, quantity, outcomes=outcomes, search=FINE)
        change = float(found[0])
        proved = proved_change(scenario, quantity, change) if proved_change else 0.0
        proved = _rounded(proved * quantity.factor, 2, ROUND_DOWN)
        return Margin(quantity, change * quantity.factor, proved)

    return tuple(map(margin_along, counted("margins", "quantities", QUANTITIES)))


def smallest_changes(
    scenario: Scenario,
    start: Releases,
    quantity: Quantity,
    *,
    outcomes: Callable[[Releases], Codes],
    search: SearchResolution,
) -> Array:
    """Return the margin of each of many tosses along a quantity, with its sign, in SI units, (n,).

    It is infinite where no change up to 1 does, or none before one that the scenario would refuse.
    """
    own = outcomes(start)

    def differ(rows: NDArray[np.intp], by: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        changed = quantity.change(chosen(start, np.repeat(rows, by.shape[1])), by.ravel())
        kept = accepted(scenario, changed)
        codes = np.repeat(own[rows], by.shape[1])
        if kept.any():
            codes[kept] = outcomes(chosen(changed, np.flatnonzero(kept)))
        return (codes != np.repeat(own[rows], by.shape[1])).reshape(by.shape), kept.reshape(by.shape)

    up, down = changes_both_ways(len(start), differ, search, nearest=True)
    return np.where(down < up, -down, up)


def changes_both_ways(n: int, differ: Differ, search: SearchResolution, *, nearest: bool = False) -> Array:
    """Return the smallest changes upwards, and downwards, that make a difference to each of many, (2, n).

    They are infinite where none on the ladder does, or none before one that is not accepted.

    Args:
        n: how many.
        differ: which of some changes make a difference.
        search: how closely.
        nearest: whether the smaller of both is enough; the other may then be infinite.
    """
    signs, ladder = np.array([1.0, -1.0]), search.ladder
    low, high, is_open = np.zeros((2, n)), np.full((2, n), np.inf), np.ones((2, n), dtype=bool)
    done = 0
    while done < len(ladder):
        unknown = np.isinf(high) & is_open
        left = np.flatnonzero(np.isinf(high).all(axis=0) if nearest else unknown.any(axis=0))
        if not len(left):
            break
        rungs = ladder[done : done + max(1, TOGETHER // (2 * len(left)))]
        for side, sign in enumerate(signs):
            rows = left[unknown[side, left]]
            differs, kept = differ(rows, np.tile(sign * rungs, (len(rows), 1)))
            kept = np.logical_and.accumulate(kept, axis=1)  # all that a scenario would accept
            differs &= kept
            is_open[side, rows] = kept[:, -1]
            first = np.argmax(differs, axis=1)
            found = differs.any(axis=1)
            before = np.concatenate([[ladder[done - 1] if done else 0.0], rungs])
            high[side, rows[found]], low[side, rows[found]] = rungs[first[found]], before[first[found]]
        done += len(rungs)
    for side, sign in enumerate(signs):
        rows = np.flatnonzero(np.isfinite(high[side]))
        ends = low[side, rows], high[side, rows]
        for _ in range(search.bisections):
            cuts = np.linspace(*ends, CUTS + 1, axis=1)
            differs, _ = differ(rows, sign * cuts[:, 1:-1])
            # The last is known to differ.
            first = np.argmax(np.column_stack([differs, np.ones(len(rows), dtype=bool)]), axis=1)
            each = np.arange(len(rows))
            ends = cuts[each, first], cuts[each, first + 1]
        high[side, rows] = ends[1]
    return high


def accepted(scenario: Scenario, releases: Releases) -> NDArray[np.bool_]:
    """Return which releases a scenario with this coin, air and gravity would accept, (n,)."""
    try:
        check_releases(scenario, releases)
    except ValueError:
        if len(releases) == 1:
            return np.zeros(1, dtype=bool)
        halves = np.array_split(np.arange(len(releases)), 2)
        return np.concatenate([accepted(scenario, chosen(releases, half)) for half in halves])
    return np.ones(len(releases), dtype=bool)
