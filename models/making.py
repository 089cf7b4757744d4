"""Makes what a toss needs to know of a scenario's numbers."""

import math
from typing import NamedTuple

from cointoss.models.body import AirLaw, Body, Rules
from cointoss.models.contact_laws.table import hardly_adds_energy, never_adds
from cointoss.models.drag import linear_drag, sliding_share
from cointoss.models.inertia import cylinder_inertia, inertia_about_mass_center, inverse, principal_moments
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, norm
from cointoss.models.laws import RestitutionKind
from cointoss.models.restitution import largest_restitution

# More impacts than a coin needs that loses energy; and enough of one that may never lose any.
MOST_IMPACTS, MOST_LOSSLESS = 30_000_000, 1_000_000
AT_REST = 1e9
"""The number that stands for `ending.until = "rest"` [s]: no toss lasts so long."""
_TAKING = 0.7
"""Up to this kinematic restitution the laws that hardly add energy do so in hardly an impact."""


class Cylinder(NamedTuple):
    """The mass and the size of a coin."""

    mass: float
    """m [kg]."""
    radius: float
    """r [m]."""
    thickness: float
    """h [m]."""


@compiled
def moved_inertia(cylinder: Cylinder, center: Vector) -> Matrix:
    """Return J_C of a uniform cylinder's inertia about B, body frame [kg m²].

    Args:
        cylinder: mass and size.
        center: C from B, body frame [m].
    """
    J_B = cylinder_inertia(cylinder.mass, cylinder.radius, cylinder.thickness)
    return inertia_about_mass_center(J_B, cylinder.mass, center)


@compiled
def make_body(
    cylinder: Cylinder, center: Vector, J: Matrix, air: AirLaw, gravity: float, slope: float
) -> Body:
    """Return the coin in its air and gravity.

    Args:
        cylinder: mass and size.
        center: C from B, body frame [m].
        J: inertia about C, body frame [kg m²].
        air: its resistance.
        gravity: g [m/s²].
        slope: the floor's angle to the horizontal [rad].
    """
    low, _, high = principal_moments(J)
    drag = linear_drag(cylinder.radius, cylinder.thickness, air.normal, air.tangential)
    return Body(
        cylinder.mass,
        cylinder.radius,
        cylinder.thickness,
        center,
        J,
        inverse(J),
        low,
        high,
        air,
        drag,
        sliding_share(drag, norm(center)),
        gravity * math.cos(slope),
        gravity * math.sin(slope),
    )


@compiled
def most_impacts(rules: Rules) -> int:
    """Return after how many impacts a toss is given up by default: soon where they may take no energy.

    docs/CONTACT.md says which laws take energy, and add none or hardly any.
    """
    largest = largest_restitution(rules)
    takes_energy = hardly_adds_energy(rules.law) and largest <= _TAKING
    if never_adds(rules.law) or rules.restitution_kind == RestitutionKind.ENERGETIC:
        takes_energy = largest < 1
    return MOST_IMPACTS if takes_energy else MOST_LOSSLESS
