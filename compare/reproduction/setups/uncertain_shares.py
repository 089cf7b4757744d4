"""The share f of random planar tosses that each accuracy ε of a release leaves uncertain, and its slope α."""

from collections.abc import Callable, Sequence
from dataclasses import asdict
from fractions import Fraction
from math import log10, sqrt
from pathlib import Path

import numpy as np

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import jackknife
from cointoss.compare.reproduction.parts import Part, kept
from cointoss.compare.reproduction.precision.planar_coin import planar_coin, units
from cointoss.compare.reproduction.precision.planar_state import HEIGHT, SPIN, TILT, release
from cointoss.compare.reproduction.precision.splitting import Replica, replica
from cointoss.compare.reproduction.setups.planar_maps import HEIGHTS, SPINS
from cointoss.models.kernel.sources import source_hash
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

LARGEST = Fraction(1, 1000)
"""The first accuracy ε, in SI units; the others are tenths of each other."""
ACCURACIES = 10.0 ** -np.arange(3, 25)
"""ε, of the height of the release [m]; the same number is that of another quantity in its own unit."""
LEAST = 1e-300
"""In the place of a share that no run met."""


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


def kept_run(
    parts: Path,
    name: str,
    scenario: Scenario,
    seed: Sequence[int],
    *,
    row: int = HEIGHT,
    levels: int = len(ACCURACIES),
    population: int,
) -> Replica:
    """Return a run that an earlier computation kept, or make it and keep it.

    Args:
        parts: folder of what is done.
        name: of the scenario and what varies.
        scenario: coin, air and floor.
        seed: of the run.
        row: what varies, as of `uncertain_shares`.
        levels: how many ε.
        population: intervals at each level, about.
    """

    def compute() -> Part:
        rng = np.random.default_rng(seed)
        made = uncertain_shares(scenario, rng, row=row, levels=levels, population=population)
        return {field: np.array(value) for field, value in asdict(made).items()}

    made_by = source_hash("cointoss.compare.reproduction.setups.uncertain_shares")
    label = f"{made_by}, {name}, {'-'.join(map(str, seed))}, {population} x {levels}"
    run = kept(parts, label, compute)
    return Replica(
        shares=run["shares"],
        hidden=run["hidden"],
        tosses=int(run["tosses"]),
        undecided=int(run["undecided"]),
    )


def of_runs(shares: Array, statistic: Callable[[Array], float]) -> Estimate:
    """Return a statistic of the runs' mean of f, with a jackknife's interval over the runs.

    Args:
        shares: f, by run and accuracy, (n, m).
        statistic: of f at each accuracy, (m,).
    """
    return jackknife(
        lambda kept: statistic(shares[kept].mean(axis=0)), len(shares), "runs", parts=len(shares)
    )


def slope(shares: Array, first: int, decades: int) -> Estimate:
    """Return α over some decades of `ACCURACIES`, with its interval.

    Args:
        shares: f, by run and accuracy, (n, m).
        first: where it starts.
        decades: how many.
    """
    return of_runs(shares, lambda f: log10(max(f[first], LEAST) / max(f[first + decades], LEAST)) / decades)
