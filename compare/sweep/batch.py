"""A batch: a scenario some of whose fields vary, each along some dimensions."""

import math
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import NUMBERS, axis_of, ends_of, named, number, unit_of, word_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.answers import COLUMNS
from cointoss.models.batch import refused, rows_of, scenario_of_row
from cointoss.models.errors import ScenarioError, shown
from cointoss.models.fields import COMPONENTS, FIELDS, WORDED, direction_of
from cointoss.models.labelled import meanings_of
from cointoss.models.names import SPIN
from cointoss.models.parts import Part
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.unlikely import UnitWarning, unlikely_units

TOSS = "toss"
"""The dimension of arrays of one axis that have no other name for it."""
MOST_ROWS = 10**12
TOGETHER = 1 << 16
"""Rows that are checked together."""
_PARTS = ("coin", "coin.inertia", "air", "floor", "release", "ending")
KNOWN = (*NUMBERS, *(field for field in FIELDS if field not in NUMBERS), *COMPONENTS, *_PARTS)
"""All that may vary or be set: numbers, words, lists of numbers, and whole parts of a scenario."""
_ENDS_SUFFICE = (
    "gravity",
    "coin.mass",
    "air.normal",
    "air.tangential",
    "floor.",
    "release.position.",
    "release.velocity.",
    "release.angular_velocity.",
    "release.spin",
    "ending.max_time",
    "ending.caught",
)
"""Fields in each of which all conditions on a scenario are monotone or convex."""
_ACCEPTED = (
    'accepted: a number or a text with its unit, a range such as "20:60:400" or (20, 60, 400), an array that '
    "broadcasts with the others, or a DataArray"
)


_RANGE = "START:STOP:N as text, or (START, STOP, N); values that are listed stand in a list or an array"


@dataclass(frozen=True, kw_only=True, eq=False)
class Varied:
    """A field that varies over a batch."""

    field: str
    dims: tuple[str, ...]
    values: NDArray[Any]
    """Numbers in SI, or the integers of words, over `dims`; read-only."""

    @property
    def words(self) -> dict[int, str] | None:
        """What its integers mean; None for numbers."""
        return WORDED[self.field].by_value() if self.field in WORDED else None


@dataclass(frozen=True, kw_only=True, eq=False)
class Batch:
    """A scenario, and the fields of it that vary; its tosses are numbered in the order of a C array."""

    scenario: Scenario
    """With the values of all fields that do not vary."""
    varied: tuple[Varied, ...]
    sizes: dict[str, int]
    """The lengths of the dimensions, the last varying fastest."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of the dimensions."""
        return tuple(self.sizes.values())

    def __len__(self) -> int:
        """Return the number of tosses."""
        return math.prod(self.shape)

    @cached_property
    def _columns(self) -> tuple[Varied, ...]:
        """What varies, in fields of a row."""
        return tuple(column for one in self.varied for column in _in_a_row(one, self.scenario))

    @property
    def fields(self) -> list[str]:
        """The fields of a row that vary."""
        return [column.field for column in self._columns]

    @property
    def coordinates(self) -> dict[str, tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]]:
        """The dimensions, the values and the attributes of what varies, by field, as xarray takes them."""
        return {one.field: (one.dims, one.values, attributes_of(one, self.scenario)) for one in self.varied}

    def rows(self, tosses: NDArray[np.intp]) -> Array:
        """Return some tosses, by their numbers, as rows, (n, m)."""
        at = dict(zip(self.sizes, np.unravel_index(tosses, self.shape), strict=True)) if self.sizes else {}
        changed = {one.field: one.values[tuple(at[dim] for dim in one.dims)] for one in self._columns}
        return rows_of(self.scenario, len(tosses), changed)

    def scenario_at(self, toss: int) -> Scenario:
        """Return the scenario of a toss, by its number.

        Raises:
            ScenarioError: naming field, value and what is accepted, and the toss.
        """
        try:
            return scenario_of_row(self.rows(np.array([toss]))[0], self.fields)
        except ScenarioError as error:
            raise ScenarioError(f"{error}{self._place(toss)}") from None

    def _place(self, toss: int) -> str:
        """Return which toss it is, for a person."""
        if not self.sizes:
            return ""
        at = dict(zip(self.sizes, np.unravel_index(toss, self.shape), strict=True))
        values = [(one, one.values[tuple(at[dim] for dim in one.dims)]) for one in self.varied[:3]]
        told = [f"{one.field} = {one.words[int(x)] if one.words else f'{x:g}'}" for one, x in values]
        where = ", ".join(
            f"{dim} {i}" for dim, i in at.items() if dim not in [one.field for one in self.varied]
        )
        return f" (at {', '.join(filter(None, [where, *told]))})"

    def tried(self) -> Iterator[NDArray[np.intp]]:
        """Yield the numbers of tosses of which all are scenarios where these are, `TOGETHER` at a time.

        Of an axis along which the conditions are monotone or convex the two ends suffice.
        """
        kept = [self._tried_along(dim) for dim in self.sizes]
        count = math.prod(map(len, kept))
        for first in range(0, count, TOGETHER):
            numbers = np.arange(first, min(first + TOGETHER, count))
            at = np.unravel_index(numbers, [len(one) for one in kept]) if kept else ()
            chosen = tuple(one[i] for one, i in zip(kept, at, strict=True))
            yield np.ravel_multi_index(chosen, self.shape) if kept else np.zeros(1, dtype=np.intp)

    def _tried_along(self, dim: str) -> NDArray[np.intp]:
        along = [one for one in self.varied if dim in one.dims]
        (one, *others), n = along or [None], self.sizes[dim]
        if (
            one is None
            or others
            or len(one.dims) > 1
            or one.field in WORDED
            or n < 2
            or not one.field.startswith(_ENDS_SUFFICE)
            or not np.isfinite(one.values).all()
        ):
            return np.arange(n)
        return np.unique([np.argmin(one.values), np.argmax(one.values)])

    def check(self) -> None:
        """Refuse a batch with a toss that is no scenario.

        Raises:
            ScenarioError: for the first one, naming field, value and what is accepted, and the toss.
        """
        for tosses in self.tried():
            wrong = refused(self.rows(tosses), self.fields)
            if wrong.any():
                self.scenario_at(int(tosses[np.argmax(wrong)]))  # says why
                raise AssertionError("a row that is refused makes a scenario")

    def largest(self) -> Scenario:
        """Return the scenario where what varies is farthest from 0, as far as that goes together."""
        at = dict.fromkeys(self.sizes, 0)
        for one in reversed(self.varied):
            if one.field not in WORDED and one.values.size:
                farthest = np.unravel_index(int(np.argmax(np.abs(one.values))), one.values.shape)
                at |= dict(zip(one.dims, map(int, farthest), strict=True))
        return self.scenario_at(int(np.ravel_multi_index(tuple(at.values()), self.shape)) if at else 0)


def batch_of(scenario: ScenarioSource, vary: Mapping[str, Any] | None = None) -> Batch:
    """Return the batch of a scenario in which some fields vary, or are others.

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package.
        vary: by field: a number, a text with a unit, or a word, for all tosses; a range START:STOP:N, as text
            or tuple, along a dimension of its own, named by the field; an array, which broadcasts with the
            other arrays as in NumPy; or a DataArray of xarray, whose dimensions have names. A field may be
            named in part, as "restitution", a list of components as a whole, as "release.position".

    Raises:
        ScenarioError: for a scenario that can't be used.
        SweepError: naming the field, what was given and what is accepted.

    Warns:
        UnitWarning: for a number that was probably meant in another unit.
    """
    described = asked = scenario_of(scenario)
    if not isinstance(vary, Mapping | None):
        raise SweepError(
            f'vary: {shown(vary)}, accepted: a dict such as {{"floor.restitution": "0.4:0.9:6"}}'
        )
    given: dict[str, Any] = {}
    for name, value in (vary or {}).items():
        for field, part in _components(named(name, KNOWN), value):
            _require_once(field, given)
            given[field] = part
    fixed = {field: value for field, value in given.items() if _is_one(field, value)}
    for field, value in fixed.items():
        described = described.replace(field, value)
    batch = _batch(described, {field: value for field, value in given.items() if field not in fixed})
    known = _doubts(asked, {})  # told by whoever made the scenario, as of ranges by their axis
    arrays = {
        one.field: one.values.max() for one in batch.varied if not _is_range(one.field, given[one.field])
    }
    for field, doubt in _doubts(described, arrays).items():
        if doubt != known.get(field):
            warnings.warn(doubt, UnitWarning, stacklevel=3)  # in the line that calls toss_many
    return batch


def _doubts(described: Scenario, largest: Mapping[str, float]) -> dict[str, str]:
    return unlikely_units(described.gravity, described.coin, described.release, described.ending, largest)


def _batch(described: Scenario, given: Mapping[str, Any]) -> Batch:
    arrays = {
        field: _numbers(field, value, described)
        for field, value in given.items()
        if not _is_range(field, value) and not hasattr(value, "dims")
    }
    together = _together(arrays)
    varied: list[Varied] = []
    labels: dict[str, Any] = {}
    sizes: dict[str, int] = {}
    for field, value in given.items():
        if field in arrays:
            one = _named_by(field, arrays[field], together)
            sizes |= {dim: size for dim, size in together.items() if dim not in sizes}
        elif _is_range(field, value):
            axis = axis_of(field, ends_of(field, value, 3, _RANGE), described)
            one = Varied(field=field, dims=(field,), values=axis.values)
        else:
            numbers = _numbers(field, value.values, described) * _factor(field, value.attrs, described)
            one = Varied(field=field, dims=tuple(map(str, value.dims)), values=numbers)
            if taken := set(one.dims) & set(COLUMNS):
                raise SweepError(f"{field}: along {min(taken)}, accepted: a dimension of another name")
            for dim, index in value.indexes.items():
                if not labels.setdefault(str(dim), index).equals(index):
                    raise SweepError(f"{field}: other labels along {dim} than the others have")
        for dim, size in zip(one.dims, one.values.shape, strict=True):
            if sizes.setdefault(dim, size) != size:
                raise SweepError(f"{field}: {size} along {dim}, accepted: {sizes[dim]}, as the others have")
            if not size:
                raise SweepError(f"{field}: empty, accepted: one value or more")
        one.values.setflags(write=False)
        varied.append(one)
    if math.prod(sizes.values()) > MOST_ROWS:
        raise SweepError(f"vary: {math.prod(sizes.values()):g} tosses, accepted: at most {MOST_ROWS:g}")
    return Batch(scenario=described, varied=tuple(varied), sizes=sizes)


def _components(field: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the components of a list of numbers that varies as a whole; another field as it is."""
    shape, is_named = _shape(value), hasattr(value, "dims")
    if field in COMPONENTS and (is_named or len(shape) > 1):
        names = COMPONENTS[field]
        if shape[-1:] != (len(names),):
            raise SweepError(f"{field}: shape {shape}, accepted: (n, {len(names)})")
        each = value if is_named else np.asarray(value)
        for i, name in enumerate(names):
            yield f"{field}.{name}", each[..., i]
    else:
        yield field, value


def _require_once(field: str, given: Mapping[str, Any]) -> None:
    """Refuse a field that is given twice, by two names or as a part of what is given."""
    spin = "release.angular_velocity"
    for other in given:
        first, second = (spin if one == SPIN else one for one in (field, other))
        attitudes = {first.rpartition(".")[0] or first, second.rpartition(".")[0] or second}
        inside = first == second or first.startswith(f"{second}.") or second.startswith(f"{first}.")
        if field == other or inside:
            raise SweepError(f"{field}: given beside {other}, accepted: each field once")
        if attitudes == {"release.angles", "release.quaternion"}:
            raise SweepError(f"{field}: given beside {other}, accepted: angles or a quaternion")


def _is_one(field: str, value: Any) -> bool:
    """Return whether a value is the same for all tosses."""
    is_whole = isinstance(value, Part) or field in _PARTS or field in COMPONENTS
    return is_whole or not (_is_range(field, value) or hasattr(value, "dims") or _shape(value))


def _shape(value: Any) -> tuple[int, ...]:
    """Return the shape of an array or of lists, whose inner ones may be of different lengths."""
    try:
        return np.shape(value)
    except ValueError:
        return (len(value),)


def _is_range(field: str, value: Any) -> bool:
    """Return whether a value is a range, which no word has: a text with colons, or a tuple."""
    is_text = isinstance(value, str) and value.count(":") == 2
    return field not in WORDED and (is_text or isinstance(value, tuple))


def _numbers(field: str, value: Any, described: Scenario) -> NDArray[Any]:
    """Return numbers in SI, or the integers of words, of an array or a list."""
    try:
        array = np.ma.filled(value.astype(float), np.nan) if np.ma.isMA(value) else np.asarray(value)
    except ValueError:  # lists of different lengths
        raise SweepError(f"{field} = {shown(value)}: {_ACCEPTED}") from None
    if field in WORDED:
        kind = WORDED[field]
        try:
            return np.array([kind(one).value for one in array.ravel().tolist()]).reshape(array.shape)
        except ValueError as error:
            raise SweepError(f"{field}: {error}") from None
    if array.dtype.kind in "US":
        unit = unit_of(field, described) if field in NUMBERS else "kg*m**2"
        flat = [number(field, one, unit) for one in array.ravel().tolist()]
        return np.array(flat, dtype=float).reshape(array.shape)
    if array.dtype.kind not in "iuf":
        raise SweepError(f"{field} = {shown(value)}: {_ACCEPTED}")
    return np.array(array, dtype=float)


def _factor(field: str, attributes: Mapping[str, Any], described: Scenario) -> float:
    """Return how many SI units the unit is that a DataArray says it has."""
    unit = attributes.get("units")
    return number(field, f"1 {unit}", unit_of(field, described)) if unit and field in NUMBERS else 1


def _together(arrays: Mapping[str, NDArray[Any]]) -> dict[str, int]:
    """Return the dimensions, and their lengths, over which arrays without names broadcast.

    Raises:
        SweepError: where they do not.
    """
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        told = ", ".join(f"{field} {array.shape}" for field, array in arrays.items())
        raise SweepError(f"{told}: shapes that do not broadcast, accepted: those that do in NumPy") from None
    return {TOSS: shape[0]} if len(shape) == 1 else {f"dim_{i}": size for i, size in enumerate(shape)}


def _named_by(field: str, array: NDArray[Any], together: dict[str, int]) -> Varied:
    """Return an array with the names of its dimensions, without those along which it is broadcast."""
    own = zip(list(together.items())[len(together) - array.ndim :], array.shape, strict=True)
    kept = {dim: size for (dim, size), given in own if given == size}
    return Varied(field=field, dims=tuple(kept), values=array.reshape(tuple(kept.values())))


def _in_a_row(one: Varied, described: Scenario) -> Iterator[Varied]:
    """Yield what varies in fields of a row: a spin as components of the angular velocity."""
    if one.field != SPIN:
        yield one
        return
    described.replace(SPIN, 1.0)  # says why, of a coin without an axis
    direction = direction_of(described.release.angular_velocity)
    for name, part in zip(COMPONENTS["release.angular_velocity"], direction, strict=True):
        yield Varied(field=f"release.angular_velocity.{name}", dims=one.dims, values=part * one.values)


def attributes_of(one: Varied, described: Scenario) -> dict[str, Any]:
    """Return the attributes of a coordinate, from which plots take its label, and what its integers mean."""
    about: dict[str, Any] = {"long_name": word_of(one.field)}
    if one.words is not None:
        return about | meanings_of(one.words)
    return about | ({"units": unit_of(one.field, described)} if one.field in NUMBERS else {})
