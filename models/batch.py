"""Many scenarios as rows of numbers: made of one by changing fields, checked, and read back."""

import math
from collections.abc import Collection, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.models.describing import ends_of
from cointoss.models.entries import examine_each, roll_each
from cointoss.models.errors import ScenarioError
from cointoss.models.fields import COMPONENTS, FIELDS, PLACES, WORDED
from cointoss.models.kernel.arrays import Array
from cointoss.models.rows import FIRST, row_of
from cointoss.models.scenario import Scenario

PLACE = {field: i for i, field in enumerate(FIELDS)}
"""Where each field stands in a row."""
STATE = tuple(
    f"release.{part}.{name}"
    for part in ("position", "velocity", "quaternion", "angular_velocity")
    for name in COMPONENTS[f"release.{part}"]
)
"""The fields of a state at release, in the order of a state vector, (13,)."""
STATE_PLACES = [PLACE[field] for field in STATE]
_ANGLES, _QUATERNION = (
    [PLACE[f"{path}.{name}"] for name in COMPONENTS[path]]
    for path in ("release.angles", "release.quaternion")
)
_FOLLOWING = ("release.position.z", *(f"release.velocity.{axis}" for axis in "xyz"))
"""What follows of `release.rolls`."""
_INERTIA = [PLACE[field] for field in FIELDS if field.startswith("coin.inertia.")]


def rows_of(scenario: Scenario, n: int, changed: Mapping[str, ArrayLike] | None = None) -> Array:
    """Return n copies of a scenario as rows, with other values of some fields, (n, m).

    The angles and the quaternion of a release replace each other. `refused` checks the rows; this does not.

    Args:
        scenario: the scenario to copy.
        n: number of copies.
        changed: values by field, numbers in SI or the integers of words, (n,) each or one for all.

    Raises:
        ScenarioError: for a height or a velocity of a coin whose release rolls, but not for both as a whole.
    """
    changed = changed or {}
    base = row_of(scenario)
    if any(field.startswith("release.angles.") for field in changed):
        base[_ANGLES], base[_QUATERNION] = np.nan_to_num(base[_ANGLES]), math.nan
    elif any(field.startswith("release.quaternion.") for field in changed):
        base[_ANGLES], base[_QUATERNION] = math.nan, scenario.release.attitude
    if any(field.startswith("coin.inertia.") for field in changed):
        base[_INERTIA] = np.ravel(scenario.coin.moments)
    given = [field for field in _FOLLOWING if field in changed] if scenario.release.rolls else []
    if 0 < len(given) < len(_FOLLOWING):
        raise ScenarioError(f"{given[0]}: accepted: no such field with release.rolls, from which it follows")
    rows = np.tile(base, (n, 1))
    for field, values in changed.items():
        rows[:, PLACE[field]] = values
    if scenario.release.rolls and not given:
        roll_each(rows)
    return rows


def checked_table(name: str, table: ArrayLike, columns: int) -> Array:
    """Return a table of numbers as compiled code takes it, (n, columns).

    Raises:
        ValueError: naming the argument, its shape and what is accepted.
    """
    found = np.ascontiguousarray(table, dtype=float)
    if found.ndim != 2 or found.shape[1] != columns:
        raise ValueError(f"{name}: shape {np.shape(table)}, accepted: (n, {columns})")
    return found


def rows_from_states(scenario: Scenario, states: Array) -> Array:
    """Return a scenario released in each of many states, as rows, (n, m).

    Args:
        scenario: coin, air, floor and ending.
        states: position and velocity of C (space), Euler parameters and angular velocity (body), (n, 13).
    """
    return rows_of(scenario, len(states), dict(zip(STATE, states.T, strict=True)))


def states_of(rows: Array) -> Array:
    """Return the states at release of rows whose attitude is a quaternion, (n, 13)."""
    return rows[:, STATE_PLACES]


def scenario_of_row(row: Array, changed: Collection[str] = ()) -> Scenario:
    """Return the scenario of a row, checked like a scenario file.

    Args:
        row: of a scenario, or with other values of some fields.
        changed: the fields that may not be left out: not a number is refused there.

    Raises:
        ScenarioError: naming field, value and what is accepted.
    """
    tables: dict[str, object] = {}
    for field, place, first, value in zip(FIELDS, PLACES.values(), FIRST, row.tolist(), strict=True):
        if first >= 0 and math.isnan(row[first]) and math.isnan(value) and field not in changed:
            continue
        _put(tables, place, _as_given(field, value))
    return Scenario.checked({name: _with_lists(part) for name, part in tables.items()})


def _as_given(field: str, value: float) -> float | int | str:
    """Return a number of a row as a scenario file has it."""
    if field in WORDED and value in WORDED[field].by_value():
        return str(WORDED[field](int(value)))
    return int(value) if field == "ending.max_impacts" and value.is_integer() else value


def _put(tables: dict[str, object], place: tuple[str | int, ...], value: object) -> None:
    """Put a value into its place in tables and lists, creating those that are missing."""
    node: dict[str | int, object] = tables  # pyright: ignore[reportAssignmentType]
    for step in place[:-1]:
        node = node.setdefault(step, {})  # pyright: ignore[reportAssignmentType]
    node[place[-1]] = value


def _with_lists(node: object) -> object:
    """Return nested tables of which those with numbers for keys are lists."""
    if not isinstance(node, dict):
        return node
    inner = {key: _with_lists(part) for key, part in node.items()}
    return list(inner.values()) if 0 in inner else inner


_ENDS = [ends_of(place, Scenario) for place in PLACES.values()]
LEAST = np.array([ends.get("ge", -math.inf) for ends in _ENDS])
MOST = np.array([ends.get("le", math.inf) for ends in _ENDS])


def refused(rows: Array, changed: Collection[str]) -> NDArray[np.bool_]:
    """Return which rows are not valid scenarios, (n,).

    Args:
        rows: copies of a scenario with some fields changed, (n, m).
        changed: the changed fields, which may have any numbers.
    """
    wrong = np.zeros(len(rows), dtype=bool)
    for field in changed:
        values, i = rows[:, PLACE[field]], PLACE[field]
        wrong |= ~((values >= LEAST[i]) & (values <= MOST[i]) & np.isfinite(values))
        if field in WORDED:
            wrong |= ~np.isin(values, list(WORDED[field].by_value()))
        elif field == "ending.max_impacts":
            wrong |= np.mod(values, 1) != 0
    bounded = rows if not wrong.any() else rows[~wrong]
    faults = np.empty(len(bounded), dtype=np.int8)
    examine_each(np.ascontiguousarray(bounded), faults)
    wrong[~wrong] = faults != 0
    return wrong
