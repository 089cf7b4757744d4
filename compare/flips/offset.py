"""The offset of a coin's mass centre along its normal that explains how often it shows heads."""

import math
from dataclasses import replace
from functools import partial
from os import PathLike

import numpy as np

from cointoss.compare.flips.counts import Flips
from cointoss.compare.flips.people import SameSide, chances_of_shares, estimate_of
from cointoss.compare.flips.sides import Sides
from cointoss.compare.flips.tossed import heads_along
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import LEVEL
from cointoss.compare.sweep.errors import MOST_SEED, SweepError, require_whole
from cointoss.models.devices import Device
from cointoss.models.hand import Hand, load_hand
from cointoss.models.reading import ScenarioSource, scenario_of

LARGEST = 1 / 8
"""The largest offset in thicknesses: of two layers, equally thick, one three times as dense as the other."""
SIMULATED = 15
"""Offsets towards heads at which the coin is tossed."""
TRIED = np.linspace(-1.0, 1.0, 601)
"""Offsets, in the largest, at which the likelihood is tried first."""


def offset(
    sides: Sides,
    scenario: ScenarioSource,
    *,
    hand: Hand | str | PathLike[str] | None = None,
    tosses: int = 1000,
    seed: int = 0,
    device: Device | str = Device.CPU,
) -> Estimate:
    """Find the offset of a coin's mass centre along its normal from how often it shows heads.

        cointoss.offset(Sides(heads=140, tails=110), "cent.toml", hand=Hand(spun=True, psi_scatter=0.02))

    The coin is tossed, or spun, with offsets up to an eighth of its thickness. Either side is up at first as
    often, so an offset to the other side swaps heads and tails. Flips that end on the edge do not count.

    Returns:
        The offset of C from the coin's centre towards heads, negative towards tails, with its interval by the
        likelihood ratio [m]. It is NaN where each offset that was tried explains the counts; where none does,
        the ends of its interval are NaN.

    Args:
        sides: how often each came up.
        scenario: whose coin it is: a scenario, the path of its file, or a name; its own release and the
            offset along its normal are not used.
        hand: that tosses or spins it, or the path of its file. By default `Hand()`.
        tosses: of each of some 15 offsets.
        seed: for the tosses.
        device: that tosses, as in `shares`.

    Raises:
        SweepError: for an option, or a coin without thickness, that can't be used.
        ScenarioError: for a scenario or a hand that can't be used.
    """
    require_whole("seed", seed, 0, MOST_SEED)
    described = scenario_of(scenario)
    if not (largest := LARGEST * described.coin.thickness):
        raise SweepError("coin.thickness = 0: accepted: more, for an offset along the normal")
    own = Hand() if hand is None else hand if isinstance(hand, Hand) else load_hand(hand)
    offsets, p, behind = heads_along(
        described,
        "coin.center_of_mass.zeta",
        (largest / SIMULATED, largest, SIMULATED),
        replace(own, up="either"),
        tosses,
        seed,
        device,
    )
    places = np.concatenate([-offsets[::-1], [0.0], offsets]) / largest
    heads = SameSide(partial(np.interp, xp=places, fp=np.concatenate([1 - p[::-1], [0.5], p])), behind)
    return offset_of(sides, heads) * largest


def offset_of(sides: Sides, heads: SameSide) -> Estimate:
    """Return the offset of `offset` in the largest.

    Args:
        sides: how often each came up.
        heads: how likely it is by the offset, from -1 to 1.
    """
    found = estimate_of(sides.heads, sides.flips, heads, TRIED)
    chances = chances_of_shares(Flips(same=[sides.heads], flips=[sides.flips]), heads.probability(TRIED))
    is_possible = len(chances) * min(chances.values()) >= 1 - LEVEL
    return found if is_possible else replace(found, low=math.nan, high=math.nan)
