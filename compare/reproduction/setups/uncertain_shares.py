"""The share of random planar tosses that each accuracy of the release leaves uncertain, by one run."""

from fractions import Fraction
from math import sqrt

import numpy as np

from cointoss.compare.reproduction.precision.planar_coin import planar_coin, units
from cointoss.compare.reproduction.precision.planar_state import HEIGHT, SPIN, TILT, release
from cointoss.compare.reproduction.precision.splitting import Replica, replica
from cointoss.compare.reproduction.setups.planar_maps import HEIGHTS, SPINS
from cointoss.models.scenario import Scenario

LARGEST = Fraction(1, 1000)
"""The first accuracy ε, in SI units; the others are tenths of each other."""


def uncertain_shares(
    scenario: Scenario, rng: np.random.Generator, *, row: int = HEIGHT, levels: int, population: int
) -> Replica:
    """Run the splitting once: releases uniform in height and spin, flat, at rest but for the spin.

    Args:
        scenario: coin, air and floor.
        rng: draws the releases, and the intervals that go on.
        row: of a state: what varies by ε, `HEIGHT`, `SPIN` or `TILT`.
        levels: how many ε.
        population: intervals at each level, about.
    """
    own = units(scenario)
    # One SI unit of what varies, in the state's.
    unit = {
        HEIGHT: 1 / own.length,
        SPIN: Fraction(sqrt(scenario.coin.radius / scenario.gravity)),
        TILT: Fraction(1),
    }[row]
    heights, spins = rng.uniform(*HEIGHTS, population), rng.uniform(*SPINS, population)
    return replica(
        planar_coin(scenario),
        np.array([release(own, height=z, spin=w) for z, w in zip(heights, spins, strict=True)]),
        row=row,
        largest=LARGEST * unit,
        levels=levels,
        population=population,
        rng=rng,
    )
