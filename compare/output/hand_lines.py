"""What the numbers of `cointoss hands` count, in lines above and below them."""

import math
from dataclasses import replace

from cointoss.models.hand import Hand
from cointoss.models.laws import ContactLaw
from cointoss.models.scenario import Scenario

WHY = (
    "why        At a touch the coin still turns over; at rest it lies flat. A smooth floor keeps the angular",
    "           momenta about the vertical and about the coin's axis. They are equal at a flat release, and",
    "           opposite in a coin that lies on its other side. So without air a coin that wobbles much",
    "           (psi of 70 deg or less) comes to rest on its first side. Nearer to 90 deg some coins don't.",
)
"""Why a coin rests on its first side far more often than it shows this side at a touch."""


def hand_lines(hand: Hand, scenario: Scenario, engine: str, seed: int) -> tuple[str, tuple[str, ...]]:
    """Return what is counted, in the line above the counts, and of which tosses, in those below."""
    caught = scenario.ending.caught
    below = (
        f"hand       {replace(hand, caught=caught).in_words}",
        *([f"unvaried   {hand.unvaried}"] if hand.unvaried else []),
        f"engine     {engine}, seed {seed}; in brackets 99 % intervals",
    )
    if hand.spun:
        return "How often the spun coin ends with each outcome:", below
    side = "heads" if hand.up == "heads" else "heads or tails, as drawn"
    where = "at a touch and at rest" if caught is None else "in the hand that catches the coin"
    above = f"How often the side that is up at the release ({side}) is up {where}:"
    wobbles = hand.psi < math.pi / 2 or hand.psi_scatter > 0
    why = WHY if caught is None and wobbles and keeps_momenta(scenario) else ()
    return above, (*why, *below)


def uncaught(count: int) -> str:
    """Return how many coins a hand did not catch, in words."""
    return f"{count:,d} coin{'s' * (count != 1)} that never came down to the hand"


def keeps_momenta(scenario: Scenario) -> bool:
    """Return whether no contact changes the angular momenta about the vertical and about the coin's axis."""
    coin, floor = scenario.coin, scenario.floor
    moments = (
        floor.rolling_friction,
        floor.pivoting_friction,
        floor.contour_friction,
        floor.contour_viscosity,
    )
    is_smooth = floor.contact == ContactLaw.SMOOTH and not floor.slope and not any(moments)
    return is_smooth and coin.inertia is None and not any(coin.center_of_mass)
