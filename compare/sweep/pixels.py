"""The tosses of a part of a map."""

from collections.abc import Iterator
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep, Tile
from cointoss.compare.sweep.layers import layers_of, trust_layer
from cointoss.models.errors import ScenarioError
from cointoss.models.outcomes import Outcomes
from cointoss.models.records import Array
from cointoss.models.releases import Releases, changed_releases, check_releases
from cointoss.models.scenario import Scenario, keeping_all
from cointoss.models.stages import counted
from cointoss.models.unused import warn_of_unused_fields

_ENDS_SUFFICE = (
    "gravity",
    "coin.mass",
    "air.normal",
    "air.tangential",
    "floor.",
    "release.position.",
    "release.velocity.",
    "release.angular_velocity.",
    "ending.",
)
"""Fields in each of which all conditions on a scenario are monotone or convex."""


class Pixels(NamedTuple):
    """What is known of the pixels of a tile."""

    outcome: NDArray[np.int8]
    """`Outcome`, (y, x)."""
    impacts: NDArray[np.int32]
    """Number of impacts, (y, x)."""
    margin: Array | None = None
    """As of a `Margin`, (y, x); None where none is asked for."""
    trusted_impacts: NDArray[np.int32] | None = None
    """As of an `Outcomes`, (y, x); None where they are not asked for."""
    outcome_certain: NDArray[np.int8] | None = None
    """Likewise: 1 where the outcome is certain, 0 where it is not."""


class Group(NamedTuple):
    """Pixels whose tosses differ in their release alone."""

    scenario: Scenario
    """That of the first."""
    releases: Releases
    """Row by row."""
    rows: slice
    columns: slice


def toss_pixels(sweep: Sweep, tile: Tile) -> Pixels:
    """Toss all pixels of a tile.

    Raises:
        SweepError: for values that make no valid scenario.
        UnsupportedError: for a scenario that the engine can't toss.
    """
    y, x = sweep.y.values[tile.rows], sweep.x.values[tile.columns]
    whole: dict[str, NDArray[Any]] = {
        name: np.empty((len(y), len(x)), layer.kind) for name, layer in layers_of(sweep).items()
    }
    for group in groups(sweep, y, x):
        tossed = _toss(sweep, group.scenario, group.releases, trust=sweep.trust)
        parts: dict[str, NDArray[Any]] = {"outcome": _shown(sweep, tossed), "impacts": tossed.impacts}
        if sweep.margin is not None:
            parts["margin"] = _margins(sweep, group)
        if sweep.trust:
            parts[trust_layer(sweep.after)] = getattr(tossed, trust_layer(sweep.after))
        for name, part in parts.items():
            block = whole[name][group.rows, group.columns]
            block[:] = part.reshape(block.shape)
    return Pixels(**whole)


def _toss(sweep: Sweep, scenario: Scenario, releases: Releases, *, trust: bool = False) -> Outcomes:
    # These are of the analytic engine alone.
    asked = {"trusted_impacts": "horizon", "outcome_certain": "certain"}
    more: Any = {asked[trust_layer(sweep.after)]: True} if trust else {}
    return sweep.engine.package.toss_many(scenario, releases, settings=sweep.settings, **more)


def _shown(sweep: Sweep, tossed: Outcomes) -> NDArray[np.int8]:
    """Return the outcomes, or the faces at a touch, that the map shows."""
    return tossed.outcome if sweep.after is None else tossed.after(sweep.after)


def _margins(sweep: Sweep, group: Group) -> Array:
    from cointoss.compare.metrics.margin import MANY, smallest_changes

    def outcomes(releases: Releases) -> NDArray[np.int8]:
        return _shown(sweep, _toss(sweep, group.scenario, releases))

    quantity = sweep.quantity
    found = smallest_changes(group.scenario, group.releases, quantity, outcomes=outcomes, search=MANY)
    return found * quantity.factor


def pixel_scenario(sweep: Sweep, y: float, x: float) -> Scenario:
    """Give the scenario of the toss at a point of the map.

    Raises:
        SweepError: for values that make no valid scenario, naming them.
    """
    try:
        scenario = sweep.scenario.replace(*_given(sweep.y.field, y), *_given(sweep.x.field, x))
    except ScenarioError as error:
        raise SweepError(f"{error} (at {sweep.x.field} = {x:g}, {sweep.y.field} = {y:g})") from None
    if sweep.after is None:
        return scenario
    most = min(sweep.after + 1, scenario.rules.max_impacts)
    return scenario.replace("ending.max_impacts", most)


def _given(field: str, value: float) -> tuple[str, float]:
    """Return a field and its value; a number of impacts, whole on every axis, as an integer."""
    return field, int(value) if field == "ending.max_impacts" else value


def groups(sweep: Sweep, y: Array, x: Array) -> Iterator[Group]:
    """Give the tosses at points of the map, those of one coin on one floor together.

    Args:
        sweep: whose fields vary.
        y: values of the field of the rows, (ny,).
        x: values of the field of the columns, (nx,).
    """
    for rows, columns in _blocks(sweep, len(y), len(x)):
        first = pixel_scenario(sweep, float(y[rows][0]), float(x[columns][0]))
        yield Group(first, _releases(sweep, y[rows], x[columns]), rows, columns)


def check(sweep: Sweep) -> None:
    """Refuse a sweep with a pixel that is no valid scenario, or that its engine can't toss.

    Every value of an axis is tried, or its two ends where these suffice. Whether a field is used is asked of
    the pixel where both axes are farthest from 0.

    Raises:
        SweepError, ScenarioError: naming field, value, and what is accepted.
        UnsupportedError: likewise.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
    """
    y, x = _tried(sweep.y), _tried(sweep.x)
    rows_at_once = max(1, (1 << 14) // len(x))
    for top in counted("checking the grid", "parts", range(0, len(y), rows_at_once)):
        some = y[top : top + rows_at_once]
        for rows, columns in _blocks(sweep, len(some), len(x)):
            _check_together(sweep, some[rows], x[columns])
    largest = pixel_scenario(sweep, *(max(part.tolist(), key=abs) for part in (y, x)))
    warn_of_unused_fields(largest.floor, largest.air)
    if sweep.trust:
        keeping_all(largest.rules, largest)


def _check_together(sweep: Sweep, y: Array, x: Array) -> None:
    """Refuse points whose tosses can be made together."""
    first = pixel_scenario(sweep, float(y[0]), float(x[0]))
    sweep.engine.package.require_supported(first, settings=sweep.settings)
    try:
        check_releases(first, _releases(sweep, y, x))
    except ValueError:
        # One by one, as scenarios, which name the field.
        for at_y, at_x in product(y.tolist(), x.tolist()):
            pixel_scenario(sweep, at_y, at_x)
        raise


def _tried(axis: Axis) -> Array:
    return np.array([axis.start, axis.stop]) if axis.field.startswith(_ENDS_SUFFICE) else axis.values


def _blocks(sweep: Sweep, ny: int, nx: int) -> Iterator[tuple[slice, slice]]:
    """Give the rows and columns whose tosses can be made together."""
    yield from product(_parts(sweep.y, ny), _parts(sweep.x, nx))


def _parts(axis: Axis, count: int) -> list[slice]:
    return [slice(0, count)] if axis.is_of_release else [slice(i, i + 1) for i in range(count)]


def _releases(sweep: Sweep, y: Array, x: Array) -> Releases:
    varied = ((sweep.y, np.repeat(y, len(x))), (sweep.x, np.tile(x, len(y))))
    changed = {axis.field: values for axis, values in varied if axis.is_of_release}
    return changed_releases(sweep.scenario.release, len(y) * len(x), changed)
