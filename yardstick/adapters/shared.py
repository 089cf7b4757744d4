"""What adapters share: the friction of a floor, and rotation matrices; needs NumPy alone."""

from operator import attrgetter
from typing import Any

import numpy as np

AIR = ("air.normal", "air.tangential")
RESISTANCE = ("floor.rolling_friction", "floor.pivoting_friction")
THRESHOLD = "floor.restitution_threshold"
"""Fields of a scenario that an engine may have no counterpart of."""
OF_COINTOSS = (
    *("floor.restitution_exponent", "floor.restitution_viscous", "floor.slope"),
    *("floor.contour_friction", "floor.contour_viscosity", "air.viscosity"),
)
"""Fields that no adapter hands to its engine."""


def friction_of(scenario: Any, *refused: str, rough: float = 1e3) -> float:
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
    floor = scenario.floor
    laws = {"smooth": 0.0, "coulomb": floor.friction, "perfectly_rough": rough}
    if floor.contact not in laws:
        raise NotImplementedError(f"floor.contact: {floor.contact}, accepted: {', '.join(laws)}")
    return laws[floor.contact]


def rotations(q: np.ndarray) -> np.ndarray:
    """Return the rotation matrices of quaternions, scalar first, (n, 3, 3)."""
    cross = np.cross(np.eye(3), q[:, None, 1:])
    return np.eye(3) + 2 * (q[:, :1, None] * cross + cross @ cross)
