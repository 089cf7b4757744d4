"""How far a planar release may change with a proof that its outcome stays."""

import math
from fractions import Fraction

from cointoss import Scenario
from cointoss.study import ReleaseQuantity, is_planar
from cointoss_reproduction.precision.certified import proved_part
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.precision.planar_ending import planar_ending

PROVED = {"height": "height", "attitude about ξ": "tilt", "spin about ξ": "spin"}
"""Quantities with a proof, and their names in a `PlanarRelease`."""


def proved_change(scenario: Scenario, quantity: ReleaseQuantity, change: float) -> float:
    """Return a change of a release, to both sides, within which the outcome is proved to be the same.

    Args:
        scenario: whose coin is tossed.
        quantity: what changes.
        change: one that changes the outcome [SI].

    Returns:
        The change [SI]; 0 where none is proved, as where `refusal` says why none can be. The outcome is that
        of the scenario's ending: of a coin that is to be caught, the face in the hand.
    """
    if quantity.name not in PROVED or not math.isfinite(change) or refusal(scenario):
        return 0.0
    start = PlanarRelease(
        height=Fraction(scenario.release.position[2]), spin=Fraction(scenario.release.angular_velocity[0])
    )
    part = proved_part(
        planar_coin(scenario),
        units(scenario),
        release=start,
        change=PlanarRelease(**{PROVED[quantity.name]: Fraction(abs(change))}),
        ending=planar_ending(scenario),
    )
    return abs(change) * float(part)


def refusal(scenario: Scenario) -> str:
    """Return in a line why no outcome of a scenario is proved; empty where one can be.

    A proof needs a thin balanced coin released flat in vacuum, at rest but for its spin about ξ, a principal
    axis, on a smooth or perfectly rough floor without resistance and without threshold of restitution, and
    another test than "lying".
    """
    if not is_planar(scenario):
        return "accepted: a thin coin released flat in vacuum, at rest but for its spin about ξ"
    try:
        planar_coin(scenario)
        planar_ending(scenario)
    except ValueError as error:
        return str(error)
    return ""
