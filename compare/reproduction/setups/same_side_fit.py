"""What 350,757 flips say of the angle ψ between a coin's normal and its angular momentum."""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.special import logsumexp
from scipy.stats import chi2, norm

from cointoss.compare.reproduction.estimates import LEVEL
from cointoss.models.hand import same_side_probability
from cointoss.models.records import Array

NODES = 4000
"""Of a distribution over people, at the middles of equal parts of its probability."""
_MIDDLES = (np.arange(NODES) + 0.5) / NODES
_LEAST = 1e-12


@dataclass(frozen=True)
class Flips:
    """Flips caught with the side up that was up at the release, and all, by person, (n,)."""

    heads_same: NDArray[np.int64]
    heads: NDArray[np.int64]
    """That started with heads up."""
    tails_same: NDArray[np.int64]
    tails: NDArray[np.int64]

    @property
    def same(self) -> NDArray[np.int64]:
        """Started with either side."""
        return self.heads_same + self.tails_same

    @property
    def flips(self) -> NDArray[np.int64]:
        """All."""
        return self.heads + self.tails


@dataclass(frozen=True)
class Fit:
    """A distribution of p, the probability of the same side, over people; fitted by maximum likelihood."""

    parameters: Array
    log_likelihood: float
    probabilities: Array
    """p at `NODES` parts of its probability, (n,)."""


def read_flips() -> Flips:
    """Read the counts of Bartoš et al. (2025) that come with the package."""
    path = resources.files("cointoss.compare.reproduction") / "data" / "same_side_flips.csv"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    column = {name: np.array([int(row[name]) for row in rows]) for name in rows[0]}
    return Flips(
        heads_same=column["heads_to_heads"],
        heads=column["heads_to_heads"] + column["heads_to_tails"],
        tails_same=column["tails_to_tails"],
        tails=column["tails_to_tails"] + column["tails_to_heads"],
    )


def log_likelihood(flips: Flips, probabilities: Array) -> float:
    """Return the logarithm of the likelihood of everybody's counts, but for what depends on these alone.

    Args:
        flips: the counts.
        probabilities: p at equal parts of its distribution over people, (m,).
    """
    p = np.clip(probabilities, _LEAST, 1 - _LEAST)
    same, other = flips.same[:, None], (flips.flips - flips.same)[:, None]
    return float((logsumexp(same * np.log(p) + other * np.log1p(-p), axis=1) - np.log(len(p))).sum())


def by_wobble(spread: float) -> Array:
    """Return p at `NODES` parts of its distribution: |90° - ψ| is half-normal over people.

    Args:
        spread: root of the mean square of 90° - ψ [rad].
    """
    off = spread * norm.ppf((1 + _MIDDLES) / 2)
    return same_side_probability(np.pi / 2 - np.minimum(off, np.pi / 2))


def freely(mean: float, spread: float) -> Array:
    """Return p at `NODES` parts of its distribution: normal over people, whatever made it.

    Args:
        mean: of p.
        spread: its standard deviation.
    """
    return mean + spread * norm.ppf(_MIDDLES)


def fit_wobble(flips: Flips) -> Fit:
    """Fit the spread of 90° - ψ over people [rad]."""
    best = minimize_scalar(
        lambda spread: -log_likelihood(flips, by_wobble(spread)), bounds=(1e-3, 1.0), method="bounded"
    )
    return Fit(np.array([best.x]), -float(best.fun), by_wobble(best.x))


def fit_freely(flips: Flips) -> Fit:
    """Fit mean and standard deviation of p over people."""
    best = minimize(
        lambda x: -log_likelihood(flips, freely(x[0], np.exp(x[1]))),
        x0=(0.5, np.log(0.01)),
        method="Nelder-Mead",
        options={"xatol": 1e-6, "fatol": 1e-6},
    )
    mean, spread = best.x[0], np.exp(best.x[1])
    return Fit(np.array([mean, spread]), -float(best.fun), freely(mean, spread))


def interval(log_likelihood_at: Callable[[float], float], best: float, low: float, high: float) -> Array:
    """Return the interval of a parameter by the likelihood ratio, (2,).

    Args:
        log_likelihood_at: of the parameter, the others at their best for it.
        best: the parameter's estimate.
        low: below the interval.
        high: above it.
    """
    least = log_likelihood_at(best) - chi2.ppf(LEVEL, 1) / 2
    return np.array([brentq(lambda x: log_likelihood_at(x) - least, best, end) for end in (low, high)])


def chance_of_spread(
    flips: Flips, probabilities: Array, rng: np.random.Generator, draws: int = 4000
) -> float:
    """Return how likely people as modelled differ among each other by as much as those who flipped.

    Args:
        flips: the counts.
        probabilities: p at equal parts of its distribution over people, (m,).
        rng: draws people.
        draws: how many times all of them.
    """
    p = rng.choice(probabilities, (draws, len(flips.flips)))
    drawn = _scatter(rng.binomial(flips.flips, p), flips.flips)
    return float((drawn >= _scatter(flips.same, flips.flips)).mean())


def _scatter(same: NDArray[np.int64], flips: NDArray[np.int64]) -> Array:
    """Return χ² of the counts against one p for all, (..., n) to (...)."""
    p = (same.sum(axis=-1) / flips.sum())[..., None]
    return ((same - flips * p) ** 2 / (flips * p * (1 - p))).sum(axis=-1)
