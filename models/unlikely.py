"""Numbers that were probably meant in another unit: a coin of 12 m, where 12 mm was meant."""

import warnings
from collections.abc import Mapping
from math import pi
from types import MappingProxyType

from cointoss.models.inertia import inertia_about_mass_center, largest_across
from cointoss.models.parts import Coin, EndingCriteria, Release

LEAST_GRAVITY = 1.5
"""Below it, a little less than the moon's, a scenario may have units of its own, such as g = 1 [m/s²]."""
DENSITIES = 20.0, 1e5
"""Densities that are not questioned [kg/m³]. Osmium has 22,600. A coin whose thickness in mm was read as m
has at most 20, one whose mass in g was read as kg above 2e6."""
SURFACE_DENSITIES = 0.02, 1e3
"""Masses per area of a coin of thickness 0 that are not questioned [kg/m²]."""
LARGE = 0.1
"""A radius, thickness or mass below it is not questioned [m, kg]."""
HIGHEST, IN_MM = 10.0, 100.0
"""A release or a catch above the first is questioned; above the second it was rather meant in mm [m]."""
_ROUNDED = 1 + 1e-9
"""A moment at its bound, a ring's, may exceed it by rounding."""
_MASS, _RADIUS, _THICKNESS = "coin.mass", "coin.radius", "coin.thickness"
NONE: Mapping[str, float] = MappingProxyType({})
_HEIGHTS = ("release.position.z", "ending.caught", "hand.height")


class UnitWarning(UserWarning):
    """A number that was probably meant in another unit; the message names it, its value and that unit."""


def unlikely_units(
    gravity: float, coin: Coin, release: Release, ending: EndingCriteria, other: Mapping[str, float] = NONE
) -> dict[str, str]:
    """Return a line for each number that was probably meant in mm, cm or g, by its field.

    Lengths and mass of a coin are judged by its density, which is unlikely as given and likely as meant.

    Args:
        gravity: of the scenario.
        coin: of the scenario.
        release: of the scenario.
        ending: of the scenario.
        other: numbers in place of the scenario's, by field, as {"coin.radius": 12.0}.
    """
    if gravity < LEAST_GRAVITY:
        return {}
    numbers = {
        _MASS: coin.mass,
        _RADIUS: coin.radius,
        _THICKNESS: coin.thickness,
        "release.position.z": release.position[2],
        "ending.caught": ending.caught or 0.0,
        **other,
    }
    found = {
        name: f"{name} = {height:g} m: is it {unit}? write {_quoted(height, unit)}"
        for name, height in numbers.items()
        for unit in (["mm"] if height > IN_MM else ["cm"])
        if name in _HEIGHTS and height > HIGHEST
    }
    if coin.inertia is not None and (larger := _larger_than_a_body_has(coin)):
        found["coin.inertia"] = larger
    if min(numbers[_MASS], numbers[_RADIUS]) <= 0:
        return found
    density, unit = _density(numbers)
    low, high = DENSITIES if numbers[_THICKNESS] > 0 else SURFACE_DENSITIES
    lengths = [name for name in (_RADIUS, _THICKNESS) if density < low and numbers[name] >= LARGE]
    why = f"; as given, the coin's density is {density:.3g} {unit}"
    for meant, part in (("mm", 1e-3), ("cm", 1e-2)):
        read = numbers | {name: numbers[name] * part for name in lengths}
        dense, _ = _density(read)
        is_gram = meant == "mm" and dense > high and numbers[_MASS] >= LARGE
        is_coin = read[_THICKNESS] <= 10 * read[_RADIUS]
        if is_coin and low <= dense * (1e-3 if is_gram else 1.0) <= high:
            asked = dict.fromkeys(lengths, ("m", meant)) | ({_MASS: ("kg", "g")} if is_gram else {})
            return found | {
                name: f"{name} = {numbers[name]:g} {si}: is it {other}? "
                f"write {_quoted(numbers[name], other)}{why}"
                for name, (si, other) in asked.items()
            }
    return found


def _larger_than_a_body_has(coin: Coin) -> str | None:
    """Return a line about a moment of inertia larger than with all mass at the coin's edge, or None."""
    J = inertia_about_mass_center(coin.moments, -coin.mass, coin.center_of_mass)  # about B
    most = {
        "a diameter": (largest_across(J), coin.mass * (coin.radius**2 + coin.thickness**2 / 4)),
        "the axis": (J[2][2], coin.mass * coin.radius**2),
    }
    for axis, (moment, bound) in most.items():
        if moment > bound * _ROUNDED:
            return (
                f"coin.inertia: its moment about {axis} of the cylinder is {moment:.3g} kg m², "
                f"and no body of this mass in it has more than {bound:.3g}: is it g cm²? write it in kg m²"
            )
    return None


def _quoted(number: float, unit: str) -> str:
    return f'"{number:g} {unit}"'


def _density(numbers: Mapping[str, float]) -> tuple[float, str]:
    """Return the density of a coin and its unit; of the thin coin, per area."""
    per_area = numbers[_MASS] / pi / numbers[_RADIUS] / numbers[_RADIUS]
    thickness = numbers[_THICKNESS]
    return (per_area / thickness, "kg/m³") if thickness > 0 else (per_area, "kg/m²")


def warn_of_unlikely_units(
    gravity: float, coin: Coin, release: Release, ending: EndingCriteria, other: Mapping[str, float] = NONE
) -> None:
    """Warn of each number that was probably meant in another unit; with `other`, only of those.

    The arguments are those of `unlikely_units`.

    Warns:
        UnitWarning: naming field, value and the unit that was probably meant.
    """
    for name, line in unlikely_units(gravity, coin, release, ending, other).items():
        if name in (other or {name}):
            warnings.warn(line, UnitWarning, stacklevel=3)
