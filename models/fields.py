"""The fields of a scenario as its parts declare them: their words, units, and places in a row of numbers."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args

import numpy as np
from pydantic import BaseModel

from cointoss.models.errors import ScenarioError, shown
from cointoss.models.kernel.vectors import norm
from cointoss.models.parts import (
    BODY,
    Air,
    Coin,
    EndingCriteria,
    Floor,
    Part,
    Release,
)
from cointoss.models.quantities import Gravity, Label, Quantity
from cointoss.models.units import in_si
from cointoss.models.words import Word

TABLES: Mapping[str, type[Part]] = {
    "coin": Coin,
    "air": Air,
    "floor": Floor,
    "release": Release,
    "ending": EndingCriteria,
}
"""The tables of a scenario file."""
Place = tuple[str | int, ...]
"""Where a number or a word stands in the tables: table, key, and index or indices in a list."""


def _declared() -> Iterator[tuple[str, Any, tuple[Any, ...]]]:
    """Yield each field that a table has, its type, and what is declared of it beside the type."""
    kind, *declared = get_args(Gravity)
    yield "gravity", kind, tuple(declared)
    for table, part in TABLES.items():
        for key, field in part.model_fields.items():
            yield f"{table}.{key}", field.annotation, tuple(field.metadata)


def _units_in(declared: tuple[Any, ...]) -> Iterator[str]:
    """Yield the units of the quantities in an annotation, those of a list's entries too."""
    for each in declared:
        if isinstance(each, Quantity):
            yield each.unit
        yield from _units_in(get_args(each))


_DECLARED = {
    path: (kind, declared, next((each for each in declared if isinstance(each, Label)), None))
    for path, kind, declared in _declared()
}
COMPONENTS = {path: tuple(label.each) for path, (_, _, label) in _DECLARED.items() if label and label.each}
"""The fields that are lists of numbers, and what their components are called."""


def _words_and_units() -> Iterator[tuple[str, str, str]]:
    for path, (kind, declared, label) in _DECLARED.items():
        if label is None:
            continue
        unit = label.unit or next(_units_in((*declared, kind)), "")
        if not label.each:
            yield path, label.word, unit
        for name, word in label.each.items():
            yield f"{path}.{name}", word, unit


WORDS = {field: word for field, word, _ in _words_and_units()}
"""What a person calls the fields that are one number."""
UNITS = {field: unit for field, _, unit in _words_and_units()}
"""SI units of these fields, in pint's spelling; those of λ are for b = 0."""
WORDED: Mapping[str, type[Word]] = {
    path: kind
    for path, (kind, _, _) in _DECLARED.items()
    if isinstance(kind, type) and issubclass(kind, Word)
}
"""Fields that are a word, in a row its integer."""


ROLLS = "release.rolls"


def _places() -> Iterator[tuple[str, Place]]:
    for path in _DECLARED:
        place = tuple(path.split("."))
        if path == ROLLS:
            continue  # a row has what follows of it
        if path == "coin.inertia":
            for i, row in enumerate(BODY):
                yield from ((f"{path}.{row}.{name}", (*place, i, k)) for k, name in enumerate(BODY))
        elif path in COMPONENTS:
            yield from ((f"{path}.{name}", (*place, i)) for i, name in enumerate(COMPONENTS[path]))
        else:
            yield path, place


PLACES = dict(_places())
"""Of each number and each word in a scenario file."""
FIELDS = tuple(PLACES)
"""By their places in a row of numbers, where what a scenario does not have is not a number."""
_OTHER_ATTITUDE = {"release.angles": "quaternion", "release.quaternion": "angles"}
_FLAT = {"release.angles": (0.0, 0.0, 0.0), "release.quaternion": (1.0, 0.0, 0.0, 0.0)}
"""The attitude of a release that gives none."""


def split(field: str) -> tuple[str, str, int | None]:
    """Return the table of a field, its key, and the index of its component.

    Args:
        field: a dotted path, such as "gravity", "coin", "floor.contact" or "release.position.z".

    Returns:
        "" for no table; None for no component.
    """
    path, _, last = field.rpartition(".")
    if last in COMPONENTS.get(path, ()):
        table, _, key = path.partition(".")
        return table, key, COMPONENTS[path].index(last)
    table, _, key = field.partition(".")
    return (table, key, None) if key else ("", table, None)


def put(data: dict[str, Any], field: str, value: Any) -> None:
    """Put a value in its place in the tables of a scenario, which are to be checked afterwards.

    The angles and the quaternion of a release take the place of each other, and so do a drag coefficient of
    the air and its pressure and exponent.

    Args:
        data: tables by name, as a scenario file gives them.
        field: a dotted path.
        value: as a scenario file gives it, or a part of a scenario.

    Raises:
        ScenarioError: for a component that a field does not have.
    """
    path, _, last = field.rpartition(".")
    if last not in COMPONENTS.get(path, last):
        accepted = ", ".join(f"{path}.{name}" for name in COMPONENTS[path])
        raise ScenarioError(f"{field} = {shown(value)}: unknown component; accepted: {accepted}")
    if field == "release.spin":
        field, value = "release.angular_velocity", _of_size(data, value)
    table, key, index = split(field)
    part = data
    if table:
        if not isinstance(data.get(table), dict):
            data[table] = {}
        part = data[table]
    if index is not None:
        whole = part.get(key)
        if whole is None:
            whole = _FLAT.get(path, TABLES[table].model_fields[key].default)
        if not isinstance(whole, list | tuple | np.ndarray):
            return  # it is refused as a whole
        value = [value if i == index else entry for i, entry in enumerate(whole)]
    elif field == "air.drag_coefficient":
        part.pop("normal", None)
        part.pop("exponent", None)
    elif field in _OTHER_ATTITUDE and value is not None:
        part[_OTHER_ATTITUDE[field]] = None
    part[key] = value.model_dump() if isinstance(value, BaseModel) else value


def _of_size(data: dict[str, Any], size: Any) -> list[float]:
    """Return the angular velocity of a scenario's tables with another size, about the same axis [rad/s].

    Raises:
        ScenarioError: where the coin does not spin, and for what is no size.
    """
    release = data.get("release")
    spin = release.get("angular_velocity") if isinstance(release, dict) else None
    own = [float(w) for w in spin or (0.0, 0.0, 0.0)]
    if not any(own):
        accepted = ", ".join(f"release.angular_velocity.{name}" for name in BODY)
        raise ScenarioError(f"release.spin = {shown(size)}: the coin has no axis; accepted: {accepted}")
    try:
        rate = in_si(size, "rad/s") if isinstance(size, str) else float(size)
    except (TypeError, ValueError) as error:
        raise ScenarioError(f"release.spin = {shown(size)}: accepted: {error}") from None
    return [part * rate for part in direction_of(own)]


def direction_of(spin: Sequence[float]) -> list[float]:
    """Return the direction of an angular velocity other than zero, (3,), of any size."""
    unit = math.ldexp(1.0, math.frexp(max(map(abs, spin)))[1] - 1)  # no square of it is too large or small
    x, y, z = (w / unit for w in spin)
    return [part / norm((x, y, z)) for part in (x, y, z)]
