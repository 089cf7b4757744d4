"""The margin of a toss: the smallest change of its release that changes its outcome, by quantity."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import analytic
from models.records import Array
from models.releases import Releases, check_releases
from models.scenario import Scenario

Rows = tuple[Sequence[float], ...]
FINEST, PER_DECADE, DECADES = 1e-13, 4, 13
"""Changes are tried from the finest on, in SI units; the last is 1."""
BISECTIONS = 8
"""The change that is found is cut down so many times by `CUTS`."""
CUTS = 8


@dataclass(frozen=True)
class Quantity:
    """A component of the release, and how a toss is changed along it."""

    name: str
    unit: str
    factor: float
    """Of the unit in one SI unit."""
    change: Callable[[Releases, Array], Releases]
    """Adds numbers, in SI units, to releases of one coin."""


@dataclass(frozen=True)
class Margin:
    """The smallest change along one quantity that was found to change the outcome."""

    quantity: Quantity
    change: float
    """With its sign, in the quantity's unit; infinite where none up to 1 SI unit does."""

    @property
    def finite(self) -> float | None:
        """The change; None where there is none."""
        return self.change if math.isfinite(self.change) else None

    @property
    def line(self) -> str:
        """The margin for a person."""
        found = f"{self.change:+.3g} {self.quantity.unit}" if self.finite is not None else "none found"
        return f"margin    {self.quantity.name:18}  {found}"


def _moved(field: str, axis: int) -> Callable[[Releases, Array], Releases]:
    def change(start: Releases, by: Array) -> Releases:
        arrays = {name: getattr(start, name) for name in Releases.__dataclass_fields__}
        arrays[field] = arrays[field] + by[:, None] * np.eye(3)[axis]
        return Releases(**arrays)

    return change


def _turned(axis: int) -> Callable[[Releases, Array], Releases]:
    def change(start: Releases, by: Array) -> Releases:
        e0, e = start.quaternion[:, 0], start.quaternion[:, 1:]
        cosine, sine = np.cos(by / 2), np.sin(by / 2)
        u = np.eye(3)[axis]
        turned = cosine[:, None] * e + sine[:, None] * (e0[:, None] * u + np.cross(e, u))
        first = cosine * e0 - sine * (e @ u)
        return Releases(
            position=start.position,
            velocity=start.velocity,
            quaternion=np.column_stack([first, turned]),
            angular_velocity=start.angular_velocity,
        )

    return change


QUANTITIES = (
    Quantity("height", "mm", 1e3, _moved("position", 2)),
    *(Quantity(f"velocity {axis}", "mm/s", 1e3, _moved("velocity", i)) for i, axis in enumerate("xyz")),
    *(Quantity(f"attitude about {axis}", "rad", 1.0, _turned(i)) for i, axis in enumerate(("ξ", "η", "ζ"))),
    *(
        Quantity(f"spin about {axis}", "rad/s", 1.0, _moved("angular_velocity", i))
        for i, axis in enumerate(("ξ", "η", "ζ"))
    ),
)
"""Horizontal position is left out: it changes nothing."""


def margins(scenario: Scenario) -> tuple[Margin, ...]:
    """Return the margin of a scenario's toss along each of `QUANTITIES`.

    Changes are tried on a ladder, up and down; the first that changes the outcome is cut down by bisection.
    A stripe between two rungs goes unseen, so the margin is an upper bound.
    """
    release = scenario.release
    start = (release.position, release.velocity, release.attitude, release.angular_velocity)
    return tuple(Margin(quantity, _smallest(scenario, start, quantity)) for quantity in QUANTITIES)


def _smallest(scenario: Scenario, start: Rows, quantity: Quantity) -> float:
    outcome = _outcomes(scenario, start, quantity, np.zeros(1))[0]
    ladder = FINEST * 10 ** (np.arange(DECADES * PER_DECADE + 1) / PER_DECADE)
    best = np.inf
    for sign in (1.0, -1.0):
        differs = _outcomes(scenario, start, quantity, sign * ladder) != outcome
        if not differs.any():  # all that a scenario would accept
            continue
        at = int(np.argmax(differs))
        low, high = (ladder[at - 1] if at else 0.0), ladder[at]
        for _ in range(BISECTIONS):
            rungs = np.linspace(low, high, CUTS + 1)[1:]
            at = int(np.argmax(_outcomes(scenario, start, quantity, sign * rungs) != outcome))
            low, high = (rungs[at - 1] if at else low), rungs[at]
        if high < abs(best):
            best = sign * high
    return float(best * quantity.factor)


def _outcomes(scenario: Scenario, start: Rows, quantity: Quantity, by: Array) -> NDArray[np.int8]:
    """Return the outcomes after ever larger changes, as far as a scenario would accept the release."""
    for accepted in range(len(by), 0, -1):
        rows = (np.tile(np.array(row, dtype=float), (accepted, 1)) for row in start)
        position, velocity, quaternion, spin = rows
        whole = Releases(position=position, velocity=velocity, quaternion=quaternion, angular_velocity=spin)
        changed = quantity.change(whole, by[:accepted])
        try:
            check_releases(scenario, changed)
        except ValueError:
            continue
        return analytic.toss_many(scenario, changed).outcome
    return np.empty(0, dtype=np.int8)
