"""How far a planar release may change with a proof that its outcome stays."""

import math
from fractions import Fraction

from cointoss.compare.metrics.margin import Quantity, is_planar
from cointoss.compare.reproduction.precision.certified import PlanarRelease, proved_part
from cointoss.compare.reproduction.precision.planar_coin import planar_coin, units
from cointoss.models.scenario import Scenario

PROVED = {"height": "height", "attitude about ξ": "tilt", "spin about ξ": "spin"}
"""Quantities with a proof, and their names in a `PlanarRelease`."""


def proved_change(scenario: Scenario, quantity: Quantity, change: float) -> float:
    """Return a change of a release, to both sides, within which the outcome is proved to be the same.

    Args:
        scenario: whose coin is tossed.
        quantity: what changes.
        change: one that changes the outcome [SI].

    Returns:
        The change [SI]; 0 where none is proved. A proof needs a thin ideal coin released flat in vacuum, at
        rest but for its spin about ξ, on a smooth or perfectly rough floor.
    """
    if quantity.name not in PROVED or not math.isfinite(change) or not is_planar(scenario):
        return 0.0
    try:
        coin = planar_coin(scenario)
    except ValueError:
        return 0.0
    start = PlanarRelease(
        height=Fraction(scenario.release.position[2]), spin=Fraction(scenario.release.angular_velocity[0])
    )
    whole = PlanarRelease(**{PROVED[quantity.name]: Fraction(abs(change))})
    return abs(change) * float(proved_part(coin, units(scenario), release=start, change=whole))
