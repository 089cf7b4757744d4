"""What a dotted field of a scenario means: its table, its key, its component by name, and its unit."""

from typing import Any

import numpy as np
from pydantic import BaseModel

from models.errors import ScenarioError, shown

_SPACE, _BODY = ("x", "y", "z"), ("xi", "eta", "zeta")
_COMPONENTS = {
    "coin.center_of_mass": _BODY,
    "release.position": _SPACE,
    "release.velocity": _SPACE,
    "release.angles": ("psi", "theta", "phi"),
    "release.quaternion": ("e0", "e1", "e2", "e3"),
    "release.angular_velocity": _BODY,
}
_ZERO = (0.0, 0.0, 0.0)
_DEFAULTS = {
    "coin.center_of_mass": _ZERO,
    "release.velocity": _ZERO,
    "release.angles": _ZERO,
    "release.quaternion": (1.0, 0.0, 0.0, 0.0),
    "release.angular_velocity": _ZERO,
}
_OTHER_ATTITUDE = {"release.angles": "quaternion", "release.quaternion": "angles"}


def _components(path: str, unit: str) -> dict[str, str]:
    return {f"{path}.{name}": unit for name in _COMPONENTS[path]}


def lambda_unit(exponent: float) -> str:
    """Return the SI unit of λ_n and λ_τ, in pint's spelling.

    Args:
        exponent: b.
    """
    return f"kg*m**{-2 - exponent:.15g}*s**{exponent - 1:.15g}"


UNITS = {
    "gravity": "m/s**2",
    "coin.mass": "kg",
    "coin.radius": "m",
    "coin.thickness": "m",
    **_components("coin.center_of_mass", "m"),
    "air.exponent": "",
    "air.normal": lambda_unit(0),
    "air.tangential": lambda_unit(0),
    "floor.restitution": "",
    "floor.restitution_threshold": "m/s",
    "floor.friction": "",
    "floor.rolling_friction": "m",
    "floor.pivoting_friction": "m",
    **_components("release.position", "m"),
    **_components("release.velocity", "m/s"),
    **_components("release.angles", "rad"),
    **_components("release.quaternion", ""),
    **_components("release.angular_velocity", "rad/s"),
    "ending.max_impacts": "",
    "ending.max_time": "s",
    "ending.caught": "m",
}
"""SI units, in pint's spelling, of the fields that are one number; those of λ are for b = 0."""


def split(field: str) -> tuple[str, str, int | None]:
    """Return the table of a field, its key, and the index of its component.

    Args:
        field: a dotted path, such as "gravity", "coin", "floor.contact" or "release.position.z".

    Returns:
        "" for no table; None for no component.
    """
    path, _, last = field.rpartition(".")
    if last in _COMPONENTS.get(path, ()):
        table, _, key = path.partition(".")
        return table, key, _COMPONENTS[path].index(last)
    table, _, key = field.partition(".")
    return (table, key, None) if key else ("", table, None)


def put(data: dict[str, Any], field: str, value: Any) -> None:
    """Put a value in its place in the tables of a scenario, which are to be checked afterwards.

    The angles and the quaternion of a release take the place of each other.

    Args:
        data: tables by name, as a scenario file gives them.
        field: a dotted path.
        value: as a scenario file gives it, or a part of a scenario.

    Raises:
        ScenarioError: for a component that a field does not have.
    """
    path, _, last = field.rpartition(".")
    if last not in _COMPONENTS.get(path, last):
        accepted = ", ".join(f"{path}.{name}" for name in _COMPONENTS[path])
        raise ScenarioError(f"{field} = {shown(value)}: unknown component; accepted: {accepted}")
    table, key, index = split(field)
    part = data
    if table:
        if not isinstance(data.get(table), dict):
            data[table] = {}
        part = data[table]
    if index is not None:
        whole = part.get(key)
        if whole is None:
            whole = _DEFAULTS.get(path)
        if not isinstance(whole, list | tuple | np.ndarray):
            return  # it is refused as a whole
        value = [value if i == index else entry for i, entry in enumerate(whole)]
    elif field in _OTHER_ATTITUDE and value is not None:
        part[_OTHER_ATTITUDE[field]] = None
    part[key] = value.model_dump() if isinstance(value, BaseModel) else value
