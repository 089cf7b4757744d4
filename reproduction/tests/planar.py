"""Coins of planar tosses, and releases of them that are drawn."""

from fractions import Fraction

import numpy as np

from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.setups.planar_maps import case


def scenario_of(chi, air=False, law="smooth"):
    return case(air=air, restitution=chi).replace("floor.contact", law)


def coin_of(chi, air=False, law="smooth"):
    scenario = scenario_of(chi, air, law)
    return planar_coin(scenario), units(scenario)


def drawn(number, seed=1):
    rng = np.random.default_rng(seed)
    z, w = rng.uniform(0.2, 0.6, number), rng.uniform(20, 60, number)
    return z, w, [PlanarRelease(Fraction(a), Fraction(b)) for a, b in zip(z, w, strict=True)]
