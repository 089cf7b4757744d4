"""The share f of random planar tosses that each accuracy ε of a release leaves uncertain, and its slope α."""

from collections.abc import Callable, Sequence
from dataclasses import asdict
from fractions import Fraction
from math import log10, sqrt
from pathlib import Path
from typing import Any

import numpy as np

from cointoss import Scenario
from cointoss.study import PARTS, Array, Estimate, code_digest, jackknife, share_of
from cointoss_reproduction.frame.parts import Part, kept
from cointoss_reproduction.precision.branching import EARLY, Branches, branch
from cointoss_reproduction.precision.planar_coin import planar_coin, units
from cointoss_reproduction.precision.planar_state import HEIGHT, SPIN, TILT, release
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS

LARGEST = Fraction(1, 1000)
"""The first accuracy ε, in SI units; the others are tenths of each other."""
ACCURACIES = 10.0 ** -np.arange(3, 25)
"""ε, of the height of the release [m]; the same number is that of another quantity in its own unit."""
CEILING = 0.75
"""f where three tosses have nothing to do with each other: the chance that fair coins do not all agree."""
FEWEST = 5
"""Groups of ancestors whose boundaries are counted."""
LEAST = 1e-300
"""In the place of a share that no ancestor met."""


def uncertain_shares(
    scenario: Scenario,
    rng: np.random.Generator,
    *,
    row: int = HEIGHT,
    levels: int,
    population: int,
    followed: int = 0,
) -> Branches:
    """Run the branching once: releases uniform in height and spin, flat, at rest but for the spin.

    Args:
        scenario: coin, air and floor.
        rng: draws the releases, and the intervals that go on.
        row: of a state: what varies by ε, `HEIGHT`, `SPIN` or `TILT`.
        levels: how many ε.
        population: intervals at each level, about.
        followed: boundaries that are followed at each level.
    """
    own = units(scenario)
    # One SI unit of what varies, in the state's.
    unit = {
        HEIGHT: 1 / own.length,
        SPIN: Fraction(sqrt(scenario.coin.radius / scenario.gravity)),
        TILT: Fraction(1),
    }[row]
    ancestors = EARLY[0] * population
    heights, spins = rng.uniform(*HEIGHTS, ancestors), rng.uniform(*SPINS, ancestors)
    return branch(
        planar_coin(scenario),
        np.array([release(own, height=z, spin=w) for z, w in zip(heights, spins, strict=True)]),
        row=row,
        largest=LARGEST * unit,
        levels=levels,
        population=population,
        rng=rng,
        followed=followed,
    )


def kept_run(
    parts: Path,
    name: str,
    scenario: Scenario,
    seed: Sequence[int],
    *,
    row: int = HEIGHT,
    levels: int = len(ACCURACIES),
    population: int,
    followed: int = 0,
) -> Branches:
    """Return a run that an earlier computation kept, or make it and keep it.

    Args:
        parts: folder of what is done.
        name: of the scenario and what varies.
        scenario: coin, air and floor.
        seed: of the run.
        row: what varies, as of `uncertain_shares`.
        levels: how many ε.
        population: intervals at each level, about.
        followed: boundaries that are followed at each level.
    """

    def compute() -> Part:
        rng = np.random.default_rng(seed)
        made = uncertain_shares(
            scenario, rng, row=row, levels=levels, population=population, followed=followed
        )
        return {field: np.array(value) for field, value in asdict(made).items()}

    made_by = code_digest()
    label = f"{made_by}, {name}, {'-'.join(map(str, seed))}, {population} x {levels}, {followed}"
    run = kept(parts, label, compute)
    made: dict[str, Any] = {field: value if value.ndim else int(value) for field, value in run.items()}
    return Branches(**made)


def joined(runs: Sequence[Branches]) -> Branches:
    """Return the groups of several runs as those of one."""
    numbers = {name: [getattr(run, name) for run in runs] for name in asdict(runs[0])}
    all_of: dict[str, Any] = {
        name: np.vstack(every) if np.ndim(every[0]) else sum(every) for name, every in numbers.items()
    }
    return Branches(**all_of)


def of_groups(numbers: Array, statistic: Callable[[Array], float]) -> Estimate:
    """Return a statistic of the means over groups of ancestors, with a jackknife's interval over these.

    Args:
        numbers: by group, (n, m).
        statistic: of their means, (m,).
    """
    count = len(numbers)
    return jackknife(
        lambda kept: statistic(numbers[kept].mean(axis=0)), count, "groups of ancestors", min(count, PARTS)
    )


def exponent(shares: Array, first: int, decades: int) -> float:
    """Return α over some decades of `ACCURACIES` from the shares f at each, (m,)."""
    return log10(max(shares[first], LEAST) / max(shares[first + decades], LEAST)) / decades


def slope(shares: Array, first: int, decades: int) -> Estimate:
    """Return α over some decades of `ACCURACIES`, with its interval.

    Args:
        shares: f, by group and accuracy, (n, m).
        first: where it starts.
        decades: how many.
    """
    return of_groups(shares, lambda f: exponent(f, first, decades))


def share_at(groups: Branches, accuracy: float) -> Estimate:
    """Return f at one of `ACCURACIES`; the interval is one of its logarithm."""
    level = level_of(accuracy)
    found = _of_ratios(groups, lambda f: log10(max(f[level], LEAST)))
    value, low, high = (10 ** min(x, log10(CEILING)) for x in found.ends)
    return Estimate(value, low, high, found.count, found.counted)


def slope_between(groups: Branches, first: float, last: float) -> Estimate:
    """Return α between two of `ACCURACIES`."""
    start, end = level_of(first), level_of(last)
    return _of_ratios(groups, lambda f: exponent(f, start, end - start))


def _of_ratios(groups: Branches, statistic: Callable[[Array], float]) -> Estimate:
    """Return a statistic of f, as the ratio of shares and all weight, at each accuracy."""
    found = np.hstack([groups.shares, groups.whole])
    return of_groups(found, lambda means: statistic(np.divide(*np.split(means, 2))))


def level_of(accuracy: float) -> int:
    """Return which of `ACCURACIES` is nearest."""
    return int(np.argmin(np.abs(np.log10(ACCURACIES) - log10(accuracy))))


def flat_share(groups: Branches, accuracy: float) -> Estimate | None:
    """Return the part of the boundaries at an accuracy, and at its neighbours, at which a coin lands flat.

    None where too few were resolved.
    """
    near = slice(max(level_of(accuracy) - 1, 0), level_of(accuracy) + 2)
    flat, boundaries = (numbers[:, near].sum(axis=1) for numbers in (groups.flat, groups.boundaries))
    if np.sum(boundaries > 0) < FEWEST:
        return None
    if flat.sum() in (0, boundaries.sum()):
        return share_of(int(flat.sum()), int(boundaries.sum()), "boundaries")
    found = of_groups(np.column_stack([flat, boundaries]), lambda means: float(means[0] / means[1]))
    return Estimate(found.value, max(found.low, 0.0), min(found.high, 1.0), found.count, found.counted)
