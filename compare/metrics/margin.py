"""The margin of a toss: the smallest change of its release that changes its outcome, by quantity."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from decimal import ROUND_UP, Context, Decimal

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.compare.metrics.quantity_names import LETTERS, NAMES, latin_name
from cointoss.models.batch import PLACE, refused, rows_of
from cointoss.models.entries import turn_each, write_attitudes
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.stages import counted

Codes = NDArray[np.int8]
"""Codes of `Outcome`."""
FINEST, DECADES = 1e-13, 13
"""Changes are tried from the finest on, in SI units; the last is 1."""
CUTS = 8
"""The number of parts into which a bisection cuts the change that was found."""
TOGETHER = 2048
"""About how many tosses are made together: enough to keep all cores busy."""


@dataclass(frozen=True, kw_only=True)
class SearchResolution:
    """How closely changes are searched."""

    per_decade: int
    """The number of changes that are tried in each decade."""
    bisections: int
    """How many times the change that was found is narrowed by the factor `CUTS`."""

    @property
    def ladder(self) -> Array:
        """The changes that are tried, in SI units."""
        steps = range(DECADES * self.per_decade + 1)
        return FINEST * np.array([float(10 ** (Decimal(i) / self.per_decade)) for i in steps])


FINE = SearchResolution(per_decade=4, bisections=8)
"""The resolution for one toss."""
MANY = SearchResolution(per_decade=2, bisections=2)
"""The resolution for many tosses: a third of the tosses."""


@dataclass(frozen=True)
class ReleaseQuantity:
    """A component of the release, and how a toss is changed along it."""

    name: str
    unit: str
    factor: float
    """The number of the quantity's units in one SI unit."""
    change: Callable[[Array, Array], Array]
    """Returns rows, (n, m), whose attitude is a quaternion, changed by numbers in SI units, (n,)."""
    fields: tuple[str, ...]
    """The fields of a row that it changes."""


@dataclass(frozen=True)
class Margin:
    """The smallest change along one quantity that was found to change the outcome."""

    quantity: ReleaseQuantity
    change: float
    """The change with its sign, in the quantity's unit; infinite where none up to 1 SI unit does."""

    @property
    def finite(self) -> float | None:
        """The change; None where there is none."""
        return self.change if math.isfinite(self.change) else None

    @property
    def line(self) -> str:
        """The margin for a person; rounded up, what was found stays an upper bound."""
        unit, change = self.quantity.unit, self.finite
        found = f"none found up to {self.quantity.factor:g} {unit}"
        if change is not None:
            found = f"{float(Context(prec=3, rounding=ROUND_UP).create_decimal(change)):+.3g} {unit}"
        return f"margin    {self.quantity.name:18}  {found}"


Differ = Callable[[NDArray[np.intp], Array], tuple[NDArray[np.bool_], NDArray[np.bool_]]]
"""Returns which changes, (rows, rungs), of some rows make a difference, and which are accepted."""

_ATTITUDE = tuple(field for field in PLACE if field.startswith(("release.angles.", "release.quaternion.")))
_QUATERNION = _ATTITUDE[3:]
_A, _Q = ([PLACE[field] for field in fields] for fields in (_ATTITUDE[:3], _QUATERNION))


def _moved(name: str, unit: str, factor: float, field: str) -> ReleaseQuantity:
    def change(rows: Array, by: Array) -> Array:
        changed = rows.copy()
        changed[:, PLACE[field]] += by
        return changed

    return ReleaseQuantity(name, unit, factor, change, (field,))


def _turned(name: str, axis: int) -> ReleaseQuantity:
    def change(rows: Array, by: Array) -> Array:
        changed, attitudes = rows.copy(), np.ascontiguousarray(rows[:, _Q])
        turn_each(attitudes, by[:, None] * np.eye(3)[axis])
        changed[:, _Q] = attitudes
        return changed

    return ReleaseQuantity(name, "rad", 1.0, change, _QUATERNION)


def with_quaternions(rows: Array) -> Array:
    """Return rows whose attitude is a quaternion of norm 1, (n, m)."""
    found, attitudes = rows.copy(), np.empty((len(rows), 4))
    write_attitudes(found, attitudes)
    found[:, _A], found[:, _Q] = math.nan, attitudes
    return found


QUANTITIES = (
    _moved("height", "mm", 1e3, "release.position.z"),
    *(_moved(f"velocity {axis}", "mm/s", 1e3, f"release.velocity.{axis}") for axis in "xyz"),
    *(_turned(f"attitude about {greek}", i) for i, greek in enumerate(LETTERS.values())),
    *(
        _moved(f"spin about {greek}", "rad/s", 1.0, f"release.angular_velocity.{latin}")
        for latin, greek in LETTERS.items()
    ),
)
"""Horizontal position is left out: it changes nothing."""


def quantity_of(name: str) -> ReleaseQuantity:
    """Return the quantity of a name, its axis in Greek or Latin letters.

    Raises:
        ValueError: saying what is accepted.
    """
    return dict(zip(NAMES, QUANTITIES, strict=True))[latin_name(name)]


def margins(scenario: Scenario, *, settings: analytic.AnalyticSettings = analytic.MANY) -> tuple[Margin, ...]:
    """Return the margin of a scenario's toss along each of `QUANTITIES`.

    Changes are tried on a ladder, up and down; the first that changes the outcome is cut down by bisection.
    A stripe between two rungs goes unseen, so the margin is an upper bound.

    Args:
        scenario: whose coin is tossed.
        settings: of the engine.
    """
    start = rows_of(scenario, 1)

    def outcomes(rows: Array) -> Codes:
        return analytic.toss_rows(rows, settings=settings).outcome

    return tuple(
        Margin(one, one.factor * float(smallest_changes(start, one, outcomes=outcomes, search=FINE)[0]))
        for one in counted("margins", "quantities", QUANTITIES)
    )


def smallest_changes(
    rows: Array, quantity: ReleaseQuantity, *, outcomes: Callable[[Array], Codes], search: SearchResolution
) -> Array:
    """Return the margin of each of many tosses along a quantity, with its sign, in SI units, (n,).

    It is infinite where no change up to 1 does, or none before one that makes no scenario.

    Args:
        rows: of the tosses, each a scenario's, (n, m).
        quantity: what changes.
        outcomes: returns the outcomes of rows, or what else of them is not to change.
        search: how closely.
    """
    start = with_quaternions(rows)
    own = outcomes(start)

    def differ(which: NDArray[np.intp], by: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        changed = quantity.change(np.repeat(start[which], by.shape[1], axis=0), by.ravel())
        kept = ~refused(changed, quantity.fields)
        before = np.repeat(own[which], by.shape[1])
        codes = before.copy()
        if kept.any():
            codes[kept] = outcomes(changed[kept])
        return (codes != before).reshape(by.shape), kept.reshape(by.shape)

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
    rows, signs = np.tile(np.arange(n), 2), np.repeat([[1.0], [-1.0]], n, axis=0)
    low, high, is_open = np.zeros(2 * n), np.full(2 * n, np.inf), np.ones(2 * n, dtype=bool)
    ladder, done = search.ladder, 0
    while done < len(ladder):
        known = np.isfinite(high)
        left = np.flatnonzero(is_open & ~(known | np.roll(known, n) if nearest else known))
        if not len(left):
            break
        rungs = ladder[done : done + max(1, TOGETHER // len(left))]
        differs, kept = differ(rows[left], signs[left] * rungs)
        kept = np.logical_and.accumulate(kept, axis=1)  # all that a scenario would accept
        differs &= kept
        is_open[left] = kept[:, -1]
        first, found = np.argmax(differs, axis=1), differs.any(axis=1)
        before = np.concatenate([[ladder[done - 1] if done else 0.0], rungs])
        high[left[found]], low[left[found]] = rungs[first[found]], before[first[found]]
        done += len(rungs)
    met = np.flatnonzero(np.isfinite(high))
    ends, each = (low[met], high[met]), np.arange(len(met))
    for _ in range(search.bisections):
        cuts = np.linspace(*ends, CUTS + 1, axis=1)
        differs, _ = differ(rows[met], signs[met] * cuts[:, 1:-1])
        # The last is known to differ.
        first = np.argmax(np.column_stack([differs, np.ones(len(met), dtype=bool)]), axis=1)
        ends = cuts[each, first], cuts[each, first + 1]
    high[met] = ends[1]
    return high.reshape(2, n)
