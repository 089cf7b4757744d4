"""Many releases of one coin, as arrays."""

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike

from models.attitude import rotation_matrix
from models.clearance import damping_rate
from models.geometry import gap
from models.kernel.compiled import compiled
from models.records import Array
from models.scenario import FASTEST_DRAG, FASTEST_SPIN, LARGEST, NORM_ROUNDING, Scenario


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
        n = len(self.position)
        for item, columns in zip(fields(self), (3, 3, 4, 3), strict=True):
            array = np.array(getattr(self, item.name), dtype=float, order="C")
            if array.shape != (n, columns):
                raise ValueError(f"Releases.{item.name}: shape {array.shape}, expected {(n, columns)}")
            _refuse(item.name, array, ~(np.abs(array) <= LARGEST).all(axis=1), f"numbers within {LARGEST:g}")
            if item.name == "quaternion":
                # In a map the attitude is often one; numpy's own norm rounds otherwise than math.hypot.
                distinct = array[:1] if (array == array[:1]).all() else array
                size = np.array([math.hypot(*e) for e in distinct.tolist()])
                _refuse(item.name, array, ~(np.abs(size - 1) <= 1e-3), "four numbers of norm 1 within 1e-3")
                array /= np.where(np.abs(size - 1) <= NORM_ROUNDING, 1.0, size)[:, None]
            array.setflags(write=False)
            object.__setattr__(self, item.name, array)

    def __len__(self) -> int:
        """Return the number of releases."""
        return len(self.position)

    def __repr__(self) -> str:
        """Return how many there are."""
        return f"<Releases: {len(self)}>"


def check_releases(scenario: Scenario, releases: Releases) -> None:
    """Refuse releases that a `Scenario` with this coin, air and gravity would refuse.

    Raises:
        ValueError: for a coin below the floor, and for a spin or a drag too fast to follow.
    """
    body, n = scenario.body, len(releases)
    clearance, damping = np.empty(n), np.empty(n)
    _clearance_and_damping(
        body,
        releases.position,
        releases.velocity,
        releases.quaternion,
        releases.angular_velocity,
        clearance,
        damping,
    )
    rate = (body.gravity / body.radius) ** 0.5
    w = releases.angular_velocity
    _refuse("position", releases.position, clearance < -1e-12 * body.radius, "a coin above the floor")
    fastest = FASTEST_SPIN * rate
    too_fast = ~(np.linalg.norm(w, axis=1) <= fastest)
    _refuse(
        "angular_velocity", w, too_fast, f"a spin of at most {FASTEST_SPIN:g} sqrt(g/r) = {fastest:.3g} rad/s"
    )
    accepted = f"air that slows the coin at a rate of at most {FASTEST_DRAG:g} sqrt(g/r)"
    _refuse("velocity", releases.velocity, ~(damping <= FASTEST_DRAG * rate), accepted)


def _refuse(name: str, rows: Array, refused: ArrayLike, accepted: str) -> None:
    if np.any(refused):
        i = int(np.argmax(refused))
        raise ValueError(f"Releases.{name}: row {i} is {rows[i].tolist()}, accepted: {accepted}")


@compiled
def _clearance_and_damping(body, positions, velocities, attitudes, spins, clearance, damping):
    for i in range(len(positions)):
        z, v, e, w = positions[i, 2], velocities[i], attitudes[i], spins[i]
        clearance[i] = gap(body, z, rotation_matrix(e)[2])
        fall = (2 * max(z, 0.0) / body.gravity) ** 0.5
        damping[i] = damping_rate(body, (v[0], v[1], v[2]), (w[0], w[1], w[2]), fall)
