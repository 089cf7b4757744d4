"""What adapters share: the steps and the states of a toss, the friction of a floor; needs NumPy alone."""

from collections.abc import Callable, Iterable
from operator import attrgetter
from typing import Any

import numpy as np

STATE = ("position", "velocity", "quaternion", "angular_velocity")
THINNEST = 1e-5
"""The least thickness of a shape [m]."""
AIR = ("air.normal", "air.tangential")
THRESHOLD = "floor.restitution_threshold"
BEYOND = (*AIR, "floor.rolling_friction", "floor.pivoting_friction", THRESHOLD)
"""Fields of a scenario that most engines have no counterpart of."""
OF_COINTOSS = (
    *("floor.restitution_exponent", "floor.restitution_viscous", "floor.slope"),
    *("floor.contour_friction", "floor.contour_viscosity", "air.viscosity"),
)
"""Fields that no adapter hands to its engine."""


def rows_at(
    times: Iterable[float], dt: float, step: Callable[[], object], state: Callable[[], Iterable[Any]]
) -> np.ndarray:
    """Return the states at the steps nearest to times, a row each.

    Args:
        times: from 0 on [s].
        dt: the step [s].
        step: takes one.
        state: returns the parts of the present state.
    """
    rows, taken = [], 0
    for due in np.rint(np.asarray(list(times)) / dt).astype(int):
        for _ in range(due - taken):
            step()
        taken = due
        rows.append(np.hstack([*state()]))
    return np.array(rows, float)


def by_name(rows: np.ndarray) -> dict[str, np.ndarray]:
    """Return rows of position, velocity, quaternion and spin, (n, 13), as `simulate` returns them."""
    return dict(zip(STATE, np.split(rows, [3, 6, 10], axis=1), strict=True))


def friction_of(scenario: Any, refused: Iterable[str] = BEYOND, rough: float = 1e3) -> float:
    """Return the friction coefficient of the floor's contact law.

    Args:
        scenario: what is tossed.
        refused: fields that must be 0, beside `OF_COINTOSS`.
        rough: the coefficient of a perfectly rough floor.

    Raises:
        NotImplementedError: naming the field, its value and what is accepted.
    """
    for what in (*OF_COINTOSS, *refused):
        if value := attrgetter(what)(scenario):
            raise NotImplementedError(f"{what}: {value}, accepted: 0")
    laws = {"smooth": 0.0, "coulomb": scenario.floor.friction, "perfectly_rough": rough}
    law = scenario.floor.contact
    if law not in laws:
        raise NotImplementedError(f"floor.contact: {law}, accepted: {', '.join(laws)}")
    return laws[law]


def rotations(q: np.ndarray) -> np.ndarray:
    """Return the rotation matrices of quaternions, scalar first, (n, 3, 3)."""
    cross = np.cross(np.eye(3), q[:, None, 1:])
    return np.eye(3) + 2 * (q[:, :1, None] * cross + cross @ cross)
