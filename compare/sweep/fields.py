"""The numeric fields of a scenario, by dotted paths, components by name: release.position.z."""

import difflib
from typing import Any

from pydantic import ValidationError

from models.reading import describe
from models.scenario import Scenario


class SweepError(ValueError):
    """A sweep that can't be made; the message names field, value and what is accepted."""


_SPACE, _BODY = ("x", "y", "z"), ("xi", "eta", "zeta")
_ANGLES, _PARAMETERS = ("psi", "theta", "phi"), ("e0", "e1", "e2", "e3")


def _components(path: str, names: tuple[str, ...], unit: str) -> dict[str, str]:
    return {f"{path}.{name}": unit for name in names}


def _lambda_unit(exponent: float) -> str:
    return f"kg*m**{-2 - exponent:g}*s**{exponent - 1:g}"


UNITS = {
    "gravity": "m/s**2",
    "coin.mass": "kg",
    "coin.radius": "m",
    "coin.thickness": "m",
    **_components("coin.center_of_mass", _BODY, "m"),
    "air.exponent": "",
    "air.normal": _lambda_unit(0),
    "air.tangential": _lambda_unit(0),
    "floor.restitution": "",
    "floor.friction": "",
    **_components("release.position", _SPACE, "m"),
    **_components("release.velocity", _SPACE, "m/s"),
    **_components("release.angles", _ANGLES, "rad"),
    **_components("release.quaternion", _PARAMETERS, ""),
    **_components("release.angular_velocity", _BODY, "rad/s"),
    "ending.max_impacts": "",
    "ending.max_time": "s",
}
"""SI units, in pint's spelling, by field; those of `air.normal` and `air.tangential` are for b = 0."""
_INDEX = {name: i for names in (_SPACE, _BODY, _ANGLES, _PARAMETERS) for i, name in enumerate(names)}
_DEFAULTS = {"angles": (0.0, 0.0, 0.0), "quaternion": (1.0, 0.0, 0.0, 0.0)}


def unit_of(field: str, scenario: Scenario) -> str:
    """Give the SI unit of a field, in pint's spelling; that of λ is for the scenario's exponent b.

    Raises:
        SweepError: for no numeric field, naming those there are.
    """
    if field not in UNITS:
        near = difflib.get_close_matches(field, UNITS, n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        raise SweepError(f"{field}: no numeric field of a scenario; accepted: {', '.join(UNITS)}{hint}")
    return _lambda_unit(scenario.air.exponent) if field in ("air.normal", "air.tangential") else UNITS[field]


def is_of_release(field: str) -> bool:
    """Tell whether a field is of the release, so that it may differ between the tosses of one coin."""
    return field.startswith("release.")


def split(field: str) -> tuple[str, str, int | None]:
    """Give the table of a field, its key, and the index of its component; "" for no table, None for none."""
    path, _, last = field.rpartition(".")
    if path.count(".") == 1:
        table, key = path.split(".")
        return table, key, _INDEX[last]
    return path, last, None


def with_values(scenario: Scenario, values: dict[str, float]) -> Scenario:
    """Give a scenario with other values of some fields.

    Args:
        scenario: the other fields'.
        values: by field, SI.

    Raises:
        SweepError: for an invalid scenario, naming field, value, and what is accepted.
    """
    data = scenario.model_dump()
    for field, value in values.items():
        table, key, index = split(field)
        part = data[table] if table else data
        if index is None:
            part[key] = _whole(value) if field == "ending.max_impacts" else value
        else:
            entries = list(part[key] or _DEFAULTS[key])
            entries[index] = value
            part[key] = entries
    try:
        return Scenario.model_validate(data)
    except ValidationError as error:
        raise SweepError(describe(error)) from None


def _whole(value: float) -> Any:
    return int(value) if value == int(value) else value
