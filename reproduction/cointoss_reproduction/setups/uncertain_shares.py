"""The share f of random planar tosses that each accuracy ε of a release leaves uncertain, and its slope α."""

import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from functools import cache, partial
from math import log10
from multiprocessing import get_context

import numpy as np

from cointoss import Scenario
from cointoss.study import Array, Estimate, share_of
from cointoss_reproduction.precision.branching import EARLY, Branches, branch
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.setups.estimates import jackknife
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case

ACCURACIES = tuple(float(f"1e-{n}") for n in range(3, 25))
"""ε, of the height of the release [m]; the same number is that of another quantity in its own unit."""
SMOOTH, AIR, ROUGH = "smooth, vacuum", "smooth, air", "rough, vacuum"
CHIS = {
    SMOOTH: (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
    AIR: (0.3, 0.6, 0.8),
    ROUGH: (0.3, 0.6),
}
"""Restitutions by floor and medium. A rough floor adds energy above χ = √5/3, and a face is then never
settled."""
CEILING = 0.75
"""f where three tosses have nothing to do with each other: the chance that fair coins do not all agree."""
FEWEST = 5
"""Groups of ancestors whose boundaries are counted."""
LEAST = 1e-300
"""The least share, in place of 0 where no ancestor has an uncertain toss."""


def case_of(floor: str, chi: float) -> Scenario:
    """Return the scenario of the maps, of a restitution, with one of the floors and media of `CHIS`."""
    law = "perfectly_rough" if floor == ROUGH else "smooth"
    return case(air=floor == AIR, restitution=chi).replace("floor.contact", law)


@cache
def processes() -> ProcessPoolExecutor:
    """Return a pool of as many processes as there are cores."""
    return ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn"))


def uncertain_shares(
    scenario: Scenario,
    rng: np.random.Generator,
    *,
    quantity: str = "height",
    levels: int = len(ACCURACIES),
    population: int,
    followed: int = 0,
) -> Branches:
    """Run the branching on all cores: releases uniform in height and spin, flat, at rest but for the spin.

    Args:
        scenario: coin, air and floor.
        rng: draws the releases, and the intervals that go on.
        quantity: of a release: what varies by ε.
        levels: how many of `ACCURACIES`.
        population: intervals at each level, about.
        followed: boundaries that are followed at each level.
    """
    ancestors = EARLY[0] * population
    heights, spins = rng.uniform(*HEIGHTS, ancestors), rng.uniform(*SPINS, ancestors)
    return branch(
        planar_coin(scenario),
        units(scenario),
        [PlanarRelease(Fraction(z), Fraction(w)) for z, w in zip(heights, spins, strict=True)],
        quantity=quantity,
        largest=Fraction(1, 1000),
        levels=levels,
        population=population,
        rng=rng,
        followed=followed,
        each=partial(processes().map, chunksize=4),
    )


def share_at(shares: Array, whole: Array, level: int) -> Estimate:
    """Return f at an accuracy; its interval is wide where no toss is uncertain.

    Args:
        shares: weight of the uncertain tosses, by group of ancestors and accuracy, (n, m).
        whole: all weight, (n, m).
        level: number of the accuracy.
    """
    if not shares[:, level].any():
        return Estimate(0.0, 0.0, CEILING, len(shares), "groups of tosses")
    found = _of_groups(_logarithm(level), shares, whole)
    value, low, high = (10 ** min(x, log10(CEILING)) for x in found.ends)
    return Estimate(value, low, high, found.count, found.counted)


def slope_between(shares: Array, whole: Array, first: int, last: int) -> Estimate:
    """Return α between two of `ACCURACIES`; nothing is known of it where no toss is uncertain at the last.

    Args:
        shares: weight of the uncertain tosses, by group of ancestors and accuracy, (n, m).
        whole: all weight, (n, m).
        first: number of the accuracy.
        last: of the finer one.
    """
    if not shares[:, last].any():
        return Estimate(0.0, -np.inf, np.inf, len(shares), "groups of tosses")
    start, end = _logarithm(first), _logarithm(last)
    return _of_groups(lambda *means: (start(*means) - end(*means)) / (last - first), shares, whole)


def flat_share(groups: Branches, level: int) -> Estimate | None:
    """Return the part of the boundaries at an accuracy, and at its neighbours, at which a coin lands flat.

    None where too few were resolved.
    """
    near = slice(max(level - 1, 0), level + 2)
    flat, boundaries = (numbers[:, near].sum(axis=1) for numbers in (groups.flat, groups.boundaries))
    if np.sum(boundaries > 0) < FEWEST:
        return None
    if flat.sum() in (0, boundaries.sum()):
        return share_of(int(flat.sum()), int(boundaries.sum()), "boundaries")
    found = _of_groups(lambda part, all_: float(part[0] / all_[0]), flat[:, None], boundaries[:, None])
    return Estimate(found.value, max(found.low, 0.0), min(found.high, 1.0), found.count, found.counted)


def _logarithm(level: int) -> Callable[[Array, Array], float]:
    """Return log10 f at one of `ACCURACIES`, from the means over groups of uncertain and of all weight."""
    return lambda uncertain, whole: log10(max(uncertain[level] / whole[level], LEAST))


def _of_groups(statistic: Callable[..., float], *numbers: Array) -> Estimate:
    """Return a statistic of the means over groups of ancestors, with a jackknife's interval over these.

    Args:
        statistic: of the means, (m,) each.
        numbers: by group, (n, m) each.
    """
    count = len(numbers[0])
    return jackknife(
        lambda kept: statistic(*(one[kept].mean(axis=0) for one in numbers)),
        count,
        "groups of tosses",
        count,
    )
