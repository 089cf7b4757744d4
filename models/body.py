"""A scenario's coin, air and floor as plain numbers for compiled code."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from models.drag import Drag, linear_drag
from models.laws import ContactLaw, EndingTest
from models.vectors import Matrix, Vector

if TYPE_CHECKING:
    from models.scenario import Scenario


class Body(NamedTuple):
    """What the equations of motion and of impact need to know of a scenario; SI units, body frame."""

    mass: float
    radius: float
    thickness: float
    center: Vector
    """C from B [m]."""
    inertia: Matrix
    """J_C, about the mass centre [kg m²]."""
    inertia_inverse: Matrix
    inertia_smallest: float
    inertia_largest: float
    drag: Drag
    gravity: float


class Rules(NamedTuple):
    """How a scenario's coin meets the floor and when its toss ends."""

    law: ContactLaw
    restitution: float
    friction: float
    test: EndingTest
    max_impacts: int
    max_time: float


def body_of(scenario: "Scenario") -> Body:
    """Give the coin of a scenario in its air and gravity."""
    coin, air = scenario.coin, scenario.air
    J = coin.inertia_about_C
    moments = np.linalg.eigvalsh(J)
    return Body(
        mass=coin.mass,
        radius=coin.radius,
        thickness=coin.thickness,
        center=coin.center_of_mass,
        inertia=_rows(J),
        inertia_inverse=_rows(np.linalg.inv(J)),
        inertia_smallest=float(moments[0]),
        inertia_largest=float(moments[-1]),
        drag=linear_drag(coin.radius, coin.thickness, air.normal, air.tangential),
        gravity=scenario.gravity,
    )


def rules_of(scenario: "Scenario") -> Rules:
    """Give the floor and the ending of a scenario."""
    floor, ending = scenario.floor, scenario.ending
    return Rules(
        law=floor.contact,
        restitution=floor.restitution,
        friction=floor.friction,
        test=ending.test,
        max_impacts=ending.max_impacts,
        max_time=ending.max_time,
    )


def _rows(M: np.ndarray) -> Matrix:
    first, second, third = ((float(row[0]), float(row[1]), float(row[2])) for row in M)
    return first, second, third
