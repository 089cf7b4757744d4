"""What a dotted field of a scenario means: its table, key and component, its word and its unit."""

import math
import re
from typing import Any

import numpy as np
from pydantic import BaseModel

from cointoss.models.errors import ScenarioError, shown
from cointoss.models.units import in_si

SPACE, BODY = ("x", "y", "z"), ("xi", "eta", "zeta")
COMPONENTS = {
    "coin.center_of_mass": BODY,
    "release.position": SPACE,
    "release.velocity": SPACE,
    "release.angles": ("psi", "theta", "phi"),
    "release.quaternion": ("e0", "e1", "e2", "e3"),
    "release.angular_velocity": BODY,
}
"""The fields that are lists of numbers, and what their components are called."""
_ZERO = (0.0, 0.0, 0.0)
_DEFAULTS = {
    "coin.center_of_mass": _ZERO,
    "release.velocity": _ZERO,
    "release.angles": _ZERO,
    "release.quaternion": (1.0, 0.0, 0.0, 0.0),
    "release.angular_velocity": _ZERO,
}
_OTHER_ATTITUDE = {"release.angles": "quaternion", "release.quaternion": "angles"}


def lambda_unit(exponent: float) -> str:
    """Return the SI unit of λ_n and λ_τ, in pint's spelling.

    Args:
        exponent: b.
    """
    return f"kg*m**{-2 - exponent:.15g}*s**{exponent - 1:.15g}"


def _components(path: str, unit: str, *words: str) -> dict[str, tuple[str, str]]:
    return {f"{path}.{name}": (word, unit) for name, word in zip(COMPONENTS[path], words, strict=True)}


_NUMBERS = {
    "gravity": ("gravity g", "m/s**2"),
    "coin.mass": ("mass", "kg"),
    "coin.radius": ("radius", "m"),
    "coin.thickness": ("thickness", "m"),
    **_components("coin.center_of_mass", "m", *(f"mass centre {axis}" for axis in "ξηζ")),
    "air.exponent": ("exponent b of the air", ""),
    "air.normal": ("pressure λ_n of the air", lambda_unit(0)),
    "air.tangential": ("friction λ_τ of the air", lambda_unit(0)),
    "floor.restitution": ("restitution χ", ""),
    "floor.restitution_threshold": ("restitution threshold", "m/s"),
    "floor.friction": ("friction μ", ""),
    "floor.rolling_friction": ("rolling friction δ", "m"),
    "floor.pivoting_friction": ("pivoting friction p", "m"),
    **_components("release.position", "m", "position x", "position y", "height"),
    **_components("release.velocity", "m/s", "velocity x", "velocity y", "velocity z"),
    **_components("release.angles", "rad", "angle ψ", "tilt θ", "angle φ"),
    **_components(
        "release.quaternion", "", *(f"Euler parameter {name}" for name in ("e₀", "e₁", "e₂", "e₃"))
    ),
    **_components("release.angular_velocity", "rad/s", *(f"spin about {axis}" for axis in "ξηζ")),
    "ending.max_impacts": ("most impacts", ""),
    "ending.max_time": ("time limit", "s"),
    "ending.caught": ("height of the catch", "m"),
}
WORDS = {field: word for field, (word, _) in _NUMBERS.items()}
"""What a person calls the fields that are one number."""
UNITS = {field: unit for field, (_, unit) in _NUMBERS.items()}
"""SI units of these fields, in pint's spelling; those of λ are for b = 0."""
_RAISED = str.maketrans("-.0123456789", "⁻·⁰¹²³⁴⁵⁶⁷⁸⁹")


def printed_unit(unit: str) -> str:
    """Return a unit as a person writes it, such as "kg m⁻² s⁻¹".

    Args:
        unit: in pint's spelling.
    """
    raised = re.sub(r"\*\*(-?[0-9.]+)", lambda power: power[1].translate(_RAISED), unit)
    return raised.replace("*", " ")


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

    The angles and the quaternion of a release take the place of each other.

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
            whole = _DEFAULTS.get(path)
        if not isinstance(whole, list | tuple | np.ndarray):
            return  # it is refused as a whole
        value = [value if i == index else entry for i, entry in enumerate(whole)]
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
    own = [float(w) for w in spin or _ZERO]
    if not any(own):
        accepted = ", ".join(f"release.angular_velocity.{name}" for name in BODY)
        raise ScenarioError(f"release.spin = {shown(size)}: the coin has no axis; accepted: {accepted}")
    try:
        rate = in_si(size, "rad/s") if isinstance(size, str) else float(size)
    except (TypeError, ValueError) as error:
        raise ScenarioError(f"release.spin = {shown(size)}: accepted: {error}") from None
    whole = math.hypot(*own)
    return [w / whole * rate for w in own]
