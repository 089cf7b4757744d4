"""Many releases of one coin, as arrays."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.entries import first_fault, normalize, states_of_joint
from cointoss.models.errors import require_type, shown
from cointoss.models.faults import ACCEPTED, NORM_ERROR, Fault
from cointoss.models.fields import UNITS, split
from cointoss.models.parts import LARGEST, Release
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.units import in_si

HEIGHT, SPIN = "release.position.z", "release.angular_velocity"
MOST = 10_000_000
"""Releases that are made at a time: a gigabyte."""
QUANTITIES = {"height": HEIGHT, "spin": SPIN} | {
    field.removeprefix("release.").replace(".", "_"): field for field in UNITS if field.startswith("release.")
}
"""What `Releases.of` may change, and its field: `height` is `position_z`, `spin` the size of ω."""


class RefusedRowError(ValueError):
    """A row of releases that can't be used."""

    def __init__(self, name: str, row: int, value: object, accepted: str) -> None:
        """Keep which part of the releases is wrong, and what is accepted there."""
        super().__init__(f"Releases.{name}: row {row} is {value}, accepted: {accepted}")
        self.name, self.accepted = name, accepted


@dataclass(frozen=True, kw_only=True, eq=False)
class Releases:
    """The states of many coins at time 0, one row each; arrays are copies, and read-only."""

    position: Array
    """Of C, space frame, (n, 3) [m]."""
    velocity: Array
    """Of C, space frame, (n, 3) [m/s]."""
    quaternion: Array
    """Euler parameters, body to space, (n, 4); brought to norm 1 as those of a `Release` are."""
    angular_velocity: Array
    """ω, body frame, (n, 3) [rad/s]."""

    def __post_init__(self) -> None:
        """Check shapes and numbers.

        Raises:
            ValueError: for a wrong shape, a number that is not finite or beyond all coins, or Euler
                parameters whose norm is not 1 within 1e-3.
        """
        n = None
        for item, columns in zip(fields(self), (3, 3, 4, 3), strict=True):
            array = _numbers(f"Releases.{item.name}", getattr(self, item.name), f"numbers, (n, {columns})")
            if array.ndim != 2 or array.shape != (len(array) if n is None else n, columns):
                expected = f"({'n' if n is None else n}, {columns}), a row for each toss"
                raise ValueError(f"Releases.{item.name}: shape {array.shape}, expected {expected}")
            n = len(array)
            _refuse(item.name, array, ~(np.abs(array) <= LARGEST).all(axis=1), f"numbers within {LARGEST:g}")
            if item.name == "quaternion":
                wrong = normalize(array)
                _refuse(
                    item.name, array, np.arange(n) == wrong, f"four numbers of norm 1 within {NORM_ERROR:g}"
                )
            array.setflags(write=False)
            object.__setattr__(self, item.name, array)

    @classmethod
    def of(cls, scenario: ScenarioSource, n: int, **quantities: ArrayLike) -> "Releases":
        """Return `n` copies of a scenario's release, some of its quantities changed.

            Releases.of("fig24a", 1000, height=("20 cm", "60 cm"), spin=40)

        Args:
            scenario: a `Scenario`, the path of its file, or a name such as "fig24a".
            n: number of tosses.
            quantities: each a number for all, a pair (start, stop) from which the n values run evenly, both
                included, or n values; in SI, or texts with a unit. `height` is that of C; `spin` is the size
                of ω, about the scenario's own axis of rotation. Others are the numbers of a release, named as
                in tables: `velocity_z`, `angular_velocity_eta`, `angles_theta`. Two pairs run together.

        Raises:
            TypeError: for another name.
            ValueError: for values that are none of these, and for a release that this coin can't have.
        """
        described = scenario_of(scenario)
        if isinstance(n, bool) or not isinstance(n, int | np.integer) or not 1 <= n <= MOST:
            raise ValueError(f"Releases.of: n = {n!r}, accepted: a whole number from 1 to {MOST}")
        changed: dict[str, Array] = {}
        for name, given in quantities.items():
            if name not in QUANTITIES:
                raise TypeError(f"Releases.of: {name}: unknown; accepted: {', '.join(QUANTITIES)}")
            values = _spread(name, given, int(n))
            new = _along_spin(described.release, values) if name == "spin" else {QUANTITIES[name]: values}
            twice = [field for field in new if field in changed]
            if twice:
                raise ValueError(f"Releases.of: {name}: sets {twice[0]} again; accepted: each number once")
            changed |= new
        releases = changed_releases(described.release, int(n), changed)
        check_releases(described, releases)
        return releases

    @classmethod
    def from_mujoco(cls, qpos: ArrayLike, qvel: ArrayLike, scenario: ScenarioSource) -> "Releases":
        """Return releases from states of MuJoCo's free joint of the coin.

            Releases.from_mujoco(data.qpos, data.qvel, "fig24a")

        Args:
            qpos: B in space and Euler parameters, scalar first, (7,) or (n, 7).
            qvel: velocity of B in space and ω in the body frame, (6,) or (n, 6).
            scenario: of the coin, whose mass centre may lie off B.

        Raises:
            ValueError: for other shapes, and for a release that this coin can't have.
        """
        described = scenario_of(scenario)
        joint, motion = (
            np.atleast_2d(
                _numbers(f"Releases.from_mujoco: {name}", given, f"numbers, ({size},) or (n, {size})")
            )
            for name, given, size in (("qpos", qpos, 7), ("qvel", qvel, 6))
        )
        for name, part, size in (("qpos", joint, 7), ("qvel", motion, 6)):
            if part.shape != (len(joint), size):
                raise ValueError(
                    f"Releases.from_mujoco: {name}: shape {part.shape}, accepted: ({len(joint)}, {size})"
                )
        quaternions = joint[:, 3:].copy()
        wrong = np.arange(len(joint)) == normalize(quaternions)
        _refuse("quaternion", joint[:, 3:], wrong, f"four numbers of norm 1 within {NORM_ERROR:g}")
        motions = np.hstack([joint[:, :3], quaternions, motion])
        position, velocity, quaternion, spin = np.split(
            states_of_joint(described.body, motions), (3, 6, 10), axis=1
        )
        releases = cls(position=position, velocity=velocity, quaternion=quaternion, angular_velocity=spin)
        check_releases(described, releases)
        return releases

    def __len__(self) -> int:
        """Return the number of releases."""
        return len(self.position)

    def __repr__(self) -> str:
        """Return how many there are."""
        return f"<Releases: {len(self)}>"


def changed_releases(release: Release, n: int, changed: Mapping[str, Array]) -> Releases:
    """Return copies of a release with some of its numbers changed.

    Args:
        release: what is copied; its angles take the place of its quaternion where they are changed.
        n: number of copies.
        changed: by the dotted field of a number, (n,) each.
    """
    numbers = {
        "position": release.position,
        "velocity": release.velocity,
        "angles": release.angles or (0.0, 0.0, 0.0),
        "quaternion": release.attitude,
        "angular_velocity": release.angular_velocity,
    }
    columns = {name: np.tile(row, (n, 1)) for name, row in numbers.items()}
    for field, values in changed.items():
        _, key, index = split(field)
        columns[key][:, index] = values
    angles = columns.pop("angles")
    if any(field.startswith("release.angles.") for field in changed):
        columns["quaternion"] = np.array([quaternion_from_angles((a, b, c)) for a, b, c in angles.tolist()])
    return Releases(**columns)


def _numbers(name: str, given: object, accepted: str) -> Array:
    """Return an array of what is given, which is a copy.

    Raises:
        ValueError: for what are no numbers, or rows of different lengths.
    """
    try:
        return np.array(given, dtype=float, order="C")
    except (TypeError, ValueError):
        raise ValueError(f"{name}: {shown(given)}, accepted: {accepted}") from None


def _spread(name: str, given: ArrayLike, n: int) -> Array:
    """Return n values of a quantity, from one, from a pair, or from n."""
    unit = UNITS.get(QUANTITIES[name], "rad/s")
    try:
        entries = [given] if np.ndim(given) == 0 else list(given)  # pyright: ignore[reportArgumentType]
        values = np.array([in_si(one, unit) if isinstance(one, str) else one for one in entries], dtype=float)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.ndim != 1 or len(values) not in (1, 2, n) or not np.isfinite(values).all():
        size = f"shape {np.shape(given)}" if isinstance(given, np.ndarray) else shown(given)
        raise ValueError(
            f"Releases.of: {name} = {size}, accepted: a number [{unit}] or a text with its unit, "
            f"a pair (start, stop), or {n} of them"
        )
    if len(values) == n:
        return values
    return np.linspace(values[0], values[-1], n)


def _along_spin(release: Release, values: Array) -> dict[str, Array]:
    """Return the components of ω along that of a release, of the sizes `values`."""
    size = math.hypot(*release.angular_velocity)
    if size == 0:
        raise ValueError(
            "Releases.of: spin: this scenario's coin does not spin, so about no axis; accepted: "
            "angular_velocity_xi, angular_velocity_eta, angular_velocity_zeta"
        )
    axis = zip(("xi", "eta", "zeta"), release.angular_velocity, strict=True)
    return {f"{SPIN}.{name}": w / size * values for name, w in axis}


def states_of(releases: Releases) -> Array:
    """Return position, velocity, Euler parameters and angular velocity of each release, (n, 13)."""
    return np.hstack([releases.position, releases.velocity, releases.quaternion, releases.angular_velocity])


def check_releases(scenario: Scenario, releases: Releases) -> None:
    """Refuse releases that a `Scenario` with this coin, air and gravity would refuse.

    Raises:
        TypeError: for what are none.
        ValueError: for a coin below the floor, and for a spin or a drag too fast to follow.
    """
    require_type("releases", releases, Releases, "Releases, as of Releases.of(scenario, n, height=...)")
    rows = (releases.position, releases.velocity, releases.quaternion, releases.angular_velocity)
    row, found = first_fault(scenario.body, *rows)
    if found.fault != Fault.NONE:
        field, accepted = ACCEPTED[found.fault]
        name = "velocity" if field == "air" else split(field)[1]
        _refuse(
            name, getattr(releases, name), np.arange(len(releases)) == row, accepted.format(limit=found.limit)
        )


def _refuse(name: str, rows: Array, refused: ArrayLike, accepted: str) -> None:
    if np.any(refused):
        i = int(np.argmax(refused))
        raise RefusedRowError(name, i, rows[i].tolist(), accepted)
